"""A motion that is not baked, worked out bit by bit, so that the timeline plays as it will be baked.

Its frames come one after the other, as a bake's do: with the skin's inertia, with blinks and with the small motions of
head and eyes. What is known of it is shown; where nothing is known yet, someone else has to say what shows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...arrays import Floats
from ...progress import Progress, Work
from ..bake.motion import Motion

if TYPE_CHECKING:
    from ...api import Face

#: No more than this is held of a motion, bytes; a minute of a head of ten thousand vertices.
MOST = 200_000_000


class PlayedMotion:
    """One motion of one face."""

    def __init__(self, face: Face, motion: Motion, *, first_frame: float, fps: float, drive: str) -> None:
        """Nothing is known of it yet; its time begins at a frame of the scene."""
        self._face, self.motion, self._fps, self._drive = face, motion, fps, drive
        self.first_frame = first_frame
        self.frame_count = motion.frame_count(fps)
        self._frames: list[NDArray[np.float32]] = []

    def work(self) -> Work[None]:
        """Work it out, bit by bit, as far as it may be held."""
        yield from self.motion.prepare()
        moving = self.motion.positions(self._face, self._fps, self._drive)
        yield from moving.prepare()
        frames = max(1, MOST // (self._face.vertices.size * np.dtype(np.float32).itemsize))
        for number, positions in enumerate(moving):
            if number >= frames:
                return
            self._frames.append((positions - self._face.vertices).astype(np.float32))
            yield Progress.counted(number + 1, self.frame_count, "frames worked out")

    def at(self, frame: float) -> Floats | None:
        """(V, 3) displacement of all vertices at a frame of the scene, metres; None where that is not known.

        Before its first frame and after its last one the face rests.
        """
        step = frame - self.first_frame
        if not 0.0 <= step <= self.frame_count - 1:
            return np.zeros_like(self._face.vertices)
        before = int(step)
        after = min(before + 1, self.frame_count - 1) if step > before else before
        if after >= len(self._frames):
            return None
        if after == before:
            return self._frames[before].astype(np.float64)
        share = step - before
        return np.asarray((1.0 - share) * self._frames[before].astype(np.float64) + share * self._frames[after])
