"""Shows on the active face what is chosen for it, as it changes; nothing stays behind.

A change asks for a look, and a timer answers all changes since the last one at once: with a sketch while the user is
dragging, and with the face in balance when the hand rests. Saving, undo and the end of a session clear up.
"""

from __future__ import annotations

import time
from contextlib import ExitStack
from typing import Any

import bpy
import numpy as np
from bpy.app.handlers import persistent

from ...arrays import Floats
from ...errors import RisoriusError
from ...scene.bake import shape_keys
from ...scene.live import preview
from ...scene.live.live_face import LiveFace, uid_of
from ...scene.points.kept import has_points
from ...scene.progress import Progress, Work
from ..active import ready_reason, target_of
from ..changes import listen, listen_to_time
from ..emotion.performance import performance_of
from ..emotion.profile import Wanted, wanted_of
from ..muscles.props import shown

#: Seconds without a change after which the face is shown in balance, and between two shares of long work.
REST, PAUSE = 0.3, 0.01
#: Faces that are held ready, and expressions of them.
KEPT, KEPT_APEXES = 3, 24


class _Live:
    """What is known of the faces that are previewed, by their numbers.

    `asked` are those to be sketched, `rough` those that are sketched and not yet in balance, `seen` those that showed
    a preview before the file was saved or changed by undo.
    """

    def __init__(self) -> None:
        self.faces: dict[int, LiveFace] = {}
        self.asked: list[int] = []
        self.rough: list[int] = []
        self.seen: set[int] = set()
        self.since = 0.0
        self.work: Work[None] | None = None
        self.trouble = ""
        self.count = 0
        self.apexes: dict[tuple[int, str], Floats] = {}


_live = _Live()


def is_on() -> bool:
    """Whether the preview is switched on and can be seen."""
    manager = bpy.context.window_manager
    return not bpy.app.background and manager is not None and bool(manager.risorius.preview.show)


def why_not(obj: Any) -> str:
    """Why a face does not show what is chosen for it, or nothing."""
    if not is_on() or not has_points(obj):
        return ""
    return ready_reason(obj) or _live.trouble


def ask(obj: Any) -> None:
    """Show `obj` as it is chosen now, soon."""
    if not is_on() or getattr(obj, "type", "") != "MESH" or ready_reason(obj) is not None:
        return
    _live.since = time.monotonic()
    if uid_of(obj) not in _live.asked:
        _live.asked.append(uid_of(obj))
    if not bpy.app.timers.is_registered(_answer):
        bpy.app.timers.register(_answer, first_interval=0.0)


def refresh_active(context: Any) -> None:
    """Show the active face, where it is one."""
    if context.object is not None:
        ask(context.object)


def held(obj: Any) -> LiveFace | None:
    """The face of `obj`, where it is held ready."""
    return _live.faces.get(uid_of(obj)) if _live.work is None else None


def object_of(uid: int) -> Any | None:
    """The object of this number, or None where it is gone."""
    return next((obj for obj in bpy.data.objects if uid_of(obj) == uid), None)


def _answer() -> float | None:
    """Timer: do what is due, and say when to come again."""
    if not is_on() or not (_live.asked or _live.rough or _live.work):
        return None
    try:
        return _step()
    except RisoriusError as refusal:
        _live.trouble = str(refusal)
    _forget_work()
    _forget_asked()
    return None


def _forget_asked() -> None:
    """Nothing is due any more."""
    _live.asked.clear()
    _live.rough.clear()


def _step() -> float | None:
    """One share of work, one look, or the last one in balance."""
    if _live.work is not None:
        return _prepare()
    exact = not _live.asked
    if exact and time.monotonic() - _live.since < REST:
        return REST
    due = _live.rough if exact else _live.asked
    obj = object_of(due[0])
    if obj is not None and ready_reason(obj) is None:
        face = _face_of(obj)
        if _live.work is not None:
            return PAUSE
        show(obj, face, exact=exact)
        if not exact and due[0] not in _live.rough:
            _live.rough.append(due[0])
    del due[0]
    return 0.0


def _face_of(obj: Any) -> LiveFace:
    """The face of `obj`, read again where it has changed; its preparation becomes the work at hand."""
    uid, target = uid_of(obj), target_of(obj)
    face = _live.faces.get(uid)
    if face is None or not face.is_of(target):
        face = LiveFace(target)
        _live.faces.pop(uid, None)
        _live.faces[uid] = face
        _live.apexes = {key: moved for key, moved in _live.apexes.items() if key[0] != uid}
        while len(_live.faces) > KEPT:
            del _live.faces[next(iter(_live.faces))]
        _live.work = face.prepare()
    return face


def _prepare() -> float:
    """A share of the preparation, with its progress."""
    assert _live.work is not None
    try:
        step: Progress = next(_live.work)
    except StopIteration:
        _forget_work()
        return 0.0
    _progress(f"Getting the face ready: {step.text} ({step.fraction:.0%})")
    return PAUSE


def _forget_work() -> None:
    """Let go of the work at hand, and of its progress."""
    if _live.work is not None:
        _live.work.close()
        _live.work = None
        _progress(None)


def _progress(text: str | None) -> None:
    """Text in the status bars of all windows, or Blender's own again."""
    manager = bpy.context.window_manager
    for window in manager.windows if manager is not None else ():
        window.workspace.status_text_set(text)


def show(obj: Any, face: LiveFace | None = None, *, exact: bool = False) -> None:
    """Show `obj` as it is chosen now.

    Raises
    ------
    RisoriusError : it cannot be read or posed.
    """
    ready = face if face is not None else _face_of(obj)
    wanted = wanted_of(obj)
    ready.show(target_of(obj), _moved(ready, wanted, exact=exact))
    ready.paths = None
    if exact and bpy.context.window_manager.risorius.show.paths:
        ready.trace(wanted.frame, **_asked_of(wanted))
    shown[uid_of(obj)] = ready.contractions
    _live.trouble = ""


def _moved(face: LiveFace, wanted: Wanted, *, exact: bool) -> Floats:
    """(V, 3) displacement."""
    return face.moved(wanted.frame, **_asked_of(wanted), exact=exact)


def _asked_of(wanted: Wanted) -> dict[str, Any]:
    """What goes along with the FAPs."""
    return {"drive": wanted.drive, "emotion": wanted.profile.weights, "contractions": wanted.contractions}


def play(obj: Any, face: LiveFace, scene: Any) -> None:
    """Show `obj` as it is laid out at the scene's frame, out of the apexes of its expressions.

    Raises
    ------
    RisoriusError : an expression cannot be posed.
    """
    performance = performance_of(obj, scene)
    shares = performance.shares(scene.frame_current_final)
    if not shares.any():
        rest(obj)
        return
    apexes = [
        share * _apex(face, wanted) for share, wanted in zip(shares, performance.wanted, strict=True) if share > 0.0
    ]
    face.show(target_of(obj), np.sum(apexes, axis=0))


def _apex(face: LiveFace, wanted: Wanted) -> Floats:
    """(V, 3) displacement of an expression in full; the last ones are kept."""
    key = (face.uid, repr((wanted.frame.tolist(), wanted.drive, dict(wanted.contractions))))
    if key not in _live.apexes:
        while len(_live.apexes) >= KEPT_APEXES:
            del _live.apexes[next(iter(_live.apexes))]
        _live.apexes[key] = _moved(face, wanted, exact=False)
    return _live.apexes[key]


def rest(obj: Any) -> None:
    """Let `obj` show itself."""
    preview.rest([member for member in target_of(obj).objects() if member.type == "MESH"])


def end() -> None:
    """Take every preview away."""
    _forget_work()
    _live.__init__()  # type: ignore[misc]
    preview.remove_all()


def _after_frame(scene: Any, *_: Any) -> None:
    """Another frame: what is baked plays by itself, what is not is shown as it is laid out."""
    if not is_on() or bpy.app.is_job_running("RENDER"):
        return
    _forget_asked()
    for uid, face in tuple(_live.faces.items()):
        obj = object_of(uid)
        if obj is None or _live.work is not None:
            continue
        _play_or_rest(obj, face, scene)


def _play_or_rest(obj: Any, face: LiveFace, scene: Any) -> None:
    """Show `obj` as it is laid out, or as it is where that is baked or cannot be shown."""
    try:
        if shape_keys.has_own(obj) or ready_reason(obj) is not None or not face.is_of(target_of(obj)):
            rest(obj)
        else:
            play(obj, face, scene)
    except RisoriusError as refusal:
        _live.trouble = str(refusal)
        rest(obj)


def replay(obj: Any) -> None:
    """Show the scene's frame again: something on the timeline of `obj` has moved."""
    face = _live.faces.get(uid_of(obj))
    if is_on() and face is not None and _live.work is None:
        _forget_asked()
        _play_or_rest(obj, face, bpy.context.scene)


def _after_update(*_: Any) -> None:
    """Objects came or went: what is left of the preview of one that is gone goes, too."""
    count = len(bpy.data.objects)
    if count == _live.count or not _live.faces:
        return
    _live.count = count
    gone = [uid for uid in _live.faces if object_of(uid) is None]
    for uid in gone:
        del _live.faces[uid]
        shown.pop(uid, None)
    if gone:
        preview.remove_unused()


def _before_undo(*_: Any) -> None:
    """Remember who shows a preview."""
    _live.seen = {uid_of(obj) for obj in bpy.data.objects if obj.type == "MESH" and preview.is_shown(obj)}


def _before_save(*_: Any) -> None:
    """Nothing of a preview goes into a file."""
    _before_undo()
    preview.remove_all()


def _after_save(*_: Any) -> None:
    """Show again who did before."""
    for obj in bpy.data.objects:
        if uid_of(obj) in _live.seen:
            ask(obj)


def _after_undo(*_: Any) -> None:
    """The file is another one now: those who showed a preview show what is chosen now, the others themselves."""
    if not is_on():
        preview.remove_all()
        return
    for obj in bpy.data.objects:
        if uid_of(obj) in _live.seen:
            ask(obj)
        elif obj.type == "MESH" and preview.is_shown(obj):
            preview.rest([obj])


def _after_load(*_: Any) -> None:
    """Another file: nothing of the last one is known, and what a crash has left in this one goes."""
    end()


def _handlers() -> tuple[tuple[Any, Any], ...]:
    """Blender's events, and what is done then."""
    on = bpy.app.handlers
    return (
        (on.frame_change_post, _after_frame),
        (on.depsgraph_update_post, _after_update),
        (on.save_pre, _before_save),
        (on.save_post, _after_save),
        (on.save_post_fail, _after_save),
        (on.undo_pre, _before_undo),
        (on.redo_pre, _before_undo),
        (on.undo_post, _after_undo),
        (on.redo_post, _after_undo),
        (on.load_post, _after_load),
    )


def attach(undo: ExitStack) -> None:
    """Listen until undone, which clears up; a Blender without a window shows no preview."""
    undo.callback(_clear_up)
    listen(ask, undo)
    listen_to_time(replay, undo)
    if not bpy.app.background:
        for event, action in _handlers():
            event.append(persistent(action))
            undo.callback(event.remove, action)


def _clear_up() -> None:
    """Nothing is due any more, and nothing shows."""
    if bpy.app.timers.is_registered(_answer):
        bpy.app.timers.unregister(_answer)
    if hasattr(bpy.data, "objects"):
        end()
