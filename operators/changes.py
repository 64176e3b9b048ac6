"""Who is told when the user changes what a face is to show, or when.

Properties name `changed` or `retimed` as their update; whatever shows or dates the result (a live preview, a baked
clip) listens. What is one choice in two places (a clip and the panel that edits it) follows first, so that listeners
see both alike.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Listener = Callable[[Any], None]
_listeners: list[Listener] = []
_time_listeners: list[Listener] = []
_followers: list[Listener] = []


def listen(listener: Listener) -> None:
    """Call `listener(obj)` after each change to what `obj` is to show."""
    if listener not in _listeners:
        _listeners.append(listener)


def listen_to_time(listener: Listener) -> None:
    """Call `listener(obj)` after each change to when `obj` is to show it."""
    if listener not in _time_listeners:
        _time_listeners.append(listener)


def follow(follower: Listener) -> None:
    """Call `follower(owner)` with the very group that changed, before all listeners."""
    if follower not in _followers:
        _followers.append(follower)


def unlisten(listener: Listener) -> None:
    """Call it no more."""
    for told in (_listeners, _time_listeners, _followers):
        if listener in told:
            told.remove(listener)


def changed(owner: Any, context: Any) -> None:
    """Tell the listeners; the update function of every property that a face's look depends on."""
    for follower in tuple(_followers):
        follower(owner)
    for listener in tuple(_listeners):
        listener(owner.id_data)


def retimed(owner: Any, context: Any) -> None:
    """Tell the listeners; the update function of every property that says when a face shows something."""
    for listener in tuple(_time_listeners):
        listener(owner.id_data)
