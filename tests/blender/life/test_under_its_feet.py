"""What others do while Risorius works: objects, meshes, keys and actions that go, change or get other names.

Work is done in steps between events. Between two steps a script, a timer or an add-on may do anything. Then the work
ends well or is refused in words, and nothing is half done.
"""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
from file_state import differences, file_state
from risorius.errors import RisoriusError, SceneError
from risorius.operators.bake import work as works
from risorius.operators.base import WorkOperator
from risorius.operators.face.six import RISORIUS_OT_bake_six
from risorius.progress import run
from risorius.scene.faces import FaceSource


def remove_the_object(head: Any) -> None:
    bpy.data.objects.remove(head)


def remove_the_mesh(head: Any) -> None:
    bpy.data.meshes.remove(head.data)


def other_mesh(head: Any) -> None:
    head.data = bpy.data.meshes.new("other")


def rename_all(head: Any) -> None:
    head.name, head.data.name = "Other", "Other mesh"
    if head.data.shape_keys is not None:
        for block in head.data.shape_keys.key_blocks[1:]:
            block.name = f"{block.name} of mine"
    for action in bpy.data.actions:
        action.name = "Other action"


def remove_the_keys(head: Any) -> None:
    head.shape_key_clear()


def remove_the_actions(head: Any) -> None:
    for action in list(bpy.data.actions):
        bpy.data.actions.remove(action)


def more_vertices(head: Any) -> None:
    head.data.vertices.add(7)
    head.data.update()


def other_vertices(head: Any) -> None:
    """As many as before, elsewhere."""
    places = np.empty(3 * len(head.data.vertices), dtype=np.float32)
    basis = head.data.shape_keys.key_blocks[0].data
    basis.foreach_get("co", places)
    basis.foreach_set("co", 1.3 * places)
    head.data.update()


def other_polygons(head: Any) -> None:
    """The same, inside out."""
    head.data.flip_normals()


def another_scale(head: Any) -> None:
    head.scale = (2.0, 2.0, 2.0)
    bpy.context.view_layer.update()


def another_user(head: Any) -> None:
    bpy.context.collection.objects.link(head.copy())


def joined(head: Any) -> None:
    bpy.ops.mesh.primitive_cube_add()
    head.select_set(True)
    bpy.context.view_layer.objects.active = head
    bpy.ops.object.join()


def sculpt_mode(head: Any) -> None:
    bpy.context.view_layer.objects.active = head
    bpy.ops.object.mode_set(mode="SCULPT")


def tweak_mode(head: Any) -> None:
    animation = head.data.shape_keys.animation_data
    track = animation.nla_tracks.new()
    track.strips.new("mine", 1, bpy.data.actions.new("mine"))
    track.select = True
    animation.use_tweak_mode = True


def edit_mode(head: Any) -> None:
    bpy.context.view_layer.objects.active = head
    bpy.ops.object.mode_set(mode="EDIT")


def out_of_the_scene(head: Any) -> None:
    for collection in head.users_collection:
        collection.objects.unlink(head)


def other_file(head: Any) -> None:
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


#: These would bake what was computed for something else, or onto something else.
REFUSED = (
    other_mesh, more_vertices, other_vertices, other_polygons, another_scale, another_user, joined, edit_mode,
    sculpt_mode, tweak_mode,
)  # fmt: skip
CHANGES = (
    *REFUSED, remove_the_object, remove_the_mesh, rename_all, remove_the_keys, remove_the_actions, out_of_the_scene,
    other_file,
)  # fmt: skip
WORKS = {"expression": works.expression_work, "motion": works.motion_work}


class Ticking(WorkOperator[Any]):
    """The modal operator as Blender runs it, without a window."""

    title = "Testing"

    def __init__(self, work: Any) -> None:
        self._work, self.said, self.finished = work, [], None

    def report(self, kind: set[str], message: str) -> None:
        """Keep it."""
        self.said.append((*kind, message))

    def finish(self, context: Any, result: Any) -> str:
        """Keep it."""
        self.finished = result
        return "done"


class Tick:
    """A tick of the timer."""

    type, value = "TIMER", "NOTHING"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "change"),
    [("expression", change) for change in CHANGES]
    + [("motion", change) for change in CHANGES if change not in REFUSED[2:7]],
    ids=lambda part: part if isinstance(part, str) else part.__name__,
)
def test_a_bake_ends_well_or_is_refused_in_words(
    head: Any, kind: str, change: Callable[[Any], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A second bake, so that keys and actions are there; the change comes when half of it is done."""
    monkeypatch.setattr("risorius.operators.base.SHARE", 0.0)
    bpy.context.scene.render.fps = 5
    head.risorius.emotion.word = "joy"
    bpy.ops.risorius.bake_expression()
    operator = Ticking(WORKS[kind](head, bpy.context.scene))
    for _ in range(3):
        assert operator.modal(bpy.context, Tick()) == {"RUNNING_MODAL"}
    change(head)
    before = file_state()
    ended = {"RUNNING_MODAL"}
    while ended == {"RUNNING_MODAL"}:
        ended = operator.modal(bpy.context, Tick())
    if operator.finished is not None:
        assert ended == {"FINISHED"}
        assert change not in REFUSED
        return
    assert ended == {"CANCELLED"}
    assert operator.said[-1][0] == "ERROR"
    assert differences(before, file_state()) == []


def test_work_whose_object_is_gone_is_refused_in_words(cube: Any) -> None:
    def work() -> Any:
        yield None
        return cube.name

    operator = Ticking(work())
    next(operator._work)
    bpy.data.objects.remove(cube)
    assert operator.modal(bpy.context, Tick()) == {"CANCELLED"}
    assert operator.said == [("ERROR", "Testing: what it worked on was removed meanwhile; nothing has been changed")]


def test_a_fault_is_no_refusal(cube: Any) -> None:
    def work() -> Any:
        yield None
        raise ReferenceError("of something else")

    operator = Ticking(work())
    next(operator._work)
    with pytest.raises(ReferenceError):
        operator.modal(bpy.context, Tick())
    assert RisoriusError not in ReferenceError.__mro__


@pytest.mark.slow
@pytest.mark.parametrize("ending", ["cancelled", "refused"])
def test_six_emotions_are_all_baked_or_none(head: Any, ending: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also where one of them was there before: it is replaced with the others, or stays."""
    head.risorius.emotion.word = "joy"
    head.risorius.emotion.activation = 2.0
    bpy.ops.risorius.bake_expression()
    own, before = own_state(head), file_state()
    work = RISORIUS_OT_bake_six.baking(SimpleNamespace(), bpy.context)
    step = next(work)
    while step.fraction < 0.95:
        step = next(work)
    if ending == "cancelled":
        work.close()
    else:
        monkeypatch.setattr(FaceSource, "refuse_changed", refuse)
        with pytest.raises(SceneError, match="changed"):
            run(work)
    assert own_state(head) == own
    assert differences(before, file_state()) == []


def refuse(source: FaceSource, **_: bool) -> None:
    """Something was changed."""
    raise SceneError(source.head.name, "was changed")


def own_state(head: Any) -> dict[str, bytes]:
    """The shapes of all keys."""
    shapes = {}
    for block in head.data.shape_keys.key_blocks:
        places = np.empty(3 * len(block.data), dtype=np.float32)
        block.data.foreach_get("co", places)
        shapes[block.name] = places.tobytes()
    return shapes | {f"action {action.name}": b"" for action in bpy.data.actions}
