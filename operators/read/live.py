"""Keeps the reading of the active face up to date while a panel shows it.

Panels compute nothing: a panel that is drawn says so, and a timer reads what has changed since, at most ten times a
second, and less often where reading takes long. A closed panel is not drawn, so nothing is read for it.
"""

from __future__ import annotations

import time
from contextlib import ExitStack

import bpy

from ...errors import RisoriusError
from ...scene.blender_types import Depsgraph
from ...scene.fingerprint import uid_of
from ...scene.live.reading import FaceReader, Reading
from ..active import reading_reason
from ..blender_events import act_on
from ..blender_types import Context, Object
from ..screen import windows
from ..session import session

#: Least seconds between two readings, and least multiple of the time that the last one took.
PACE, SHARE = 0.1, 4.0


def shown(obj: Object) -> tuple[Reading | None, str]:
    """The last reading of `obj`, or None, and why there is none; called by a panel while it is drawn."""
    read = session().read
    read.was_drawn = True
    if read.ids != _ids(obj):
        read.ids, read.reading, read.trouble, read.is_stale = _ids(obj), None, "", True
    if read.is_stale:
        _soon()
    return read.reading, read.trouble


def ask() -> None:
    """Something has changed: read again, soon, if a panel shows it."""
    session().read.is_stale = True
    if session().read.was_drawn:
        _soon()


def refresh(obj: Object) -> None:
    """Read `obj` now."""
    from ... import api

    read = session().read
    read.is_stale, read.was_drawn, read.ids = False, False, _ids(obj)
    read.trouble = reading_reason(obj) or ""
    if read.trouble:
        read.reader = read.reading = None
        return
    try:
        if read.reader is None or not read.reader.is_of(obj):
            read.reader = FaceReader(obj)
        context: Context = bpy.context
        rule, graph = context.scene.risorius.read.rule, context.evaluated_depsgraph_get()
        read.reading = read.reader.read(graph, rule=rule, words=api.WORDS)
    except RisoriusError as refusal:
        read.reading, read.trouble = None, str(refusal)


def forget() -> None:
    """Let go of the face, as after an undo or when another file is opened."""
    read = session().read
    read.reader = read.reading = read.ids = None
    ask()


def _ids(obj: Object) -> tuple[int, int]:
    """Numbers of an object and its mesh."""
    return uid_of(obj), uid_of(obj.data)


def _soon() -> None:
    """Read as soon as the pace allows."""
    if not bpy.app.background and not bpy.app.timers.is_registered(_read):
        bpy.app.timers.register(_read, first_interval=_wait(time.monotonic()))


def _wait(now: float) -> float:
    """Seconds until the next reading."""
    read = session().read
    return max(0.0, read.last + max(PACE, SHARE * read.cost) - now)


def _read() -> None:
    """Timer: read the active face, and have the panels drawn again."""
    context: Context = bpy.context
    obj, read = context.object, session().read
    if not read.is_stale or obj is None or obj.type != "MESH" or bpy.app.is_job_running("RENDER"):
        return
    read.last = time.monotonic()
    refresh(obj)
    read.cost = time.monotonic() - read.last
    for window in windows():
        for area in window.screen.areas:
            for region in area.regions if area.type == "VIEW_3D" else ():
                if region.type == "UI":
                    region.tag_redraw()


def _after_frame(*_: object) -> None:
    """Another frame."""
    ask()


def _after_update(_scene: object, depsgraph: Depsgraph | None) -> None:
    """Something was evaluated anew: the face, perhaps."""
    read = session().read
    if not read.was_drawn or read.ids is None:
        read.is_stale = True
        return
    graph: Depsgraph = depsgraph if depsgraph is not None else bpy.context.evaluated_depsgraph_get()
    if any(update.id.original.session_uid in read.ids for update in graph.updates):
        ask()


def _after_change_of_file(*_: object) -> None:
    """All objects are new ones."""
    forget()


def attach(undo: ExitStack) -> None:
    """Listen until undone."""
    undo.callback(_clear_up)
    events = bpy.app.handlers
    for event, action in (
        (events.frame_change_post, _after_frame),
        (events.depsgraph_update_post, _after_update),
        (events.undo_post, _after_change_of_file),
        (events.redo_post, _after_change_of_file),
        (events.load_post, _after_change_of_file),
    ):
        act_on(event, action, undo)


def _clear_up() -> None:
    """Nothing is due any more."""
    if bpy.app.timers.is_registered(_read):
        bpy.app.timers.unregister(_read)
