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
from ..scene.fingerprint import uid_of
from .blender_types import Context, Object, Scene
from .held import GONE, Held
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
        if GONE not in str(gone):
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
    """Long work: with a window it runs between events and Esc cancels it; without one it runs straight through.

    Others may select another object meanwhile: work and what is told of it stay with the object that was active at the
    beginning, which `context.object` is for both. Where undo or another scene takes its place, the work ends.
    """

    title: ClassVar[str] = "Working"
    _work: Work[T] | None = None
    _held: Held | None = None
    _about: tuple[Object, Scene] | None = None

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
        self._work, self._held, manager = self.work(context), Held(), context.window_manager
        self._about = None if context.object is None else (context.object, context.scene)
        self._held.holds_status(context)
        manager.progress_begin(0.0, 1.0)
        self._held.gives_back(manager.progress_end)
        timer = manager.event_timer_add(INTERVAL, window=context.window)
        self._held.gives_back(manager.event_timer_remove, timer)
        self._held.gives_back(self._work.close)
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
            with removed_meanwhile(self.title), self._on_what_it_began_with(context):
                return self._advance(context)
        except RisoriusError as refusal:
            self.stop(context)
            self.report({"ERROR"}, " \n".join(textwrap.wrap(str(refusal), LINE)))
            return {"CANCELLED"}
        except BaseException:
            self.stop(context)
            raise

    @contextmanager
    def _on_what_it_began_with(self, context: Context) -> Iterator[None]:
        """The object that the work is about as the active one, whatever else is selected now.

        Raises
        ------
        SceneError : undo or another scene has taken its place. ReferenceError : it is gone.
        """
        if self._held is not None and self._held.is_outdated:
            raise SceneError(self.title, "was ended by undo or redo; nothing has been changed: start it again")
        if self._about is None:
            yield
            return
        obj, scene = self._about
        if context.scene != scene:
            back = f"go back to the scene {scene.name} and start it again"
            raise SceneError(self.title, f"was ended because the scene was switched; nothing has been changed: {back}")
        uid_of(obj)  # raises at once, not after the last step
        with bpy.context.temp_override(object=obj, active_object=obj):
            yield

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
        if self._held is not None:
            self._held.close()
        self._work = self._held = self._about = None

    def cancel(self, context: Context) -> None:
        """Blender ends the operator itself, as when a file is loaded."""
        self.stop(context)
