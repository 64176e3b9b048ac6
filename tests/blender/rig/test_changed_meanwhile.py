"""What others do to a face or its rig while a bake onto it is computed: it is refused, and nothing of it is left.

The change comes while controls are moved on a copy of the rig, and again just before the clip is written.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.errors import SceneError
from risorius.operators.bake.work import expression_work, motion_work
from risorius.progress import Writing, run
from risorius.scene.fcurves import all_curves
from risorius.scene.rig.rig_copy import NAME

pytestmark = pytest.mark.slow
#: After reading the face, before its rig is copied.
LOOKING = "Looking at the controls"


def armature() -> Any:
    """The user's armature, not its copy."""
    return bpy.context.scene.objects["Rig"]


def other_vertices(head: Any) -> None:
    places = np.empty(3 * len(head.data.vertices), dtype=np.float32)
    basis = head.data.shape_keys.key_blocks[0].data if head.data.shape_keys else head.data.vertices
    basis.foreach_get("co", places)
    basis.foreach_set("co", 1.3 * places)
    head.data.update()


def mesh_of_its_own(head: Any) -> None:
    head.data = head.data.copy()


def edit_mode(head: Any) -> None:
    bpy.context.view_layer.objects.active = head
    bpy.ops.object.mode_set(mode="EDIT")


def remove_the_keys(head: Any) -> None:
    head.shape_key_clear()


def rename_the_keys(head: Any) -> None:
    for block in head.data.shape_keys.key_blocks[1:]:
        block.name = f"{block.name} of mine"


def tweak_mode(head: Any) -> None:
    animation = head.data.shape_keys.animation_data_create()
    track = animation.nla_tracks.new()
    track.strips.new("mine", 1, bpy.data.actions.new("mine"))
    track.select = True
    animation.use_tweak_mode = True


def rename_the_bones(head: Any) -> None:
    for bone in armature().data.bones:
        bone.name = f"{bone.name} of mine"


def remove_the_armature(head: Any) -> None:
    bpy.data.armatures.remove(armature().data)


def remove_the_armatures(head: Any) -> None:
    """With the copies."""
    for obj in [obj for obj in bpy.data.objects if obj.type == "ARMATURE"]:
        bpy.data.objects.remove(obj)


ON_KEYS = (other_vertices, mesh_of_its_own, edit_mode, remove_the_keys, rename_the_keys, tweak_mode)
ON_BONES = (other_vertices, edit_mode, rename_the_bones, remove_the_armature, remove_the_armatures)


def written() -> dict[str, object]:
    """All keyframes of the file, and which datablocks there are."""
    state: dict[str, object] = {
        action.name: [
            (curve.data_path, [tuple(point.co) for point in curve.keyframe_points]) for curve in all_curves(action)
        ]
        for action in bpy.data.actions
    }
    for kind in ("scenes", "objects", "meshes", "armatures", "shape_keys", "actions"):
        state[kind] = sorted(datablock.name for datablock in getattr(bpy.data, kind))
    return state


def is_copied(step: Any) -> bool:
    """Controls are being moved on a copy."""
    return NAME in bpy.data.scenes


def is_computed(step: Any) -> bool:
    """All that is left is writing."""
    return isinstance(step, Writing)


def refused(work: Any, head: Any, change: Callable[[Any], None], when: Callable[[Any], bool]) -> None:
    """Do the change once it is time for it; the work is refused then, and all is as with the change alone."""
    while not when(next(work)):
        pass
    before = written()
    change(head)
    changed = written()
    with pytest.raises((SceneError, ReferenceError)):  # the latter is told in words by operators: life/test_let_go
        run(work)
    after = written()
    copies = {kind: [n for n in before[kind] if n not in after[kind]] for kind in ("scenes", "objects", "meshes")}  # type: ignore[attr-defined,operator]
    assert not any(name == NAME for name in after["scenes"])  # type: ignore[attr-defined]
    for place, value in changed.items():
        if isinstance(value, list) and place in copies:
            assert after[place] == [name for name in value if name not in copies[place]]
        elif place not in ("armatures", "shape_keys"):
            assert after[place] == value, place
    for kind in ("armatures", "shape_keys"):
        assert set(after[kind]) <= set(changed[kind])  # type: ignore[call-overload]


@pytest.fixture
def keyed(drawn_head: Any) -> Any:
    """A face with a clip on its own keys."""
    drawn_head.risorius.bake.onto = "KEYS"
    drawn_head.risorius.emotion.word = "joy"
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    return drawn_head


@pytest.fixture
def boned(rigged: Any) -> Any:
    """A face with a clip on its bones."""
    bpy.context.view_layer.objects.active = rigged.head
    rigged.head.risorius.bake.onto = "BONES"
    rigged.head.risorius.emotion.word = "joy"
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    return rigged.head


@pytest.mark.parametrize("change", ON_KEYS, ids=lambda change: change.__name__)
def test_a_bake_onto_keys_is_refused(keyed: Any, change: Callable[[Any], None]) -> None:
    refused(expression_work(keyed, bpy.context.scene), keyed, change, is_computed)


def test_a_motion_onto_keys_is_refused(keyed: Any) -> None:
    bpy.context.scene.render.fps = 5
    refused(motion_work(keyed, bpy.context.scene), keyed, other_vertices, is_computed)


@pytest.mark.parametrize("when", [is_copied, is_computed])
@pytest.mark.parametrize("change", ON_BONES, ids=lambda change: change.__name__)
def test_a_bake_onto_bones_is_refused(boned: Any, change: Callable[[Any], None], when: Callable[[Any], bool]) -> None:
    refused(expression_work(boned, bpy.context.scene), boned, change, when)


def test_a_rig_that_goes_before_it_is_copied_is_refused(boned: Any) -> None:
    """The copy would be of another face."""
    refused(expression_work(boned, bpy.context.scene), boned, other_vertices, lambda step: step.text == LOOKING)
