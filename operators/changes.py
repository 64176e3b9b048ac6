"""Who is told when the user changes what a face is to show.

Properties name `changed` as their update; whatever shows or dates the result (a live preview, a baked clip) listens.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Listener = Callable[[Any], None]
_listeners: list[Listener] = []


def listen(listener: Listener) -> None:
    """Call `listener(obj)` after each change to what `obj` is to show."""
    if listener not in _listeners:
        _listeners.append(listener)


def unlisten(listener: Listener) -> None:
    """Call it no more."""
    if listener in _listeners:
        _listeners.remove(listener)


def changed(owner: Any, context: Any) -> None:
    """Tell the listeners; the update function of every property that a face's look depends on."""
    for listener in tuple(_listeners):
        listener(owner.id_data)
