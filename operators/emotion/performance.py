"""What the user has laid out in time for a face, whether it is baked or not."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...arrays import Floats
from ...mpeg4.timing import Cue, Ramp
from ...scene.bake import scene_fps
from ..timeline.props import sounding
from .profile import Wanted, profile_of, wanted_of


@dataclass(frozen=True)
class Performance:
    """Expressions in time.

    Attributes
    ----------
    first_frame : the frame at which the cues' time is 0. fps : frames per second.
    cues : when and how strongly each expression shows. wanted : what each shows at its apex.
    """

    first_frame: float
    fps: float
    cues: tuple[Cue, ...] = ()
    wanted: tuple[Wanted, ...] = field(default=())

    def shares(self, frame: float) -> Floats:
        """(C,) how much of each expression shows at a frame of the scene; together at most 1."""
        times = np.array([(frame - self.first_frame) / self.fps])
        strengths = np.array([float(cue.strength(times)[0]) for cue in self.cues])
        shares: Floats = strengths / max(1.0, float(strengths.sum()))
        return shares


def performance_of(obj: Any, scene: Any) -> Performance:
    """What is laid out for `obj`: the clips of its timeline, or without any the chosen emotion with its timing."""
    timeline, fps = obj.risorius.timeline, scene_fps(scene)
    if not timeline.clips:
        timing = obj.risorius.bake
        return Performance(float(timing.start), fps, (_cue(timing, obj.risorius.emotion, fps),), (wanted_of(obj),))
    clips = sounding(timeline)
    first = min((clip.start for clip in clips), default=0)
    cues = tuple(
        _cue(clip, clip.emotion, fps, start=(clip.start - first) / fps, peak=clip.peak, ramp=Ramp(clip.ramp))
        for clip in clips
    )
    return Performance(float(first), fps, cues, tuple(wanted_of(obj, clip.emotion) for clip in clips))


def _cue(timing: Any, emotion: Any, fps: float, **options: Any) -> Cue:
    """An emotion with its times; it takes a frame at least to go."""
    # Blender keeps single precision: 1.2 s would come out a little longer, and the motion a frame.
    onset, apex, offset = (round(getattr(timing, name), 6) for name in ("onset", "apex", "offset"))
    seed = emotion.seed or None
    return Cue(profile_of(emotion), onset=onset, apex=apex, offset=max(offset, 1.0 / fps), seed=seed, **options)
