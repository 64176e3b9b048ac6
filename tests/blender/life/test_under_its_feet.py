"""What others do while Risorius works: objects, meshes, keys and actions that go, change or get other names.

Work is done in steps between events. Between two steps a script, a timer or an add-on may do anything. Then the work
ends well or is refused in words, and nothing is half done.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import pytest
from file_state import differences, file_state
from risorius.errors import RisoriusError
from risorius.operators.bake import work as works
from risorius.operators.base import WorkOperator


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


def edit_mode(head: Any) -> None:
    bpy.context.view_layer.objects.active = head
    bpy.ops.object.mode_set(mode="EDIT")


def out_of_the_scene(head: Any) -> None:
    for collection in head.users_collection:
        collection.objects.unlink(head)


def other_file(head: Any) -> None:
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


CHANGES = (
    remove_the_object, remove_the_mesh, other_mesh, rename_all, remove_the_keys, remove_the_actions, more_vertices,
    edit_mode, out_of_the_scene, other_file,
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
@pytest.mark.parametrize("change", CHANGES, ids=lambda change: change.__name__)
@pytest.mark.parametrize("kind", WORKS)
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
