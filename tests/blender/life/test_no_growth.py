"""Bakes in one session, undone, cleared and baked again: nothing is left over, and files keep what they had."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import bpy
import pytest
from risorius.operators.held import held_now
from risorius.scene import faces

#: Bakes in one session; a thousand take some minutes.
BAKES = int(os.environ.get("RISORIUS_TEST_BAKES", "200"))


def counts() -> dict[str, int]:
    """How many datablocks there are of each kind."""
    kinds = (prop.identifier for prop in bpy.data.bl_rna.properties if prop.type == "COLLECTION")
    return {kind: len(getattr(bpy.data, kind)) for kind in kinds}


def resident() -> int:
    """Bytes of memory that the process holds; 0 where the system does not tell."""
    told = Path("/proc/self/statm")
    return int(told.read_text(encoding="ascii").split()[1]) * 4096 if told.exists() else 0


@pytest.mark.slow
def test_bakes_leave_nothing_over(head: Any) -> None:
    """Datablocks stay as many, and memory does not grow with the bakes after the first ones."""
    before, sizes = {}, []
    for number in range(12):
        head.risorius.emotion.word = ("joy", "fear", "anger")[number % 3]
        head.risorius.bake.clip = "mine"
        assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
        if number % 4 == 3:
            bpy.ops.risorius.clear()
            bpy.ops.risorius.bake_expression()
            before[number] = counts()
            sizes.append(resident())
    assert before[3] == before[7] == before[11]
    assert len(head.data.shape_keys.key_blocks) == 2
    assert sizes[2] - sizes[1] < 40e6  # four bakes; a pose of this head alone holds a megabyte


def handlers() -> dict[str, int]:
    """How many listen to each of Blender's events."""
    events = {name: getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)}
    return {name: len(event) for name, event in events.items() if isinstance(event, list)}


@pytest.mark.slow
def test_hundreds_of_bakes_leave_nothing_over(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Baked, baked again, undone and cleared; solving the skin aside, which takes the time and keeps nothing."""
    from risorius.face.face import Face

    poses: dict[bytes, Any] = {}
    solve = Face.pose

    def pose(face: Any, faps: Any, **asked: Any) -> Any:
        if faps.tobytes() not in poses:
            poses[faps.tobytes()] = solve(face, faps, **asked)
        return poses[faps.tobytes()]

    monkeypatch.setattr(Face, "pose", pose)
    name, seen, sizes = head.name, {}, list[int]()
    for number in range(BAKES):
        head.risorius.emotion.word = ("joy", "fear", "anger")[number % 3]
        head.risorius.bake.clip = ("mine", "yours")[number % 2]
        assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
        if number % 20 == 10:
            bpy.ops.ed.undo_push(message="baked")
            bpy.ops.risorius.clear()
            bpy.ops.ed.undo_push(message="cleared")
            bpy.ops.ed.undo()
            head = bpy.data.objects[name]
            bpy.context.view_layer.objects.active = head
        if number % (BAKES // 5) == BAKES // 5 - 1:
            gone = {key: count for key, count in counts().items() if key != "window_managers"}
            attributes = sorted(attribute.name for attribute in head.data.attributes)
            seen[number] = gone, handlers(), attributes, sorted(head.keys()), len(faces._faces), held_now()
            sizes.append(resident())
    assert len(set(map(repr, seen.values()))) == 1, seen
    assert [key.name for key in head.data.shape_keys.key_blocks] == ["Basis", "mine", "yours"]
    assert sizes[-1] - sizes[1] < 30e6  # of three fifths of them; a shape key of this head is 130 kB


@pytest.mark.slow
def test_a_saved_file_that_is_opened_again_has_what_was_saved(head: Any, tmp_path: Path) -> None:
    """What was baked after saving is gone with File > Revert, and the face goes on working."""
    head.risorius.emotion.word = "joy"
    bpy.ops.risorius.bake_expression()
    path = tmp_path / "ö ü" / "a file.blend"
    path.parent.mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    head.risorius.bake.clip = "later"
    bpy.ops.risorius.bake_expression()
    assert {key.name for key in head.data.shape_keys.key_blocks} > {"joy"}
    bpy.ops.wm.revert_mainfile()
    again = bpy.data.objects["Risorius Head"]
    assert [key.name for key in again.data.shape_keys.key_blocks] == ["Basis", "joy"]
    bpy.context.view_layer.objects.active = again
    again.risorius.bake.clip = "later"
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    assert len(again.data.shape_keys.key_blocks) == 3


@pytest.mark.slow
def test_a_duplicate_and_a_shared_mesh_have_bakes_of_their_own(head: Any) -> None:
    """Multi-user data: what is baked on one object does not move another that shares its mesh: it is refused."""
    twin = head.copy()
    bpy.context.collection.objects.link(twin)
    assert twin.data is head.data
    head.risorius.emotion.word = "joy"
    with pytest.raises(RuntimeError, match="mesh"):
        bpy.ops.risorius.bake_expression()
    assert head.data.shape_keys is None
    twin.data = twin.data.copy()
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    assert twin.data.shape_keys is None


@pytest.mark.slow
def test_linked_and_overridden_faces_are_refused_or_baked_whole(head: Any, tmp_path: Path) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(tmp_path / "library.blend"), link=True) as (there, here):
        here.objects = there.objects
    linked = here.objects[0]
    bpy.context.collection.objects.link(linked)
    bpy.context.view_layer.objects.active = linked
    assert not bpy.ops.risorius.bake_expression.poll()
    override = linked.override_create(remap_local_usages=True)
    bpy.context.view_layer.objects.active = override
    assert not bpy.ops.risorius.bake_expression.poll()


@pytest.mark.slow
def test_the_extension_is_switched_off_and_on_between_bakes(head: Any) -> None:
    """What was baked stays without the extension, and is its own again when it is back."""
    import risorius

    head.risorius.emotion.word = "joy"
    bpy.ops.risorius.bake_expression()
    risorius.unregister()
    try:
        keys = head.data.shape_keys
        bpy.context.scene.frame_set(10)
        assert keys.key_blocks["joy"].value > 0.0
    finally:
        risorius.register()
    assert head.risorius.emotion.word == "joy"
    bpy.ops.risorius.clear()
    assert head.data.shape_keys is None
