"""The three bakes: an expression, a motion, a strip for each clip; made of what is chosen on a face."""

from __future__ import annotations

from ...progress import Work
from ...scene import bake
from ...scene.bake.notes import BakeKind, Note
from ...scene.bake.strips import ClipShape, bake_strips
from ..active import target_of
from ..blender_types import Object, Scene
from ..emotion.performance import performance_of
from ..emotion.profile import wanted_of
from .settings import (
    clip_name,
    creases_wanted,
    expression_settings,
    motion_of,
    motion_settings,
    strip_curve,
    strip_settings,
    timing_of,
)


def silent_reason(obj: Object) -> str | None:
    """Why there is no motion to bake, or None."""
    timeline = obj.risorius.timeline
    if timeline.clips and all(clip.mute and not clip.solo for clip in timeline.clips):
        return "All clips are muted: unmute one"
    return None


def expression_work(obj: Object, scene: Scene) -> Work[bake.BakeResult]:
    """Pose the face as the Emotion panel says and write its shape."""
    wanted = wanted_of(obj)
    return bake.bake_expression(
        target_of(obj, scene),
        wanted.faps,
        clip=clip_name(obj),
        timing=timing_of(obj, scene),
        drive=wanted.drive,
        emotion=wanted.profile.weights,
        contractions=wanted.contractions,
        creases=creases_wanted(obj),
        note=Note(BakeKind.EXPRESSION, expression_settings(obj, scene)),
    )


def motion_work(obj: Object, scene: Scene) -> Work[bake.BakeResult]:
    """Simulate what is laid out on the face and write its motion, with a marker where each expression begins."""
    performance = performance_of(obj, scene)
    markers = [(title, performance.span(number)[0]) for number, title in enumerate(performance.titles)]
    return bake.bake_motion(
        target_of(obj, scene),
        motion_of(obj, performance),
        clip=clip_name(obj, motion=True),
        start=performance.first_frame,
        fps=performance.fps,
        drive=obj.risorius.emotion.drive,
        creases=creases_wanted(obj),
        note=Note(BakeKind.MOTION, motion_settings(obj, performance), tuple(markers)),
    )


def strips_work(obj: Object, scene: Scene) -> Work[bake.BakeResult]:
    """Pose the face for each clip and write shapes, actions and strips."""
    performance = performance_of(obj, scene)
    shapes = [
        ClipShape(
            title,
            wanted.faps,
            strip_curve(performance, number),
            strip_settings(obj, performance, number),
            wanted.profile.weights,
            wanted.contractions,
        )
        for number, (title, wanted) in enumerate(zip(performance.titles, performance.wanted, strict=True))
    ]
    return bake_strips(target_of(obj, scene), shapes, drive=obj.risorius.emotion.drive, creases=creases_wanted(obj))
