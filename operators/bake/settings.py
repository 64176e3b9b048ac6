"""What a bake now would be made of, as digests: a baked clip whose note says otherwise is stale."""

from __future__ import annotations

from collections.abc import Mapping
from hashlib import blake2b

import numpy as np

from ...scene.bake import shape_keys
from ...scene.bake.action import Curve
from ...scene.bake.motion import CueMotion
from ...scene.bake.notes import BakeKind, Note, read_notes
from ...scene.bake.speech_motion import SpeechMotion
from ...scene.bake.timing import ClipTiming, scene_fps
from ...scene.rig.destinations import BakeTo
from ...scene.rig.kept import kept_clips
from ...scene.shape_mix import resting_values
from ..active import target_of
from ..blender_types import Object, Scene
from ..emotion.performance import Performance, performance_of
from ..emotion.profile import Wanted, title_of, wanted_of
from ..speech.strips import playing_strips
from ..tissue.props import tissue_of
from .destination import Destination, destination_again

MOTION_SUFFIX = " motion"
#: What the motion of a whole timeline is called unless the user names it.
TIMELINE = "timeline"


def clip_name(obj: Object, *, motion: bool = False) -> str:
    """The name the user gave, or the emotion's; a motion through several expressions is the timeline's."""
    title = title_of(obj.risorius.emotion)
    if motion and (obj.risorius.timeline.clips or playing_strips(obj)):
        title = TIMELINE
    chosen = str(obj.risorius.bake.clip).strip() or title
    return chosen + MOTION_SUFFIX if motion else chosen


def timing_of(obj: Object, scene: Scene) -> ClipTiming:
    """The timing chosen for a single expression."""
    chosen = obj.risorius.bake
    return ClipTiming(
        start=float(chosen.start),
        onset=chosen.onset,
        apex=chosen.apex,
        offset=chosen.offset,
        fps=scene_fps(scene),
    )


def creases_wanted(obj: Object) -> bool | None:
    """What the user has said about creases; None where nothing, and the material decides."""
    chosen = obj.risorius.bake
    return bool(chosen.creases) if chosen.is_property_set("creases") else None


def most_keys(obj: Object) -> int | None:
    """How many shape keys a motion may have; None for any number."""
    return int(obj.risorius.bake.max_keys) or None


def motion_of(obj: Object, performance: Performance) -> CueMotion | SpeechMotion:
    """What a motion bake of a performance simulates."""
    if performance.speech is None:
        hands = [wanted.contractions for wanted in performance.wanted]
        return CueMotion(performance.cues, hands, tissue_of(obj), performance.liveliness)
    return SpeechMotion(
        performance.speech.utterance,
        performance.cues,
        performance.fps,
        liveliness=performance.liveliness,
        **_manner(obj),
    )


def _manner(obj: Object) -> dict[str, float]:
    """How a face speaks."""
    chosen = obj.risorius.speech
    return {name: round(getattr(chosen, name), 6) for name in ("articulation", "jaw", "lean")}


def _moved_by(obj: Object, performance: Performance) -> tuple[object, ...]:
    """All that a motion depends on but the face and when it begins."""
    if performance.speech is not None:
        manner = sorted(_manner(obj).items())
        return performance.cues, performance.speech.digest, manner, performance.liveliness
    motion = CueMotion(performance.cues, [wanted.contractions for wanted in performance.wanted], tissue_of(obj))
    return motion.cues, motion.contractions, motion.tissue, performance.liveliness


def expression_settings(obj: Object, scene: Scene, where: Destination) -> str:
    """Digest of what an expression bake is made of."""
    return _digest(_look(wanted_of(obj)), timing_of(obj, scene), _besides(obj, where), *_resting(obj))


def _besides(obj: Object, where: Destination, *, moving: bool = False) -> object:
    """What else a bake is made of: creases with new keys, and how many; onto a rig, how."""
    if where.to is BakeTo.NEW:
        limit = most_keys(obj) if moving else None
        return creases_wanted(obj) if limit is None else (creases_wanted(obj), limit)
    return where.to.value, where.onto.symmetric, round(where.onto.smooth, 6) if moving else 0.0


def motion_settings(obj: Object, performance: Performance, where: Destination) -> str:
    """Digest of what a motion bake is made of."""
    said = () if performance.speech is None else performance.speech.titles
    return _digest(
        (performance.first_frame, performance.fps, performance.titles + said),
        *_moved_by(obj, performance),
        *(obj.risorius.emotion.drive, _besides(obj, where, moving=True), *_resting(obj)),
    )


def played_settings(obj: Object, performance: Performance) -> str:
    """Digest of all that a motion depends on but the face itself."""
    when = performance.first_frame, performance.fps, obj.risorius.emotion.drive
    return _digest(when, *_moved_by(obj, performance))


def strip_curve(performance: Performance, number: int) -> Curve:
    """How much of a clip shows: four keyframes, or each frame's share where it overlaps with others."""
    start, end = performance.span(number)
    spans = [performance.span(other) for other in range(len(performance.cues)) if other != number]
    if not any(first < end and start < last for first, last in spans):
        cue = performance.cues[number]
        timing = ClipTiming(cue.onset, cue.apex, cue.offset, start=start, fps=performance.fps)
        return timing.curve(cue.peak)
    frames = np.arange(np.floor(start), np.ceil(end) + 1.0)
    return Curve(frames, performance.shares_at(frames)[:, number], linear=True)


def strip_settings(obj: Object, performance: Performance, number: int, where: Destination) -> str:
    """Digest of what one strip is made of: its expression, and the curve that overlaps leave it."""
    curve = strip_curve(performance, number)
    times = curve.frames.tobytes(), curve.values.tobytes(), curve.linear
    return _digest(_look(performance.wanted[number]), times, _besides(obj, where), *_resting(obj))


def stale_clips(obj: Object, scene: Scene) -> Mapping[str, BakeKind]:
    """The baked clips of new shape keys that a bake now would make otherwise, and how they were baked."""
    return {clip: note.kind for clip, note in _stale(obj, scene, read_notes(shape_keys.own_face(obj.data))).items()}


def stale_rig_clips(obj: Object, scene: Scene) -> Mapping[str, Note]:
    """The clips on the rig that a bake now would make otherwise, and what their bake has noted."""
    notes = {clip: kept.note for clip, kept in kept_clips(obj).items()}
    return _stale(obj, scene, {clip: note for clip, note in notes.items() if note is not None})


def _stale(obj: Object, scene: Scene, notes: Mapping[str, Note]) -> dict[str, Note]:
    """Those of some notes that a bake now, onto the same, would make otherwise."""
    if not notes:
        return {}
    performance = performance_of(obj, scene)
    now = {onto: _settings_now(obj, scene, performance, onto) for onto in {note.onto for note in notes.values()}}
    stale = {}
    for clip, note in notes.items():
        wanted = now[note.onto][note.kind].get(clip)
        gone = note.kind is BakeKind.STRIP and wanted is None and bool(obj.risorius.timeline.clips)
        if gone or (wanted is not None and wanted != note.settings):
            stale[clip] = note
    return stale


def _settings_now(
    obj: Object, scene: Scene, performance: Performance, onto: str
) -> Mapping[BakeKind, Mapping[str, str]]:
    """Kind of bake -> clip -> digest, of all that a bake now makes of what it would key."""
    where = destination_again(obj, onto)
    motion = {clip_name(obj, motion=True): motion_settings(obj, performance, where)} if performance.moves else {}
    strips = enumerate(performance.titles)
    return {
        BakeKind.EXPRESSION: {clip_name(obj): expression_settings(obj, scene, where)},
        BakeKind.MOTION: motion,
        BakeKind.STRIP: {title: strip_settings(obj, performance, number, where) for number, title in strips},
    }


def _look(wanted: Wanted) -> tuple[object, ...]:
    """All of a wanted expression that a pose depends on."""
    shares = sorted((str(name), share) for name, share in wanted.profile.weights.items())
    ways = sorted((str(name), way) for name, way in wanted.profile.prototypes.items())
    felt, own = round(wanted.profile.activation, 6), wanted.profile.shows
    units = () if own is None else (own.still, *sorted(own.amounts(felt).items()))
    return wanted.faps.tobytes(), wanted.drive, shares, ways, units, felt, sorted(wanted.contractions.items())


def _resting(obj: Object) -> list[dict[str, float]]:
    """The user's shape keys that make the face what it is, of each of its objects that has any."""
    members = (member for member in target_of(obj).objects() if member.type == "MESH")
    return [values for member in members if (values := resting_values(member.data))]


def _digest(*parts: object) -> str:
    """A short digest of anything whose repr says all of it."""
    return blake2b(repr(parts).encode(), digest_size=12).hexdigest()
