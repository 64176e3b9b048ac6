"""Files saved, and undo steps made, while work had things of its own in the file: none of them stays."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
import pytest
from risorius.operators.bake.work import expression_work
from risorius.progress import Writing, run
from risorius.scene.creases import marks
from risorius.scene.passing import MARK
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.look import Engine, Look
from risorius.scene.pictures.studio import studio
from risorius.scene.rig import rig_copy

KINDS = ("scenes", "objects", "meshes", "armatures", "shape_keys", "cameras", "lights", "worlds", "actions")


def there() -> dict[str, list[str]]:
    """What is in the file, by name."""
    return {kind: sorted(made.name for made in getattr(bpy.data, kind)) for kind in KINDS}


def saved(path: Path) -> str:
    """A copy of the file as it is now, as an autosave makes one."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    return str(path)


def on_a_rig(head: Any) -> Iterator[Any]:
    """A bake onto an armature, until controls are moved on a copy of it."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new("jaw")
    bone.head, bone.tail = (0.0, 0.0, 0.0), (0.0, -0.07, -0.05)
    bpy.ops.object.mode_set(mode="OBJECT")
    group = head.vertex_groups.new(name="jaw")
    group.add([v.index for v in head.data.vertices if v.co.z < -0.02], 1.0, "REPLACE")
    head.modifiers.new("Armature", "ARMATURE").object = rig
    bpy.context.view_layer.objects.active = head
    head.shape_key_add(name="Basis")
    head.shape_key_add(name="mine")
    head.risorius.bake.onto = "BONES"
    head.risorius.emotion.word = "joy"
    bpy.context.view_layer.update()
    return expression_work(head, bpy.context.scene)


def is_copied() -> bool:
    """Whether there is a copy of the rig."""
    return rig_copy.NAME in bpy.data.scenes


@pytest.mark.slow
def test_a_file_saved_during_a_bake_onto_bones_opens_without_its_copy(head: Any, tmp_path: Path) -> None:
    work = on_a_rig(head)
    before = there()
    while not is_copied():
        next(work)
    path = saved(tmp_path / "meanwhile.blend")
    work.close()
    assert there() == before
    bpy.ops.wm.open_mainfile(filepath=path)
    assert there() == before
    assert not any(MARK in obj for obj in bpy.data.objects)


@pytest.mark.slow
def test_an_undo_step_made_during_a_bake_onto_bones_comes_back_without_its_copy(head: Any) -> None:
    work = on_a_rig(head)
    before = there()
    bpy.ops.ed.undo_push(message="begun")
    while not is_copied():
        next(work)
    head.location.x = 1.0
    bpy.ops.ed.undo_push(message="moved")
    work.close()
    bpy.context.object.location.x = 2.0
    bpy.ops.ed.undo_push(message="moved again")
    bpy.ops.ed.undo()
    assert bpy.context.object.location.x == 1.0
    assert there() == before


@pytest.mark.slow
def test_the_bake_itself_goes_on_after_a_save(head: Any, tmp_path: Path) -> None:
    work = on_a_rig(head)
    while not is_copied():
        next(work)
    saved(tmp_path / "meanwhile.blend")
    while not isinstance(next(work), Writing):
        pass
    run(work)
    assert not is_copied()
    assert head.risorius.emotion.word == "joy"


@pytest.fixture
def creased(head: Any) -> Any:
    """The head with its creases."""
    head.risorius.emotion.word = "joy"
    bpy.ops.risorius.bake_expression()
    assert marks.has(head)
    return head


def is_rendered(obj: Any) -> bool:
    """Whether renders show the creases."""
    return bool(next(m for m in obj.modifiers if m.name == marks.MODIFIER).show_render)


@pytest.mark.slow
def test_a_file_saved_while_a_film_is_rendered_opens_without_its_studio(creased: Any, tmp_path: Path) -> None:
    bpy.data.cameras.new("Mine").use_fake_user = True
    before = there()
    with studio([creased], framing_of(creased), Look(engine=Engine.WORKBENCH)):
        assert not is_rendered(creased)
        path = saved(tmp_path / "meanwhile.blend")
    assert there() == before
    assert is_rendered(creased)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert there() == before
    assert is_rendered(bpy.data.objects["Risorius Head"])


@pytest.mark.slow
def test_undo_while_a_film_is_rendered_leaves_nothing_of_its_studio(creased: Any) -> None:
    bpy.ops.ed.undo_push(message="begun")
    before = there()
    with studio([creased], framing_of(creased), Look(engine=Engine.WORKBENCH)):
        bpy.ops.ed.undo_push(message="meanwhile")
        bpy.data.objects["Risorius Head"].location.x = 2.0
        bpy.ops.ed.undo_push(message="moved")
        bpy.ops.ed.undo()
        assert there() == before
    assert there() == before
    assert is_rendered(bpy.data.objects["Risorius Head"])
