"""What the user has laid out in time for a face, whether it is baked or not."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ...arrays import Floats
from ...scene.bake import scene_fps
from .profile import Wanted, wanted_of

if TYPE_CHECKING:
    from ...api import Cue


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
    """What is laid out for `obj`: the chosen emotion with its timing."""
    from ... import api

    timing, wanted, fps = obj.risorius.bake, wanted_of(obj), scene_fps(scene)
    cue = api.Cue(wanted.profile, onset=timing.onset, apex=timing.apex, offset=max(timing.offset, 1.0 / fps))
    return Performance(float(timing.start), fps, (cue,), (wanted,))
