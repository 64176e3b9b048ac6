"""The table of confidences beside a tracked stream, and recognition that weighs by it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.cli import main
from risorius.errors import FormatError
from risorius.track import read_confidence, write_confidence


def test_what_is_written_is_read(tmp_path: Path) -> None:
    random = np.random.default_rng(2)
    confidence, doubt = random.random((3, 68)), random.normal(scale=90.0, size=(68, 2))
    write_confidence(tmp_path / "c.csv", confidence, doubt)
    sure, modes = read_confidence(tmp_path / "c.csv")
    np.testing.assert_allclose(sure, confidence, atol=5e-4)
    assert modes is not None
    np.testing.assert_allclose(modes, doubt, atol=5e-3)
    write_confidence(tmp_path / "own.csv", confidence, np.zeros((68, 0)))
    assert read_confidence(tmp_path / "own.csv")[1] is None


def test_a_damaged_table_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "c.csv"
    write_confidence(path, np.full((1, 68), 2.0), np.zeros((68, 0)))
    with pytest.raises(FormatError, match="F1"):
        read_confidence(path)
    write_confidence(path, np.zeros((0, 68)), np.ones((68, 1)))
    with pytest.raises(FormatError, match="no frames"):
        read_confidence(path)


def test_recognise_weighs_by_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    frames = np.nan_to_num(api.archetype("sadness", 0).frame())[None].repeat(2, axis=0)
    frames[:, 12 - 1] = 400.0
    stream, table = tmp_path / "s.fap", tmp_path / "c.csv"
    api.write_fap(stream, api.FapStream(frames, fps=25.0, name="s"))
    confidence = np.ones((2, 68))
    confidence[1, 12 - 1] = 0.0
    write_confidence(table, confidence, np.zeros((68, 0)))
    said = []
    for frame in (0, 1):
        command = ["recognise", str(stream), "--rule", "robust", "--confidence", str(table), "--frame", str(frame)]
        assert main([*command, "--json"]) == 0
        said.append(json.loads(capsys.readouterr().out)["sadness"])
    assert said[1] > said[0]
    assert main(["recognise", str(stream), "--confidence", str(table)]) == 2
    assert "robust" in capsys.readouterr().err
    write_confidence(table, confidence[:1], np.zeros((68, 0)))
    assert main(["recognise", str(stream), "--rule", "robust", "--confidence", str(table)]) == 1
    assert "1 frames, the stream 2" in capsys.readouterr().err
