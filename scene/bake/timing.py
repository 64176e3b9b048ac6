"""When a baked expression happens, in frames."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from ...errors import ParameterError
from ..blender_types import Scene
from .action import Curve

#: Frames of an expression, at most: a scene of Blender's has a million.
LONGEST = 1_000_000


@dataclass(frozen=True)
class ClipTiming:
    """When an expression happens: seconds of onset, apex and offset from the frame `start` on, at `fps`."""

    onset: float
    apex: float
    offset: float
    start: float = 1.0
    fps: float = 25.0

    def __post_init__(self) -> None:
        for name in ("onset", "apex", "offset"):
            if not (np.isfinite(getattr(self, name)) and getattr(self, name) >= 0.0):
                raise ParameterError(name, "must be zero or more seconds", getattr(self, name))
        if not self.fps > 0.0:
            raise ParameterError("fps", "must be above zero", self.fps)
        lasts = (self.onset + self.apex + self.offset) * self.fps
        if not lasts <= LONGEST:
            raise ParameterError("onset, apex and offset", f"must end within {LONGEST} frames", lasts)

    def curve(self, peak: float) -> Curve:
        """Zero, up to `peak`, held, and back to zero."""
        steps = np.array([0.0, self.onset, self.apex, self.offset]) * self.fps
        frames = self.start + np.cumsum(np.maximum(steps, [0.0, 1.0, 0.0, 1.0]))
        values = np.array([0.0, peak, peak, 0.0])
        distinct = np.concatenate([[True], np.diff(frames) > 1e-6])
        return Curve(frames[distinct], values[distinct])


def scene_fps(scene: Scene | None = None) -> float:
    """Frames per second of the scene."""
    render = (scene or bpy.context.scene).render
    return float(render.fps) / float(render.fps_base)
