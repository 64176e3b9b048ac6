"""Where the bakes of a job go: shape keys of Risorius' own, or the controls that the character already has."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ...progress import Work
from .. import bake
from ..bake.motion import CueMotion, FapMotion
from ..bake.performance import clip_names, line_up, pose_all
from ..rig.baking import Expression, Onto, bake_expressions_onto, bake_motion_onto
from ..rig.destinations import BakeTo, find_rig
from ..rig.report import Report, clip_report
from .subjects import Subject

if TYPE_CHECKING:
    from ...api import Cue


#: How a clip is put onto a rig where nothing else is said.
USUAL = Onto()


@dataclass(frozen=True, eq=False)
class Baked:
    """What a job has baked: the results, a report of each where a rig was baked onto, and the last frame."""

    results: Sequence[bake.BakeResult]
    reports: tuple[Report, ...]
    last: float

    @property
    def remarks(self) -> tuple[str, ...]:
        """What the user should know, each once."""
        return tuple(dict.fromkeys(line for result in self.results for line in (*result.told, *result.remarks)))

    @property
    def new_keys(self) -> int:
        """Number of shape keys that were added."""
        return 0 if self.reports else sum(len(result.keys) for result in self.results)

    @property
    def error_mm(self) -> float | None:
        """Largest distance of any vertex of new shape keys from the motion, millimetres; None on a rig."""
        return None if self.reports else round(max(result.error for result in self.results) * 1000.0, 4)


@dataclass(frozen=True)
class Destination:
    """Where bakes go, and onto a rig, how; bakes begin at the scene's first frame."""

    to: BakeTo = BakeTo.NEW
    onto: Onto = USUAL
    max_keys: int | None = None

    @classmethod
    def of(
        cls,
        onto: str = BakeTo.NEW,
        *,
        symmetric: bool = False,
        smooth: float = 1.0,
        into_action: bool = False,
        max_keys: int | None = None,
    ) -> Destination:
        """From options.

        Parameters
        ----------
        onto : "new", "keys" or "bones".
        symmetric, smooth : as in `Onto`.
        into_action : key the action that plays now instead of laying the clip over it.
        max_keys : no more new shape keys for a motion than these, the best ones.
        """
        if onto not in list(BakeTo):
            raise ParameterError("onto", f"must be one of {', '.join(BakeTo)}", onto)
        if not (np.isfinite(smooth) and smooth >= 0.0):
            raise ParameterError("smooth", "must be 0 or more", smooth)
        return cls(BakeTo(onto), Onto(symmetric, smooth, above=not into_action), max_keys)

    def expressions(self, face: Subject, cues: Sequence[Cue], creases: bool | None) -> Work[Baked]:
        """Each cue as a clip of its own, one after another, with few keyframes."""
        start, fps = bpy.context.scene.frame_start, bake.scene_fps()
        if self.to is BakeTo.NEW:
            results = yield from pose_all(face.target, cues, fps, creases, first_frame=start)
            return Baked(results, (), line_up(face.target, results))
        expressions = [
            Expression(
                clip,
                cue.profile.frame(),
                bake.ClipTiming(cue.onset, cue.apex, cue.offset, start=start + cue.start * fps, fps=fps),
                cue.peak,
                cue.profile.weights,
            )
            for clip, cue in zip(clip_names(cues), cues, strict=True)
        ]
        results = yield from bake_expressions_onto(face.target, expressions, find_rig(self.to), onto=self.onto)
        reports = [
            clip_report(result, each.faps, strength=each.peak)
            for result, each in zip(results, expressions, strict=True)
        ]
        return Baked(results, tuple(reports), max(result.frame_range[1] for result in results))

    def motion(self, face: Subject, motion: CueMotion | FapMotion, clip: str, creases: bool | None) -> Work[Baked]:
        """A simulated motion as one clip."""
        start = bpy.context.scene.frame_start
        if self.to is BakeTo.NEW:
            made = yield from bake.bake_motion(
                face.target, motion, clip=clip, start=start, max_keys=self.max_keys, creases=creases
            )
            return Baked([made], (), made.frame_range[1])
        moved = yield from bake_motion_onto(
            face.target, motion, find_rig(self.to), clip=clip, start=start, onto=self.onto
        )
        return Baked([moved], (clip_report(moved, _requested(motion)),), moved.frame_range[1])


def _requested(motion: CueMotion | FapMotion) -> Floats:
    """(T, 68) FAPs that a motion asks for in each frame."""
    from ... import api

    return motion.stream if isinstance(motion, FapMotion) else api.sequence(motion.cues, fps=bake.scene_fps())


#: Shape keys of Risorius' own.
NEW_KEYS = Destination()
