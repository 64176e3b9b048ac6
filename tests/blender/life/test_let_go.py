"""What an operator holds while it works between events is given back however it ends, and it stays with its object."""

from __future__ import annotations

from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import bpy
import pytest
import risorius
from risorius.operators.bake.ops import BakeOperator
from risorius.operators.bake.work import expression_work
from risorius.operators.base import WorkOperator
from risorius.operators.held import held_now
from risorius.progress import Progress


class Tick:
    """A tick of the timer."""

    type, value = "TIMER", "NOTHING"


class Window(SimpleNamespace):
    """What an operator asks a window for, and whether it has given it back."""

    def __init__(self) -> None:
        super().__init__(timers=0, progresses=0, status="", window=None, workspace=self, window_manager=self)

    @property
    def object(self) -> Any:
        """The active one."""
        return bpy.context.object

    @property
    def scene(self) -> Any:
        """The open one."""
        return bpy.context.scene

    def event_timer_add(self, step: float, *, window: Any) -> str:
        self.timers += 1
        return "timer"

    def event_timer_remove(self, timer: str) -> None:
        self.timers -= 1

    def progress_begin(self, first: float, last: float) -> None:
        self.progresses += 1

    def progress_update(self, share: float) -> None:
        """Shown."""

    def progress_end(self) -> None:
        self.progresses -= 1

    def status_text_set(self, text: str | None) -> None:
        self.status = text

    @property
    def is_free(self) -> bool:
        """Whether all of it is back."""
        return (self.timers, self.progresses, self.status) == (0, 0, None)


class Telling:
    """Keeps what an operator reports."""

    def __init__(self) -> None:
        self.said: list[tuple[str, str]] = []

    def report(self, kind: set[str], message: str) -> None:
        self.said.append((*kind, message))  # type: ignore[arg-type]


class Endless(Telling, WorkOperator[Any]):
    """Work that goes on until it is ended, and notes that."""

    title = "Testing"
    was_closed, fails = False, False

    def work(self, context: Any) -> Iterator[Progress]:  # type: ignore[override]
        try:
            while True:
                yield Progress(0.5, "Working")
        finally:
            self.was_closed = True
            if self.fails:
                raise ValueError("while tidying up")


class Bake(Telling, BakeOperator):  # type: ignore[misc]
    """Bakes the chosen expression."""

    title = "Baking"

    def baking(self, context: Any) -> Any:
        return expression_work(context.object, context.scene)


@pytest.fixture(autouse=True)
def _step_by_step(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("risorius.operators.base.SHARE", 0.0)


def begun(operator: Any, window: Window) -> Any:
    """An operator after a few ticks."""
    operator.begin(window)
    for _ in range(3):
        assert operator.modal(window, Tick()) == {"RUNNING_MODAL"}
    assert (window.timers, window.progresses) == (1, 1)
    assert window.status
    return operator


def ended(operator: Any, window: Window) -> set[str]:
    """It is ticked until its end."""
    result = {"RUNNING_MODAL"}
    while result == {"RUNNING_MODAL"}:
        result = operator.modal(window, Tick())
    assert window.is_free
    assert not held_now()
    return result


def test_disabling_the_extension_gives_all_of_it_back(cube: Any) -> None:
    """Blender drops the operator without a word and would keep its timer and its status bar for ever."""
    window = Window()
    operator = begun(Endless(), window)
    risorius.unregister()
    try:
        assert window.is_free
        assert operator.was_closed
    finally:
        risorius.register()
    operator.cancel(window)  # once is enough
    assert window.is_free


def test_work_that_fails_while_it_is_ended_leaves_nothing_behind(cube: Any) -> None:
    window = Window()
    operator = begun(Endless(), window)
    operator.fails = True
    with pytest.raises(ValueError, match="tidying"):
        operator.cancel(window)
    assert window.is_free


def test_undo_ends_work_at_once_and_in_words(cube: Any) -> None:
    """What it began with has been replaced: to go on would be for nothing."""
    bpy.ops.ed.undo_push(message="start")
    cube.location.x = 1.0
    bpy.ops.ed.undo_push(message="moved")
    window = Window()
    operator = begun(Endless(), window)
    bpy.ops.ed.undo()
    assert operator.modal(window, Tick()) == {"CANCELLED"}
    assert window.is_free
    assert operator.said == [("ERROR", "Testing: was ended by undo or redo; nothing has been changed: start it again")]


def test_an_object_that_is_removed_ends_work_at_once(cube: Any) -> None:
    window = Window()
    operator = begun(Endless(), window)
    bpy.data.objects.remove(cube)
    assert operator.modal(window, Tick()) == {"CANCELLED"}
    assert window.is_free
    assert "was removed meanwhile" in operator.said[-1][1]


def test_another_scene_ends_work_in_words(cube: Any) -> None:
    window = Window()
    operator = begun(Endless(), window)
    with bpy.context.temp_override(scene=bpy.data.scenes.new("Other")):
        assert operator.modal(window, Tick()) == {"CANCELLED"}
    assert "go back to the scene Scene" in operator.said[-1][1].replace("\n", "")


@pytest.mark.slow
@pytest.mark.parametrize("other", [None, "Cube"])
def test_a_bake_stays_with_its_object_whatever_is_selected_meanwhile(head: Any, other: str | None) -> None:
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.view_layer.objects.active = head
    head.risorius.emotion.word = "joy"
    window = Window()
    operator = begun(Bake(), window)
    bpy.context.view_layer.objects.active = None if other is None else bpy.data.objects[other]
    assert ended(operator, window) == {"FINISHED"}
    assert "Risorius Head joy" in operator.said[-1][1]
    assert [key.name for key in head.data.shape_keys.key_blocks] == ["Basis", "joy"]
