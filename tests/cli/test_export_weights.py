"""`export weights`: a stream as values of a face's shape keys over time, without Blender."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.cli import main
from risorius.errors import ParameterError

DRAWN = {"jawOpen": {3: 400.0}, "mouthSmileLeft": {6: 200.0, 12: 150.0}, "mouthSmileRight": {7: 200.0, 13: 150.0}}


@pytest.fixture(scope="module")
def shapes() -> np.ndarray:
    """(3, V, 3) what three keys add to the default head, metres."""
    face, found = api.default_face(), []
    for faps in DRAWN.values():
        frame = np.full(68, np.nan)
        frame[[number - 1 for number in faps]] = list(faps.values())
        found.append(face.pose(frame, drive="exact").positions - face.vertices)
    return np.array(found)


@pytest.fixture
def take(shapes: np.ndarray, tmp_path: Path) -> tuple[Path, Path]:
    """A stream of twelve frames in which the jaw opens, and the keys."""
    frames = np.full((12, 68), np.nan)
    frames[:, 2] = np.linspace(0.0, 300.0, 12)
    api.write_fap(tmp_path / "jaw.fap", api.FapStream(frames, fps=24.0, name="jaw"))
    np.savez(tmp_path / "keys.npz", names=np.array(list(DRAWN)), displacement=shapes)
    return tmp_path / "jaw.fap", tmp_path / "keys.npz"


@pytest.mark.slow
def test_the_table_is_what_the_api_finds_and_is_read_back(
    take: tuple[Path, Path], shapes: np.ndarray, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    stream, keys = take
    out = tmp_path / "w.csv"
    assert main(["export", "weights", str(stream), "--shapes", str(keys), "--out", str(out), "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    face, frames = api.default_face(), api.read_fap(stream).expanded()
    controls = api.Controls(tuple(DRAWN), shapes, np.zeros(3), np.ones(3))
    found = api.retarget(face, controls, api.play(face, api.read_fap(stream)), fps=24.0, requested=frames)
    with out.open(newline="") as file:
        rows = list(csv.DictReader(file))
    values = np.array([[float(row[name]) for name in found.names] for row in rows])
    np.testing.assert_allclose(values, found.values, atol=1e-5)
    assert [float(row["timestamp"]) for row in rows] == pytest.approx(np.arange(12) / 24.0, abs=1e-6)
    assert said["explained"] == pytest.approx(found.explained)
    assert said["assumed"] == []
    assert said["inertia"] is False
    assert values[-1, 0] == values.max() > 0.2
    back = api.read_stream(out)
    assert back.fps == pytest.approx(24.0)
    assert np.argmax(back.frames[:, 2]) == np.argmax(values[:, 0])


@pytest.mark.parametrize(
    ("stored", "said"),
    [
        ({"names": np.array(["a"]), "displacement": np.zeros((1, 5, 3))}, "displacement"),
        ({"names": np.array(["a"])}, "cannot be read as shape keys"),
    ],
)
def test_keys_of_another_face_are_refused_and_nothing_is_written(
    stored: dict[str, np.ndarray],
    said: str,
    take: tuple[Path, Path],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    np.savez(tmp_path / "other.npz", **stored)
    out = tmp_path / "w.csv"
    assert main(["export", "weights", str(take[0]), "--shapes", str(tmp_path / "other.npz"), "--out", str(out)]) == 1
    assert said in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["weights", "a.fap"], "--shapes"),
        (["gltf", "--mesh", "face.obj"], ".blend"),
        (["gltf"], ".blend"),
        (["gltf", "a.fap", "--mesh", "face.blend"], ".blend"),
    ],
)
def test_what_is_missing_exits_with_2(arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", *arguments, "--out", "o.x"]) == 2
    assert said in capsys.readouterr().err


def test_a_table_of_weights_must_be_whole(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="values"):
        api.write_weight_csv(tmp_path / "w.csv", ["a", "b"], np.zeros((2, 3)), fps=25.0)
    assert not (tmp_path / "w.csv").exists()
