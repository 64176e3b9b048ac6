"""What a motion bake simulates: expressions in time, or a stream of FAPs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ...mpeg4 import Cue, Liveliness, strengths
from ...progress import Prepared, Work

if TYPE_CHECKING:
    from ...face.face import Face
    from ...face.long_motion import LongMotion
    from ...physics.tissue import Tissue

#: Frames of the longest stream that is posed frame by frame, which takes half a minute.
SIMULATED = 1000


class Motion(Protocol):
    """Anything that moves a face."""

    def prepare(self) -> Work[None]:
        """Work out what all but `frame_count` need, where that takes long; without it, it is done when needed."""
        ...

    def frame_count(self, fps: float) -> int:
        """Number of frames at a frame rate."""
        ...

    def positions(self, face: Face, fps: float, drive: str) -> Prepared[Floats]:
        """Positions (V, 3) frame by frame."""
        ...

    def between(self, face: Face, drive: str) -> Work[LongMotion] | None:
        """Its frames between some that are posed, where it is long; None where each is simulated."""
        ...

    def asked(self, drive: str) -> Floats:
        """(k, 68) FAPs that it asks of a face at one time or another; NaN where silent."""
        ...


@dataclass(frozen=True)
class CueMotion:
    """Expressions in time, each planned at its apex; see `Face.performance`.

    `contractions` are those set by hand, a set per cue; `tissue` a name or figures; `liveliness` adds blinks
    and small motions of head and eyes.
    """

    cues: Sequence[Cue]
    contractions: Sequence[Mapping[str, float]] | None = None
    tissue: str | Tissue = "default"
    liveliness: Liveliness | None = None

    def prepare(self) -> Work[None]:
        """Nothing takes long."""
        yield from ()

    def frame_count(self, fps: float) -> int:
        """Frames to the end of the last cue."""
        return len(strengths(self.cues, fps=fps))

    def positions(self, face: Face, fps: float, drive: str) -> Prepared[Floats]:
        """The performance."""
        return face.performance(
            self.cues,
            fps,
            drive=drive,
            contractions=self.contractions,
            tissue=self.tissue,
            liveliness=self.liveliness,
        )

    def between(self, face: Face, drive: str) -> Work[LongMotion] | None:
        """Each frame is simulated."""
        return None

    def asked(self, drive: str) -> Floats:
        """Each expression at its peak, as its seed draws it."""
        from ...face.products.efforts import wanted_at_apexes

        return wanted_at_apexes(self.cues, drive)


@dataclass(frozen=True, eq=False)
class FapMotion:
    """A stream of FAPs (T, 68), NaN where silent, and the emotions (T, 6) behind it where they are known.

    Each frame is shown as it is: a face that was recorded has moved with its own inertia, and speech is laid out for
    the moment in which it is seen. `planned`: the stream shows all that its emotions show (speech). `inertia`: skin and
    jaw follow it with theirs, which suits a stream that was computed without any.
    """

    stream: Floats
    emotions: Floats | None = None
    planned: bool = False
    inertia: bool = False

    def __post_init__(self) -> None:
        if len(self.stream) == 0:
            raise ParameterError("frames", "must contain at least one frame", len(self.stream))

    def prepare(self) -> Work[None]:
        """All is there."""
        yield from ()

    def frame_count(self, fps: float) -> int:
        """The stream's own frames."""
        return len(self.stream)

    def positions(self, face: Face, fps: float, drive: str) -> Prepared[Floats]:
        """The stream, each frame planned by itself; see `Face.simulation`."""
        integrator = "reduced" if self.inertia else "balance"
        return face.simulation(
            self.stream, fps, drive=drive, emotions=self.emotions, planned=self.planned, integrator=integrator
        )

    def between(self, face: Face, drive: str) -> Work[LongMotion] | None:
        """A long stream without inertia lies between some of its frames; see `Face.long_motion`."""
        if len(self.stream) <= SIMULATED or self.inertia or (self.emotions is not None and not self.planned):
            return None
        return face.long_motion(self.stream, drive=drive, planned=self.planned)

    def asked(self, drive: str) -> Floats:
        """The stream."""
        return self.stream


def at_rate(stream: Floats, fps: float, wanted: float) -> Floats:
    """A stream (T, 68) at another rate, seconds kept; between its steps each FAP goes evenly.

    A FAP is silent (NaN) where the nearer one of the steps around it is.
    """
    if fps == wanted or len(stream) < 2:
        return stream
    count = int(np.floor((len(stream) - 1) / fps * wanted + 1e-6)) + 1
    places = np.minimum(np.arange(count) / wanted * fps, len(stream) - 1.0)
    below = np.minimum(places.astype(np.int64), len(stream) - 2)
    share = (places - below)[:, None]
    first, second = stream[below], stream[below + 1]
    nearer = np.where(share < 0.5, first, second)
    mixed = (1.0 - share) * np.where(np.isnan(first), second, first) + share * np.where(np.isnan(second), first, second)
    return np.where(np.isnan(nearer), np.nan, mixed)
