"""What is said, with the expressions laid out beside it, as a motion of a face."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import Floats
from ...mpeg4 import Cue, Liveliness
from ...progress import Prepared, Work, stepwise, worked_out
from .motion import FapMotion

if TYPE_CHECKING:
    from ...api import Utterance
    from ...face.face import Face
    from ...face.long_motion import LongMotion


@dataclass(frozen=True, eq=False)
class SpeechMotion:
    """Speech with feeling; see `api.say`.

    Attributes
    ----------
    utterance : what is said, its time that of the cues. cues : expressions. fps : frames per second.
    articulation, jaw, lean : 0 to 2. liveliness : blinks and small motions of head and eyes.
    """

    utterance: Utterance
    cues: Sequence[Cue]
    fps: float
    articulation: float = 1.0
    jaw: float = 1.0
    lean: float = 1.0
    liveliness: Liveliness = field(default_factory=Liveliness)

    @stepwise
    def made(self) -> Work[FapMotion]:
        """Its frames, planned."""
        from ...speech.saying import say_steps

        saying = yield from say_steps(
            self.utterance,
            cues=self.cues,
            fps=self.fps,
            articulation=self.articulation,
            jaw=self.jaw,
            lean=self.lean,
            liveliness=self.liveliness,
        )
        return FapMotion(saying.stream.frames, saying.emotions, planned=True)

    def prepare(self) -> Work[None]:
        """Work out its frames: seconds for an hour."""
        yield from worked_out(self, "made")

    def frame_count(self, fps: float) -> int:
        """Frames to the end of speech and expressions."""
        from ...speech.saying import frames_of

        return frames_of(self.utterance, self.cues, fps=self.fps)

    def at(self, step: int) -> Floats:
        """(68,) one of its frames, at once; as long as they are not worked out, without blinks and small motions."""
        from ...speech.glimpse import glimpse

        if "made" in vars(self):
            return np.asarray(self.made.stream[step])
        manner = {"articulation": self.articulation, "jaw": self.jaw, "lean": self.lean}
        return glimpse(self.utterance, self.cues, step / self.fps, self.fps, **manner)

    def positions(self, face: Face, fps: float, drive: str) -> Prepared[Floats]:
        """Each frame in balance: speech has its inertia already."""
        return self.made.positions(face, fps, drive)

    def between(self, face: Face, drive: str) -> Work[LongMotion] | None:
        """As of a stream."""
        return self.made.between(face, drive)

    def asked(self, drive: str) -> Floats:
        """Its frames."""
        return self.made.asked(drive)
