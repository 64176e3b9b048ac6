"""Who is told when the user changes what a face is to show, or when.

Properties name `changed` or `retimed` as their update; whatever shows or dates the result (a live preview, a baked
clip) listens. What is one choice in two places (a clip and the panel that edits it) follows first, so that listeners
see both alike.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from typing import TypeVar

from .blender_classes import PropertyGroup
from .blender_types import Context, Object

T = TypeVar("T")
Listener = Callable[[Object], None]
Follower = Callable[[PropertyGroup], None]
_listeners: list[Listener] = []
_time_listeners: list[Listener] = []
_followers: list[Follower] = []


def listen(listener: Listener, undo: ExitStack) -> None:
    """Call `listener(obj)` after each change to what `obj` is to show, until undone."""
    _tell(_listeners, listener, undo)


def listen_to_time(listener: Listener, undo: ExitStack) -> None:
    """Call `listener(obj)` after each change to when `obj` is to show it, until undone."""
    _tell(_time_listeners, listener, undo)


def follow(follower: Follower, undo: ExitStack) -> None:
    """Call `follower(owner)` with the very group that changed, before all listeners, until undone."""
    _tell(_followers, follower, undo)


def _tell(told: list[T], listener: T, undo: ExitStack) -> None:
    """Put a listener on a list, and take it off when undone."""
    told.append(listener)
    undo.callback(told.remove, listener)


def changed(owner: PropertyGroup, context: Context | None = None) -> None:
    """Tell the listeners; the update function of every property that a face's look depends on."""
    for follower in tuple(_followers):
        follower(owner)
    for listener in tuple(_listeners):
        listener(owner.id_data)


def retimed(owner: PropertyGroup, context: Context | None = None) -> None:
    """Tell the listeners; the update function of every property that says when a face shows something."""
    for listener in tuple(_time_listeners):
        listener(owner.id_data)
