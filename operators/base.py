"""The one base of all operators: runs, reports what Risorius refuses, and shows long work with a way out."""

from __future__ import annotations

import textwrap
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, ClassVar, TypeVar, final

import bpy

from ..errors import RisoriusError, SceneError
from ..progress import Progress, Work, run
from ..scene.blender_types import Event
from .blender_types import Context, Timer
from .requirements import MISSING, has_scipy, need_scipy
from .screen import show_status

if TYPE_CHECKING:
    from typing import Generic
else:

    class Generic:
        """Nothing at run time: typing's own keeps every class for ever, and bpy with it, which then hangs at exit."""

        def __class_getitem__(cls, result: object) -> type:
            return cls


T = TypeVar("T")

#: Seconds between two looks at the mouse and keyboard while work goes on.
INTERVAL = 0.01
#: Seconds of work per look.
SHARE = 0.05
#: Letters per line of a refusal that a window shows beside the mouse.
LINE = 76


@contextmanager
def removed_meanwhile(title: str) -> Iterator[None]:
    """Refuse in words what others have removed while work went on: Blender's own error names no object.

    Raises
    ------
    SceneError : the object, mesh or action that it worked on is gone.
    """
    try:
        yield
    except ReferenceError as gone:
        if "has been removed" not in str(gone):
            raise
        raise SceneError(title, "what it worked on was removed meanwhile; nothing has been changed") from gone


class RisoriusOperator:
    """Mix into `bpy.types.Operator`. A child says what it does in `run`, and in `refusal` when it cannot."""

    needs_scipy: ClassVar[bool] = True
    if TYPE_CHECKING:  # what Blender's operators have

        def report(self, kind: set[str], message: str) -> None:
            """Tell the user."""

        @classmethod
        def poll_message_set(cls, message: str) -> None:
            """Say why the button is grey."""

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Why the button is grey, or None."""
        return None

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Grey, with the reason, where it cannot work."""
        reason = f"{MISSING}: see the panel" if cls.needs_scipy and not has_scipy() else cls.refusal(context)
        if reason is not None:
            cls.poll_message_set(reason)
        return reason is None

    def run(self, context: Context) -> str:
        """Do it, and return what to tell the user. May raise RisoriusError; nothing has been changed then."""
        raise NotImplementedError

    @final
    def execute(self, context: Context) -> set[str]:
        """Run, and report what Risorius refuses. Anything else is a fault and propagates."""
        try:
            if self.needs_scipy:
                need_scipy()
            message = self.run(context)
        except RisoriusError as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        self.report({"INFO"}, message)
        return {"FINISHED"}


class WorkOperator(RisoriusOperator, Generic[T]):
    """Long work: with a window it runs between events and Esc cancels it; without one it runs straight through."""

    title: ClassVar[str] = "Working"
    _work: Work[T] | None = None
    _timer: Timer | None = None

    def work(self, context: Context) -> Work[T]:
        """The work. It changes the scene only after its last step, so closing it early leaves all as it was."""
        raise NotImplementedError

    def finish(self, context: Context, result: T) -> str:
        """What to tell the user of the result."""
        raise NotImplementedError

    def run(self, context: Context) -> str:
        """Run straight through."""
        return self.finish(context, run(self.work(context)))

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Run between events where there is a window to show it."""
        if bpy.app.background or context.window is None:
            return self.execute(context)
        try:
            if self.needs_scipy:
                need_scipy()
        except RisoriusError as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        self.begin(context)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def begin(self, context: Context) -> None:
        """Begin the work and its timer, whose ticks `modal` hears. Blender ends with an operator that listens twice."""
        self._work = self.work(context)
        manager = context.window_manager
        self._timer = manager.event_timer_add(INTERVAL, window=context.window)
        manager.progress_begin(0.0, 1.0)
        show_status(context, f"{self.title} ...")

    def modal(self, context: Context, event: Event) -> set[str]:
        """A share of the work at each tick of the timer; Esc cancels."""
        if event.type == "ESC" and event.value == "PRESS":
            self.stop(context)
            self.report({"WARNING"}, f"{self.title} was cancelled; nothing has been changed")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        try:
            with removed_meanwhile(self.title):
                return self._advance(context)
        except RisoriusError as refusal:
            self.stop(context)
            self.report({"ERROR"}, " \n".join(textwrap.wrap(str(refusal), LINE)))
            return {"CANCELLED"}
        except BaseException:
            self.stop(context)
            raise

    def _advance(self, context: Context) -> set[str]:
        """Work for a share of a second."""
        assert self._work is not None
        until = time.monotonic() + SHARE
        while True:
            try:
                step: Progress = next(self._work)
            except StopIteration as end:
                message = self.finish(context, end.value)
                self.stop(context)
                self.report({"INFO"}, message)
                return {"FINISHED"}
            if time.monotonic() >= until:
                context.window_manager.progress_update(step.fraction)
                show_status(context, f"{step.text} ({step.fraction:.0%})   Esc: Cancel")
                return {"RUNNING_MODAL"}

    def stop(self, context: Context) -> None:
        """Let go of the work, the timer and the status text."""
        if self._work is not None:
            self._work.close()
            self._work = None
        manager = context.window_manager
        if self._timer is not None:
            manager.event_timer_remove(self._timer)
            self._timer = None
        manager.progress_end()
        show_status(context, None)

    def cancel(self, context: Context) -> None:
        """Blender ends the operator itself, as when a file is loaded."""
        self.stop(context)
