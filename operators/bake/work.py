"""The bakes: an expression, a motion, a strip for each clip, a stream; made of what is chosen on a face."""

from __future__ import annotations

from dataclasses import replace

from ...progress import Work
from ...scene import bake
from ...scene.bake.motion import Motion
from ...scene.bake.notes import BakeKind, Note
from ...scene.bake.strips import ClipShape, bake_strips
from ...scene.rig import bake_expression_onto, bake_motion_onto
from ...scene.rig.destinations import BakeTo, find_rig
from ...scene.rig.strips import bake_strips_onto
from ...speech.accompaniment import by_rule
from ..active import target_of
from ..blender_types import Object, Scene
from ..emotion.performance import Performance, performance_of
from ..emotion.profile import wanted_of
from ..speech.strips import playing_strips
from .destination import Destination, destination_of
from .settings import (
    clip_name,
    creases_wanted,
    expression_settings,
    most_keys,
    motion_of,
    motion_settings,
    strip_curve,
    strip_settings,
    timing_of,
)


def silent_reason(obj: Object) -> str | None:
    """Why there is no motion to bake, or None."""
    timeline = obj.risorius.timeline
    if not playing_strips(obj) and timeline.clips and all(clip.mute and not clip.solo for clip in timeline.clips):
        return "All clips are muted: unmute one"
    return None


def expression_work(obj: Object, scene: Scene, where: Destination | None = None) -> Work[bake.BakeResult]:
    """Pose the face as the Emotion panel says and write it where it is to go."""
    where, wanted = where or destination_of(obj), wanted_of(obj)
    target, timing = target_of(obj, scene), timing_of(obj, scene)
    note = Note(BakeKind.EXPRESSION, expression_settings(obj, scene, where), onto=where.noted)
    if where.to is BakeTo.NEW:
        return bake.bake_expression(
            target,
            wanted.faps,
            clip=clip_name(obj),
            timing=timing,
            drive=wanted.drive,
            emotion=wanted.profile.weights,
            contractions=wanted.contractions,
            creases=creases_wanted(obj),
            note=note,
        )
    return bake_expression_onto(
        target,
        wanted.faps,
        find_rig(where.to),
        clip=clip_name(obj),
        timing=timing,
        onto=where.onto,
        drive=wanted.drive,
        emotion=wanted.profile.weights,
        contractions=wanted.contractions,
        note=note,
    )


def motion_work(obj: Object, scene: Scene, where: Destination | None = None) -> Work[bake.BakeResult]:
    """Simulate what is laid out on the face and write its motion, with a marker where each expression begins."""
    where, performance = where or destination_of(obj), performance_of(obj, scene)
    note = Note(BakeKind.MOTION, motion_settings(obj, performance, where), tuple(performance.markers), where.noted)
    clip, motion = clip_name(obj, motion=True), motion_of(obj, performance)
    work = stream_work(obj, scene, motion, clip=clip, start=performance.first_frame, where=where, note=note)
    return work if performance.speech is None else _spoken(work, performance)


def _spoken(work: Work[bake.BakeResult], performance: Performance) -> Work[bake.BakeResult]:
    """A bake with what is to be said of its speech."""
    result = yield from work
    speech = performance.speech
    said = () if speech is None else (*speech.remarks, *by_rule(speech.utterance, performance.liveliness))
    return replace(result, remarks=(*result.remarks, *said, *unshown(performance)))


def unshown(performance: Performance) -> tuple[str, ...]:
    """What of the feelings speech does not show."""
    if any(wanted.contractions for wanted in performance.wanted):
        return ("Muscles set by hand do not show while the face speaks",)
    return ()


def stream_work(
    obj: Object,
    scene: Scene,
    motion: Motion,
    *,
    clip: str,
    start: float,
    where: Destination | None = None,
    note: Note | None = None,
) -> Work[bake.BakeResult]:
    """Simulate a motion at the scene's rate and write it where it is to go."""
    where, target = where or destination_of(obj), target_of(obj, scene)
    fps, drive = bake.scene_fps(scene), obj.risorius.emotion.drive
    if where.to is BakeTo.NEW:
        return bake.bake_motion(
            target,
            motion,
            clip=clip,
            start=start,
            fps=fps,
            drive=drive,
            max_keys=most_keys(obj),
            creases=creases_wanted(obj),
            note=note,
        )
    rig = find_rig(where.to)
    return bake_motion_onto(
        target, motion, rig, clip=clip, start=start, fps=fps, onto=where.onto, drive=drive, note=note
    )


def strips_work(obj: Object, scene: Scene, where: Destination | None = None) -> Work[bake.BakeResult]:
    """Pose the face for each clip and write actions and strips where they are to go."""
    where, performance = where or destination_of(obj), performance_of(obj, scene)
    shapes = [
        ClipShape(
            title,
            wanted.faps,
            strip_curve(performance, number),
            strip_settings(obj, performance, number, where),
            wanted.profile.weights,
            wanted.contractions,
        )
        for number, (title, wanted) in enumerate(zip(performance.titles, performance.wanted, strict=True))
    ]
    target, drive = target_of(obj, scene), obj.risorius.emotion.drive
    if where.to is BakeTo.NEW:
        work = bake_strips(target, shapes, drive=drive, creases=creases_wanted(obj))
    else:
        rig = find_rig(where.to)
        work = bake_strips_onto(target, shapes, rig, onto=where.onto, drive=drive, noted=where.noted)
    return work if performance.speech is None else _unspoken(work)


def _unspoken(work: Work[bake.BakeResult]) -> Work[bake.BakeResult]:
    """A bake of clips alone, with what it leaves out."""
    result = yield from work
    return replace(result, remarks=(*result.remarks, "Speech is not in strips: Bake Motion shows it with the clips"))
