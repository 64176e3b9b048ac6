"""The command line keeps prepared faces in the user's cache folder, and only there where that is safe and wanted."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius import api
from risorius.cli import main
from risorius.cli.kept import VARIABLE, kept_folder
from risorius.face.pose import Poser


@pytest.fixture
def head(tmp_path: Path) -> list[str]:
    """Options of a head in files."""
    built = api.build_default_head()
    sizes = np.array([len(polygon) for polygon in built.polygons])
    loops = np.concatenate([np.asarray(polygon) for polygon in built.polygons])
    np.savez(tmp_path / "head.npz", vertices=built.vertices, loops=loops, face_sizes=sizes)
    points = {name: np.asarray(place).tolist() for name, place in built.points.items()}
    (tmp_path / "head.json").write_text(json.dumps(points))
    return ["--mesh", str(tmp_path / "head.npz"), "--points", str(tmp_path / "head.json")]


def tables(folder: Path, head: list[str], name: str) -> Any:
    """What `risorius tables` writes for one FAP."""
    out = folder / name
    assert main(["tables", *head, "--faps", "3", "--out", str(out)]) == 0
    return out.read_bytes()


@pytest.mark.slow
def test_a_face_is_kept_and_the_next_command_computes_none_of_it(
    tmp_path: Path, head: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(VARIABLE, str(tmp_path / "cache"))
    made, build = [], Poser.__init__
    monkeypatch.setattr(Poser, "__init__", lambda self, *given, **told: made.append(1) or build(self, *given, **told))
    first = tables(tmp_path, head, "first.txt")
    assert made
    (kept,) = (tmp_path / "cache").glob("*.face")
    made.clear()
    assert tables(tmp_path, head, "again.txt") == first
    assert not made
    kept.write_bytes(kept.read_bytes()[:-100] + bytes(100))  # damaged: as good as none
    assert tables(tmp_path, head, "after.txt") == first
    assert made


@pytest.mark.slow
def test_turned_off_nothing_is_written(tmp_path: Path, head: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "home"))
    monkeypatch.setenv(VARIABLE, "off")
    tables(tmp_path, head, "first.txt")
    assert kept_folder() is None
    assert not (tmp_path / "home").exists()


@pytest.mark.slow
def test_a_folder_that_cannot_be_written_is_told_of(
    tmp_path: Path, head: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "cache").write_text("not a folder")
    monkeypatch.setenv(VARIABLE, str(tmp_path / "cache"))
    tables(tmp_path, head, "first.txt")
    assert "was not kept" in capsys.readouterr().err


@pytest.mark.skipif(os.name != "posix", reason="permissions of POSIX")
def test_a_folder_that_others_can_write_to_is_not_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    tmp_path.chmod(0o700)
    assert kept_folder() == tmp_path
    tmp_path.chmod(0o777)
    assert kept_folder() is None


def test_it_is_in_the_users_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(VARIABLE)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path))
    folder = kept_folder()
    assert folder is not None
    assert folder.parts[-2:] == ("risorius", "faces")
