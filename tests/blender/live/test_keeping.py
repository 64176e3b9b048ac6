"""Prepared faces are kept where the user wants that, and cleared when they ask for it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.operators.kept import folder as kept_folder
from risorius.operators.kept import ops
from risorius.operators.kept.props import RISORIUS_AP_preferences
from risorius.scene import faces
from risorius.scene.bake.target import Target
from risorius.scene.jobs.kept import kept_in
from risorius.scene.live.held_faces import HeldFaces


@pytest.fixture
def place(tmp_path: Path) -> Iterator[Path]:
    """A folder in which faces are kept."""
    faces.keep_where(lambda: tmp_path / "faces")
    faces.forget_faces()
    yield tmp_path / "faces"
    faces.keep_where(faces.nowhere)
    faces.forget_faces()


def shown(head: Any) -> HeldFaces:
    """Faces of which that of a head was got ready and all was done for it."""
    held, target = HeldFaces(), Target(head)
    assert held.current(target) is None
    while held.is_preparing:
        held.prepare()
    assert held.current(target) is not None
    while held.has_more:
        held.go_on()
    return held


@pytest.mark.slow
def test_a_face_that_was_shown_is_kept_and_the_next_time_it_comes_from_there(head: Any, place: Path) -> None:
    shown(head)
    assert len(list(place.glob("*.face"))) == 1
    faces.forget_faces()
    again = faces.face_of(Target(head).source())
    assert again.is_from_file
    head.data.vertices[0].co.x += 1e-4
    assert not faces.face_of(Target(head).source()).is_from_file


@pytest.mark.slow
def test_what_a_job_has_posed_is_kept_for_the_next_one(head: Any, tmp_path: Path) -> None:
    folder, seen = tmp_path / "faces", []
    faces.forget_faces()
    for _ in range(2):
        with kept_in(lambda: folder) as troubles:
            face = faces.face_of(Target(head).source())
            seen.append(face.is_from_file)
            face.pose(np.full(68, np.nan))
        faces.forget_faces()
    assert (seen, troubles) == ([False, True], [])
    assert not faces.face_of(Target(head).source()).is_from_file  # after the job all is as before it
    shown_face = shown_from(folder, head)
    assert shown_face.is_from_file
    assert shown_face.poser.is_explored  # what the command line has kept is kept again with what a preview needs
    faces.keep_where(faces.nowhere)


def shown_from(folder: Path, head: Any) -> Any:
    """The face of a head that was shown with a folder, as it comes out of that the next time."""
    faces.forget_faces()
    faces.keep_where(lambda: folder)
    shown(head)
    faces.forget_faces()
    return faces.face_of(Target(head).source())


@pytest.mark.slow
def test_a_folder_that_cannot_be_written_is_told_of_and_all_goes_on(head: Any, place: Path) -> None:
    place.parent.mkdir(exist_ok=True)
    place.write_text("not a folder")
    shown(head)
    assert "not kept" in faces.keeping_trouble()


def test_what_is_to_be_done_later_is_dropped_with_the_face(head: Any, place: Path) -> None:
    held = HeldFaces()
    held.current(Target(head))
    assert held.has_more
    held.drop()
    assert not held.has_more
    assert not held.is_preparing
    assert not place.exists()


def test_nothing_is_kept_where_risorius_is_no_add_on_of_the_user() -> None:
    assert kept_folder.folder_to_use() is None
    assert kept_folder.kept_folder().name == "faces"


def test_prepared_faces_are_cleared(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ops, "kept_folder", lambda: tmp_path)
    (tmp_path / f"{'a' * 64}.face").write_text("a face")
    (tmp_path / "notes.txt").write_text("mine")
    assert bpy.ops.risorius.clear_kept_faces() == {"FINISHED"}
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]


def test_the_preferences_show_the_setting_the_folder_and_the_button(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn = list[Any]()
    layout = SimpleNamespace(
        prop=lambda _, name: drawn.append(name),
        label=lambda text, **_: drawn.append(text),
        operator=drawn.append,
        column=lambda: layout,
    )
    monkeypatch.setattr(faces, "_trouble", "No space left on device")
    RISORIUS_AP_preferences.draw(SimpleNamespace(layout=layout), bpy.context)  # type: ignore[arg-type]
    trouble = "The last face was not kept: No space left on device"
    assert drawn == ["keep_faces", str(kept_folder.kept_folder()), trouble, "risorius.clear_kept_faces"]
