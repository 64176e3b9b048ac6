"""Shows on the active face what is chosen for it, as it changes; nothing stays behind.

A change asks for a look, and a timer answers all changes since the last one at once: with a sketch while the user is
dragging, and with the face in balance when the hand rests. `events` clears up when Blender saves, undoes or ends.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import TYPE_CHECKING, TypedDict

import bpy
import numpy as np

from ...arrays import Floats
from ...errors import RisoriusError
from ...scene.bake import shape_keys
from ...scene.bake.motion import Motion
from ...scene.bake.remarks import unmet_remarks
from ...scene.bake.speech_motion import SpeechMotion
from ...scene.fingerprint import uid_of
from ...scene.live import preview
from ...scene.live.held_faces import REST
from ...scene.live.live_face import LiveFace
from ...scene.live.played import PlayedMotion
from ...scene.points.kept import has_points
from ...scene.rig.clips import rig_clips
from ..active import object_of, ready_reason, target_of
from ..bake.settings import motion_of, played_settings
from ..blender_types import Context, Object, Scene, WindowManager
from ..emotion.performance import Performance, performance_of
from ..emotion.profile import Wanted, wanted_of
from ..screen import is_playing, show_status_everywhere
from ..session import Previews, Shown, session

if TYPE_CHECKING:
    from ...api import EmotionShares

#: Seconds between two shares of long work.
PAUSE = 0.01
#: Seconds of each answer for which a face is got ready, in small steps.
SHARE = 0.05
#: The same while the timeline plays.
BETWEEN_FRAMES = 0.01


def is_on() -> bool:
    """Whether the preview is switched on and can be seen."""
    manager: WindowManager | None = bpy.context.window_manager
    return not bpy.app.background and manager is not None and bool(manager.risorius.preview.show)


def why_not(obj: Object) -> str:
    """Why a face does not show what is chosen for it, or not all of it; or nothing."""
    if not is_on() or not has_points(obj):
        return ""
    seen = shown(obj)
    return ready_reason(obj) or session().previews.trouble or "; ".join(seen.unmet if seen else ())


def ask(obj: Object) -> None:
    """Show `obj` as it is chosen now, soon."""
    if not is_on() or getattr(obj, "type", "") != "MESH" or ready_reason(obj) is not None:
        return
    session().previews.due.ask(uid_of(obj), time.monotonic())
    if not bpy.app.timers.is_registered(_answer):
        bpy.app.timers.register(_answer, first_interval=0.0)


def refresh_active(context: Context) -> None:
    """Show the active face, where it is one."""
    if context.object is not None:
        ask(context.object)


def held(obj: Object) -> LiveFace | None:
    """The face of `obj`, where it is held ready."""
    return session().previews.faces.get(uid_of(obj))


def shown(obj: Object) -> Shown | None:
    """What the preview shows on `obj`, or showed last."""
    return session().previews.shown.get(uid_of(obj))


def _answer() -> float | None:
    """Timer: do what is due, and say when to come again."""
    previews = session().previews
    faces = previews.faces
    if not is_on() or not (previews.due or previews.to_play or faces.is_preparing or faces.has_more):
        return None
    try:
        if faces.is_preparing:
            return _prepare(previews)
        if previews.to_play and not previews.due:
            return _play_waiting(previews)
        return _look(previews) if previews.due else _go_on(previews)
    except RisoriusError as refusal:
        previews.trouble = str(refusal)
    faces.drop()
    previews.due.clear()
    previews.to_play.clear()
    show_status_everywhere(None)
    return None


def _look(previews: Previews) -> float:
    """The look that is due; returns the seconds until the next one."""
    look = previews.due.next(time.monotonic())
    if look is None:
        return REST
    obj = object_of(look.uid)
    if obj is None or ready_reason(obj) is not None:
        previews.due.done(look, shown=False)
        return 0.0
    face = previews.faces.current(target_of(obj), glimpse=not look.exact)
    if face is None:
        return PAUSE
    show(obj, face, exact=look.exact)
    previews.due.done(look, shown=True)
    return 0.0


def _play_waiting(previews: Previews) -> float:
    """The next face that waits to be shown as laid out; returns the seconds until the next answer."""
    uid = next(iter(previews.to_play))
    obj = object_of(uid)
    face = previews.faces.current(target_of(obj)) if obj is not None and may_play(obj) else None
    if face is None and previews.faces.is_preparing:
        return PAUSE
    previews.to_play.discard(uid)
    if obj is not None and face is not None:
        play_or_rest(obj, face, bpy.context.scene)
    return 0.0


def may_play(obj: Object) -> bool:
    """Whether something is laid out for a face that is not baked, and it can be shown."""
    if obj.type != "MESH" or not (obj.risorius.timeline.clips or obj.risorius.speech.strips):
        return False
    return not shape_keys.has_own(obj) and not rig_clips(obj) and ready_reason(obj) is None


def ask_to_play(obj: Object) -> None:
    """Show `obj` as it is laid out at the scene's frame, as soon as its face is ready."""
    if is_on() and may_play(obj):
        session().previews.to_play.add(uid_of(obj))
        if not bpy.app.timers.is_registered(_answer):
            bpy.app.timers.register(_answer, first_interval=0.0)


def ask_again(obj: Object) -> None:
    """Show `obj` again as it was shown last, soon: as it is laid out, or as it is chosen."""
    if uid_of(obj) in session().previews.laid_out and may_play(obj):
        ask_to_play(obj)
    else:
        ask(obj)


def _prepare(previews: Previews) -> float:
    """A share of getting a face ready, with its progress; returns the seconds until the next one."""
    until = time.monotonic() + SHARE
    step = previews.faces.prepare()
    while step is not None and time.monotonic() < until:
        step = previews.faces.prepare()
    if step is None:
        show_status_everywhere(None)
        return 0.0
    show_status_everywhere(f"Preparing the face: {step.text} ({step.fraction:.0%})")
    return PAUSE


def _go_on(previews: Previews) -> float:
    """A share of what can be done while nothing is due; returns the seconds until the next one."""
    until = time.monotonic() + (BETWEEN_FRAMES if is_playing() else SHARE)
    while previews.faces.has_more and time.monotonic() < until:
        previews.faces.go_on()
    return PAUSE


def show(obj: Object, face: LiveFace, *, exact: bool) -> None:
    """Show `obj` as it is chosen now: as a sketch, or in balance and, where they are wanted, with the ways there.

    Raises
    ------
    RisoriusError : it cannot be posed.
    """
    wanted, previews = wanted_of(obj), session().previews
    pose = face.pose(wanted.faps, **_asked_of(wanted), exact=exact, passing=not exact)
    face.show(target_of(obj), pose.displacement)
    previews.laid_out.discard(face.uid)
    context: Context = bpy.context
    with_paths = exact and context.window_manager.risorius.show.paths
    paths = face.paths_to(wanted.faps, **_asked_of(wanted)) if with_paths else None
    previews.shown[face.uid] = Shown(pose.contractions, paths, unmet_remarks(pose.unmet))
    previews.trouble = ""


class _Besides(TypedDict):
    """What is asked of a face besides its FAPs; see `LiveFace.pose`."""

    drive: str
    emotion: EmotionShares
    contractions: Mapping[str, float]


def _asked_of(wanted: Wanted) -> _Besides:
    """What goes along with the FAPs."""
    return {"drive": wanted.drive, "emotion": wanted.profile.weights, "contractions": wanted.contractions}


def play(obj: Object, face: LiveFace, scene: Scene) -> None:
    """Show `obj` as it is laid out at the scene's frame: as a bake will, or as long as that is not worked out, out of
    the apexes of its expressions, or what the mouth says at that frame.

    Raises
    ------
    RisoriusError : an expression cannot be posed.
    """
    performance, known = performance_of(obj, scene), None
    if performance.moves:
        played = _worked_out(obj, face, performance)
        known = played.at(scene.frame_current_final)
        if known is None:
            known = _sketched(obj, face, performance, played.motion, scene.frame_current_final)
    if known is not None and known.any():
        face.show(target_of(obj), known)
        session().previews.laid_out.add(face.uid)
    else:
        rest(obj)


def _sketched(obj: Object, face: LiveFace, performance: Performance, motion: Motion, frame: float) -> Floats | None:
    """(V, 3) what shows at a frame of the scene, as far as it can be told without what was before; None at rest."""
    if isinstance(motion, SpeechMotion):
        step = round(frame - performance.first_frame)
        if not 0 <= step < motion.frame_count(performance.fps):
            return None
        return face.spoken(motion.at(step), drive=obj.risorius.emotion.drive)
    shares = performance.shares(frame)
    if not shares.any():
        return None
    apexes = [
        share * face.apex(wanted.faps, **_asked_of(wanted))
        for share, wanted in zip(shares, performance.wanted, strict=True)
        if share > 0.0
    ]
    return np.asarray(np.sum(apexes, axis=0))


def _worked_out(obj: Object, face: LiveFace, performance: Performance) -> PlayedMotion:
    """What is known of the motion of `obj`; more will be, while nothing else is to be done."""
    played = face.played(
        played_settings(obj, performance),
        motion_of(obj, performance),
        first_frame=performance.first_frame,
        fps=performance.fps,
        drive=obj.risorius.emotion.drive,
    )
    if face.has_more and not bpy.app.timers.is_registered(_answer):
        bpy.app.timers.register(_answer, first_interval=PAUSE)
    return played


def play_or_rest(obj: Object, face: LiveFace, scene: Scene) -> None:
    """Show `obj` as it is laid out, or as it is where that is baked or cannot be shown."""
    try:
        if shape_keys.has_own(obj) or rig_clips(obj) or ready_reason(obj) is not None or not face.is_of(target_of(obj)):
            rest(obj)
        else:
            play(obj, face, scene)
    except RisoriusError as refusal:
        session().previews.trouble = str(refusal)
        rest(obj)


def replay(obj: Object) -> None:
    """Show the scene's frame again: something on the timeline of `obj` has moved."""
    face = held(obj)
    if face is None:
        ask_to_play(obj)
    elif is_on():
        session().previews.due.clear()
        play_or_rest(obj, face, bpy.context.scene)


def rest(obj: Object) -> None:
    """Let `obj` show itself."""
    preview.rest([member for member in target_of(obj).objects() if member.type == "MESH"])


def end() -> None:
    """Take every preview away."""
    if session().previews.faces.is_preparing:
        show_status_everywhere(None)
    session().previews.faces.drop()
    session().previews = Previews()
    if bpy.app.timers.is_registered(_answer):
        bpy.app.timers.unregister(_answer)
    preview.remove_all()
