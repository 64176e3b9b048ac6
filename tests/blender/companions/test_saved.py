"""The list *Follows the Face* that a user has corrected and saved, obeyed where the extension is not registered."""

from __future__ import annotations

import json
import subprocess
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import pytest
from risorius.operators.film.ops import RISORIUS_OT_render_film
from risorius.operators.followers.rows import list_again, rows_of
from risorius.progress import run
from risorius.scene.following.kinds import Follows
from risorius.scene.following.saved import saved_with
from risorius.scene.jobs.inputs import Input
from risorius.scene.jobs.subjects import subject
from risorius.scene.pictures import film

BAKE = """
    import json, sys
    import bpy
    from risorius.scene.jobs import words
    assert not hasattr(bpy.types.Object, "risorius")
    made = words.bake_file(sys.argv[2], mesh=sys.argv[1], words=["surprise"])
    keyed = [obj.name for obj in bpy.data.objects if obj.data.shape_keys is not None]
    print("MADE", json.dumps({"remarks": made.remarks, "keyed": sorted(keyed)}))
"""


@pytest.fixture
def corrected(character: Callable[..., dict[str, Any]], tmp_path: Path) -> Path:
    """A file whose list says that brows stay, that a tongue is of the skull, and that a far bead follows the skin."""
    made = character()
    bpy.context.view_layer.update()
    list_again(made["Face"], bpy.context.scene)
    rows = {row.object.name: row for row in made["Face"].risorius.face.followers}
    rows["Brows"].follows = "NONE"
    rows["Tongue"].follows = "SKULL"
    bpy.ops.mesh.primitive_cube_add(size=0.01, location=(1.0, 0.0, 0.0))
    bpy.context.object.name = "Bead"
    row = made["Face"].risorius.face.followers.add()
    row.object, row.follows = bpy.context.object, "SKIN"
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.09, location=(0.0, 0.02, 0.16))
    bpy.context.object.name = "Hat"
    bpy.context.view_layer.objects.active = made["Face"]
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "corrected.blend"))
    return tmp_path / "corrected.blend"


def chosen(path: Path) -> Any:
    return run(subject(Input(path)))


def test_what_is_stored_is_what_the_list_says(corrected: Path) -> None:
    face = bpy.data.objects["Face"]
    face.risorius.face.make_single_user = True
    face.risorius.face.teeth_upper = bpy.data.objects["Hat"]
    saved = saved_with(face)
    assert saved.rows == rows_of(face)
    assert {row.follows for row in saved.rows} >= {Follows.NONE, Follows.SKULL, Follows.TEETH_UPPER, Follows.EYES}
    assert saved.is_whole
    assert saved.make_single_user
    bpy.data.objects.remove(bpy.data.objects["Tongue"])
    assert saved_with(face).rows == rows_of(face)


def test_every_way_to_follow_is_read_as_it_was_written(corrected: Path) -> None:
    face = bpy.data.objects["Face"]
    row = face.risorius.face.followers[0]
    for way in Follows:
        row.follows = way.name
        assert saved_with(face).rows[0].follows is way


def test_a_face_without_a_list_has_none_saved(character: Callable[..., dict[str, Any]]) -> None:
    face = character()["Face"]
    assert saved_with(face).rows == ()
    face["risorius"] = "a custom property of the user's"
    assert saved_with(face).rows == ()


def test_a_job_obeys_the_saved_list(corrected: Path) -> None:
    face = chosen(corrected)
    assert {companion.obj.name for companion in face.target.companions} == {"Eyes", "Teeth", "Tongue", "Bead"}
    (note,) = (remark for remark in face.remarks if "follow it" in remark)
    assert note == "the face is Face; these follow it as saved in the file: Eyes, Teeth, Tongue, Bead"
    assert face.target.left_behind[0] == "Brows (does not follow)"
    assert face.target.left_behind[1].startswith("Hat (is not in the list")
    assert {obj.name for obj in face.shown()} == {"Face", "Eyes", "Teeth", "Tongue", "Bead", "Brows"}


def test_what_was_said_by_hand_stays_where_the_rest_was_never_looked_for(
    character: Callable[..., dict[str, Any]], tmp_path: Path
) -> None:
    made = character()
    made["Face"].risorius.face.teeth_lower = made["Teeth"]
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "older.blend"))
    face = chosen(tmp_path / "older.blend")
    assert {companion.obj.name for companion in face.target.companions} == {"Eyes", "Teeth", "Tongue", "Brows"}
    assert "the face is Face; these follow it as saved in the file: Teeth" in face.remarks
    assert "the face is Face; these follow it: Brows, Eyes, Tongue" in face.remarks


@pytest.mark.slow
def test_a_process_without_the_panel_bakes_by_the_saved_list(corrected: Path, tmp_path: Path) -> None:
    arguments = [sys.executable, "-c", textwrap.dedent(BAKE), str(corrected), str(tmp_path / "out.blend")]
    done = subprocess.run(arguments, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    made = json.loads(next(line for line in done.stdout.splitlines() if line.startswith("MADE"))[5:])
    assert {"Face", "Teeth"} <= set(made["keyed"])
    assert not {"Brows", "Tongue", "Hat"} & set(made["keyed"])
    assert any("as saved in the file: Eyes, Teeth, Tongue, Bead" in remark for remark in made["remarks"])
    assert any("these stay behind: Brows (does not follow), Hat" in remark for remark in made["remarks"])


def test_a_film_names_what_stays_behind(corrected: Path) -> None:
    said: list[str] = []

    class Told:
        def report(self, kind: set[str], text: str) -> None:
            said.append(text)

    RISORIUS_OT_render_film.finish(Told(), bpy.context, film.FilmResult(Path("a.mp4"), 1))
    assert any("these stay behind: Brows (does not follow), Hat" in text for text in said)
