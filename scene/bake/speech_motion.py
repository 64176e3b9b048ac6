"""What is said, with the expressions laid out beside it, as a motion of a face."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from ...arrays import Floats
from ...mpeg4 import Cue, Liveliness
from ...progress import Prepared, Work
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

    @cached_property
    def made(self) -> FapMotion:
        """Its frames, planned."""
        from ... import api

        saying = api.say(
            self.utterance,
            cues=self.cues,
            fps=self.fps,
            articulation=self.articulation,
            jaw=self.jaw,
            lean=self.lean,
            liveliness=self.liveliness,
        )
        return FapMotion(saying.stream.frames, saying.emotions, planned=True)

    def frame_count(self, fps: float) -> int:
        """Frames to the end of speech and expressions."""
        return self.made.frame_count(fps)

    def positions(self, face: Face, fps: float, drive: str) -> Prepared[Floats]:
        """Each frame in balance: speech has its inertia already."""
        return self.made.positions(face, fps, drive)

    def between(self, face: Face, drive: str) -> Work[LongMotion] | None:
        """As of a stream."""
        return self.made.between(face, drive)

    def asked(self, drive: str) -> Floats:
        """Its frames."""
        return self.made.asked(drive)
