"""What operators hold that go on between events: timers, drawings, cursors, status bars; given back whatever happens.

Blender drops such an operator without a word when its class is taken out, as when the extension is disabled, and keeps
the rest for ever. So whatever is held is listed here, too, and `attach` gives it back.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from typing import ParamSpec

import bpy

from .blender_events import act_on
from .blender_types import Context

Asked = ParamSpec("Asked")

#: What Blender says of a datablock that it has let go of.
GONE = "has been removed"
#: All that is held now.
_held: list[Held] = []


class Held(ExitStack):
    """What one operator holds, with how each is given back; the last first, and each though another fails.

    Attributes
    ----------
    is_outdated : whether undo or redo has put other data in the place of what the operator began with.
    """

    def __init__(self) -> None:
        super().__init__()
        self.is_outdated = False
        _held.append(self)

    def gives_back(self, how: Callable[Asked, object], /, *arguments: Asked.args, **named: Asked.kwargs) -> None:
        """Call this to give something back, unless it is gone by then."""
        self.callback(_where_it_is, how, *arguments, **named)

    def holds_status(self, context: Context) -> None:
        """The status bar of the context's window is Blender's own again afterwards."""
        if context.workspace is not None:
            self.gives_back(context.workspace.status_text_set, None)

    def close(self) -> None:
        """Give all of it back; once is enough."""
        if self in _held:
            _held.remove(self)
        super().close()


def _where_it_is(how: Callable[Asked, object], /, *arguments: Asked.args, **named: Asked.kwargs) -> None:
    """Give something back; what Blender has let go of needs it no more."""
    try:
        how(*arguments, **named)
    except ReferenceError as gone:
        if GONE not in str(gone):
            raise


def held_now() -> int:
    """How many operators hold something."""
    return len(_held)


def _give_back() -> None:
    """Give everything back, whoever holds it."""
    for held in tuple(_held):
        held.close()


def _after_undo(*_: object) -> None:
    """What operators have begun with is gone."""
    for held in _held:
        held.is_outdated = True


def attach(undo: ExitStack) -> None:
    """Hear of undo until undone, which gives everything back."""
    undo.callback(_give_back)
    for event in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        act_on(event, _after_undo, undo)
