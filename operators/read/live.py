"""Keeps the reading of the active face up to date while a panel shows it.

Panels compute nothing: a panel that is drawn says so, and a timer reads what has changed since, at most ten times a
second, and less often where reading takes long. A closed panel is not drawn, so nothing is read for it.
"""

from __future__ import annotations

import time
from contextlib import ExitStack
from typing import Any

import bpy
from bpy.app.handlers import persistent

from ...errors import RisoriusError
from ...scene.live.live_face import uid_of
from ...scene.live.reading import FaceReader, Reading
from ..active import reading_reason

#: Least seconds between two readings, and least multiple of the time that the last one took.
PACE, SHARE = 0.1, 4.0


class _Live:
    """The face that is read, its last reading, and whether a panel has shown that."""

    def __init__(self) -> None:
        self.reader: FaceReader | None = None
        self.reading: Reading | None = None
        self.of: tuple[int, int] | None = None  # object and mesh
        self.trouble = ""
        self.is_stale = True
        self.was_drawn = False
        self.last, self.cost = -float("inf"), 0.0


_live = _Live()


def shown(obj: Any) -> tuple[Reading | None, str]:
    """The last reading of `obj`, or None, and why there is none; called by a panel while it is drawn."""
    _live.was_drawn = True
    if _live.of != _ids(obj):
        _live.of, _live.reading, _live.trouble, _live.is_stale = _ids(obj), None, "", True
    if _live.is_stale:
        _soon()
    return _live.reading, _live.trouble


def ask() -> None:
    """Something has changed: read again, soon, if a panel shows it."""
    _live.is_stale = True
    if _live.was_drawn:
        _soon()


def refresh(obj: Any) -> None:
    """Read `obj` now."""
    from ... import api

    _live.is_stale, _live.was_drawn, _live.of = False, False, _ids(obj)
    _live.trouble = reading_reason(obj) or ""
    if _live.trouble:
        _live.reader = _live.reading = None
        return
    try:
        if _live.reader is None or not _live.reader.is_of(obj):
            _live.reader = FaceReader(obj)
        rule = bpy.context.scene.risorius.read.rule
        graph = bpy.context.evaluated_depsgraph_get()
        _live.reading = _live.reader.read(graph, rule=rule, words=api.WORDS)
    except RisoriusError as refusal:
        _live.reading, _live.trouble = None, str(refusal)


def forget() -> None:
    """Let go of the face, as after an undo or when another file is opened."""
    _live.reader = _live.reading = _live.of = None
    ask()


def _ids(obj: Any) -> tuple[int, int]:
    """Numbers of an object and its mesh."""
    return uid_of(obj), uid_of(obj.data)


def _soon() -> None:
    """Read as soon as the pace allows."""
    if not bpy.app.background and not bpy.app.timers.is_registered(_read):
        bpy.app.timers.register(_read, first_interval=_wait(time.monotonic()))


def _wait(now: float) -> float:
    """Seconds until the next reading."""
    return max(0.0, _live.last + max(PACE, SHARE * _live.cost) - now)


def _read() -> None:
    """Timer: read the active face, and have the panels drawn again."""
    obj = bpy.context.object
    if not _live.is_stale or obj is None or obj.type != "MESH" or bpy.app.is_job_running("RENDER"):
        return
    _live.last = time.monotonic()
    refresh(obj)
    _live.cost = time.monotonic() - _live.last
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions if area.type == "VIEW_3D" else ():
                if region.type == "UI":
                    region.tag_redraw()


def _after_frame(*_: Any) -> None:
    """Another frame."""
    ask()


def _after_update(_scene: Any, depsgraph: Any = None) -> None:
    """Something was evaluated anew: the face, perhaps."""
    if not _live.was_drawn or _live.of is None:
        _live.is_stale = True
        return
    graph = depsgraph if depsgraph is not None else bpy.context.evaluated_depsgraph_get()
    if any(update.id.original.session_uid in _live.of for update in graph.updates):
        ask()


def _after_change_of_file(*_: Any) -> None:
    """All objects are new ones."""
    forget()


def _handlers() -> tuple[tuple[Any, Any], ...]:
    """Blender's events, and what is done then."""
    on = bpy.app.handlers
    return (
        (on.frame_change_post, _after_frame),
        (on.depsgraph_update_post, _after_update),
        (on.undo_post, _after_change_of_file),
        (on.redo_post, _after_change_of_file),
        (on.load_post, _after_change_of_file),
    )


def attach(undo: ExitStack) -> None:
    """Listen until undone, and keep nothing then."""
    undo.callback(_clear_up)
    for event, action in _handlers():
        event.append(persistent(action))
        undo.callback(event.remove, action)


def _clear_up() -> None:
    """Nothing is due any more, and nothing is known."""
    if bpy.app.timers.is_registered(_read):
        bpy.app.timers.unregister(_read)
    _live.__init__()  # type: ignore[misc]
