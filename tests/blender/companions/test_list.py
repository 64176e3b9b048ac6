"""The list *Follows the Face*: filled by itself, corrected, kept with the file, obeyed by every bake."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.operators.active import companions_of, target_of
from risorius.operators.followers.rows import list_again
from risorius.scene import mesh as meshes
from risorius.scene.following.kinds import PARTS, Follows

FOUND = {"Eyes": "EYES", "Teeth": "TEETH", "Tongue": "TONGUE", "Brows": "SKIN"}


def listed(face: Any) -> dict[str, str]:
    return {row.object.name: row.follows for row in face.risorius.face.followers}


def fill(made: dict[str, Any]) -> Any:
    bpy.context.view_layer.update()
    list_again(made["Face"], bpy.context.scene)
    return made["Face"]


def moved(obj: Any, key: str) -> np.ndarray:
    blocks = obj.data.shape_keys.key_blocks
    return np.linalg.norm(meshes.key_vertices(blocks[key]) - meshes.key_vertices(blocks[0]), axis=1)


@pytest.mark.slow
def test_one_button_takes_all_along(character: Callable) -> None:
    made = character()
    made["Face"].risorius.emotion.word = "surprise"
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    assert listed(made["Face"]) == FOUND
    for name in ("Teeth", "Tongue", "Brows"):
        assert moved(made[name], "surprise").max() > 1e-3
    actions = {made[name].data.shape_keys.animation_data.action for name in ("Face", "Teeth", "Tongue", "Brows")}
    assert len(actions) == 1


@pytest.mark.slow
def test_engine_shapes_are_on_every_object_that_moves(character: Callable) -> None:
    made = character()
    assert bpy.ops.risorius.make_shapes() == {"FINISHED"}
    keys = {name: set(obj.data.shape_keys.key_blocks.keys()) for name, obj in made.items()}
    assert len(keys["Face"]) > 50
    assert {"jawOpen", "tongueOut"} <= keys["Tongue"]
    assert "jawOpen" in keys["Teeth"]
    assert "eyeLookUpLeft" in keys["Eyes"]
    assert "browInnerUp" in keys["Brows"]
    assert all(names <= keys["Face"] for names in keys.values())
    made["Face"].data.shape_keys.key_blocks["jawOpen"].value = 0.6
    bpy.context.view_layer.update()
    shown = made["Teeth"].evaluated_get(bpy.context.evaluated_depsgraph_get())
    assert shown.data.shape_keys.key_blocks["jawOpen"].value == pytest.approx(0.6)


def test_what_the_user_says_stays(character: Callable) -> None:
    made = character()
    face = fill(made)
    rows = {row.object.name: row for row in face.risorius.face.followers}
    rows["Brows"].follows = "SKULL"
    rows["Tongue"].follows = "NONE"
    assert bpy.ops.risorius.find_followers() == {"FINISHED"}
    assert listed(face) == {**FOUND, "Brows": "SKULL", "Tongue": "NONE"}
    assert {c.obj.name: c.part for c in companions_of(face)} == {
        name: PARTS[Follows[way]] for name, way in {**FOUND, "Brows": "SKULL"}.items() if name != "Tongue"
    }
    assert target_of(face).remarks() == ("Face: these stay behind: Tongue (does not follow)",)


def test_objects_are_added_and_removed(character: Callable) -> None:
    made = character()
    face = fill(made)
    bpy.ops.mesh.primitive_cube_add(size=0.02, location=(0.4, 0.0, 0.0))
    lamp = bpy.context.object
    bpy.context.view_layer.objects.active = face
    assert bpy.ops.risorius.add_followers() == {"FINISHED"}
    assert listed(face)[lamp.name] == "SKULL"
    assert face.risorius.face.followers[face.risorius.face.follower].object == lamp
    assert bpy.ops.risorius.remove_follower() == {"FINISHED"}
    assert listed(face) == FOUND
    bpy.data.objects.remove(made["Teeth"])
    assert "Teeth" not in {companion.obj.name for companion in companions_of(face)}
    bpy.ops.risorius.find_followers()
    assert listed(face) == {name: way for name, way in FOUND.items() if name != "Teeth"}


def test_what_came_later_is_named(character: Callable) -> None:
    made = character()
    face = fill(made)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.09, location=(0.0, 0.02, 0.16))
    bpy.context.object.name = "Hat"
    bpy.context.view_layer.update()
    assert target_of(face).left_behind == ()
    (behind,) = target_of(face, bpy.context.scene).left_behind
    assert behind.startswith("Hat (is not in the list")


def test_what_cannot_be_written_to_is_left_out_and_named(character: Callable) -> None:
    made = character()
    face = fill(made)
    twin = made["Teeth"].copy()
    bpy.context.collection.objects.link(twin)
    assert "Teeth" not in {companion.obj.name for companion in companions_of(face)}
    (behind,) = target_of(face).left_behind
    assert behind.startswith("Teeth (shares its mesh with")
    face.risorius.face.make_single_user = True
    assert target_of(face).left_behind == ()


def test_the_list_is_kept_with_the_file(character: Callable, tmp_path: Path) -> None:
    face = fill(character())
    face.risorius.face.followers[0].follows = "NONE"
    before = listed(face)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "character.blend"))
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "character.blend"))
    assert listed(bpy.data.objects["Face"]) == before


def test_properties_of_single_parts_say_the_same(character: Callable) -> None:
    """Scripts, and files from before there was a list."""
    made = character()
    face = made["Face"]
    face.risorius.face.teeth_lower = made["Teeth"]
    assert listed(face) == {"Teeth": "TEETH_LOWER"}
    face.risorius.face.teeth_upper = made["Teeth"]
    assert listed(face) == {"Teeth": "TEETH"}
    face.risorius.face.teeth_lower = None
    assert listed(face) == {"Teeth": "TEETH_UPPER"}
    face.risorius.face.teeth_upper = None
    assert listed(face) == {}
    fill(made)
    face.risorius.face.teeth_lower = made["Teeth"]
    assert listed(face) == FOUND
    face.risorius.face.eyeball_l = made["Brows"]
    assert listed(face)["Brows"] == "EYE_L"
    face.risorius.face.followers.clear()
    assert {c.obj.name: c.part for c in companions_of(face)} == {
        "Teeth": PARTS[Follows.TEETH_LOWER],
        "Brows": PARTS[Follows.EYE_L],
    }


def test_a_file_from_before_the_list_comes_into_it(character: Callable, tmp_path: Path) -> None:
    made = character()
    face = made["Face"].risorius.face
    face.teeth_lower, face.tongue = made["Teeth"], made["Tongue"]
    face.followers.clear()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "older.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "older.blend"))
    assert listed(bpy.data.objects["Face"]) == {"Teeth": "TEETH_LOWER", "Tongue": "TONGUE"}


def test_the_panel_draws_without_looking_about(character: Callable, monkeypatch: pytest.MonkeyPatch) -> None:
    from risorius.operators.followers.panel import RISORIUS_PT_followers
    from risorius.scene.following import found

    face = fill(character())
    assert face == bpy.context.object

    def refuse(*_: object, **__: object) -> None:
        raise AssertionError("a panel must not look about")

    monkeypatch.setattr(found, "find_followers", refuse)
    from unittest.mock import MagicMock

    panel = MagicMock()
    RISORIUS_PT_followers.draw(panel, bpy.context)
    assert panel.layout.row().template_list.called
