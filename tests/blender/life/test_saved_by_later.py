"""A file that a later version saved says so, and stays marked so."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import pytest
from risorius.operators import saved_by
from risorius.operators.saved_by import SAVED_BY, draw_later, later_version
from risorius.resources import version

pytestmark = pytest.mark.smoke


class Spy:
    """A layout that keeps what is written on it."""

    alert = False

    def __init__(self) -> None:
        self.texts: list[str] = []

    def box(self) -> Spy:
        return self

    def column(self, **_options: object) -> Spy:
        return self

    def label(self, *, text: str, **_options: object) -> None:
        self.texts.append(text)


def saved(path: Path) -> Any:
    """The scene of the open file, saved and opened again."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.open_mainfile(filepath=str(path))
    return bpy.context.scene


@pytest.mark.usefixtures("head")
def test_a_file_of_this_version_says_nothing(tmp_path: Path) -> None:
    scene = saved(tmp_path / "mine.blend")
    assert scene[SAVED_BY] == version()
    assert later_version(scene) is None
    spy = Spy()
    draw_later(spy, scene)  # type: ignore[arg-type]
    assert spy.texts == []


@pytest.mark.usefixtures("head")
@pytest.mark.parametrize("other", ["99.0.0", "0.99.0", "0.10.0"])
def test_a_later_version_is_named_and_stays_so(other: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(saved_by, "version", lambda: other)
    scene = saved(tmp_path / "theirs.blend")
    monkeypatch.undo()
    spy = Spy()
    draw_later(spy, scene)  # type: ignore[arg-type]
    assert spy.texts[0] == f"Saved by Risorius {other}"
    assert later_version(saved(tmp_path / "again.blend")) == other


@pytest.mark.parametrize("odd", ["", "later", "0..1", 7, "0.0.9"])
def test_what_is_no_later_version_says_nothing(odd: object) -> None:
    bpy.context.scene[SAVED_BY] = odd
    assert later_version(bpy.context.scene) is None


def test_a_file_without_a_face_is_not_marked(tmp_path: Path) -> None:
    bpy.ops.mesh.primitive_cube_add()
    assert SAVED_BY not in saved(tmp_path / "cube.blend")
