"""Landmarks over time to a FAP stream that says how sure it is, and says nothing where it cannot know."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..errors import ParameterError
from ..face.tracked.landmarks import LandmarkReading, Pose3, shifts_as_faps
from ..face.tracked.mediapipe_landmarks import landmark_numbers, read_landmarks
from ..mpeg4 import FAP_COUNT, BeliefTrack, FapStream, Rule, recognise_over_time
from ..mpeg4.streams.capture import Landmarks, Samples
from .generic_face import unusual_mouth
from .people import guess_neutral
from .smoothing import Smoothing, smooth
from .trust import GENERIC_WORTH, confidence

#: The neutral face of nobody, in place of a stretch of the recording.
GENERIC = "generic"

#: Of fewer pictures than this none may be neutral, and no shape is usual.
FEW = 10

#: Values less sure than this are masked.
LEAST = 0.3


@dataclass(frozen=True, eq=False)
class Track:
    """What pictures say.

    Attributes
    ----------
    stream : FAPs in this person's own FAP units at an even rate; masked where unknown.
    confidence : (T, 68) 0..1 of each value, before masking: 0 where nothing was seen.
    lost : frames of the stream without a face.
    neutral : seconds of the pictures that the neutral face was taken from; empty where it is the generic one.
    generic : whether the neutral face is nobody's: FAPs then hold how this person differs from the usual face.
    doubt : (68, m) FAP units: how the FAPs would change with the neutral face, were it wrong by one standard deviation
        in each of m independent ways; m = 0 where it is this person's own.
    doubts : points of the mouth that a neutral face seldom has where this one does: it may be smiling or speaking.
    delay : seconds by which slow motions come late.
    reading : the same before smoothing, at the pictures' own times, with the head's pose and the neutral face.
    """

    stream: FapStream
    confidence: Floats
    lost: Ints
    neutral: Floats
    generic: bool
    doubt: Floats
    doubts: tuple[str, ...]
    delay: float
    reading: LandmarkReading

    def recognise(self) -> BeliefTrack:
        """Beliefs over time by the robust rule, each value weighed by how sure it is, the neutral face as doubtful."""
        doubt = self.doubt if self.doubt.size else None
        return recognise_over_time(
            self.stream.frames, rule=Rule.ROBUST, confidence=self.confidence, doubt=doubt, fps=self.stream.fps
        )


def track_landmarks(
    landmarks: Landmarks,
    *,
    fps: float | None = None,
    neutral: tuple[float, float] | str | None = None,
    smoothing: str | Smoothing = Smoothing.SAVGOL,
    least: float = LEAST,
    name: str = "track",
) -> Track:
    """The stream of tracked landmarks.

    Parameters
    ----------
    fps : frames per second of the stream; None: those of the recording.
    neutral : seconds from and to which the face is neutral; "generic": a face like most people's (`people`); None: the
        face's usual shape is neutral. Fewer pictures than `FEW` are always read against the generic face, which takes
        from them what they tell.
    smoothing : see `Smoothing`.
    least : values less sure are masked; 0 keeps all.

    Raises
    ------
    ParameterError : an option outside its rule. ModelError : no picture shows a whole face.
    """
    if not 0.0 <= least <= 1.0:
        raise ParameterError("least", "must be in 0..1", least)
    if isinstance(neutral, str) and neutral != GENERIC:
        raise ParameterError("neutral", f'must be two times in seconds, or "{GENERIC}"', neutral)
    few = len(landmarks.times) < FEW and neutral is None
    generic = neutral == GENERIC or few or len(landmarks.times) == 1
    doubt = np.zeros((FAP_COUNT, 0))
    if generic:
        reading, doubt = _against_generic(landmarks)
    else:
        assert not isinstance(neutral, str)
        reading = read_landmarks(landmarks, neutral=neutral)
    times = landmarks.times
    even, rate = Samples(times, reading.frames).evenly(fps)
    sure, _ = Samples(times, confidence(reading, generic=generic)).evenly(fps)
    sure = np.where(np.isnan(even), 0.0, sure)
    kept = smooth(np.where(_enough(sure, least, generic), even, np.nan), rate, smoothing)
    lost = np.flatnonzero(np.isnan(even).all(axis=1))
    stream = FapStream(kept, fps=rate, name=name)
    chosen = np.zeros(0) if generic else times[reading.chosen]
    doubts = () if generic else unusual_mouth(reading.neutral)
    return Track(stream, sure, lost, chosen, generic, doubt, doubts, Smoothing(smoothing).delay, reading)


def _enough(sure: Floats, least: float, generic: bool) -> Bools:
    """Which values are sure enough; none of which nothing is known."""
    bar = least * (GENERIC_WORTH if generic else 1.0)
    return np.asarray((sure >= bar) & (sure > 0.0))


def _against_generic(landmarks: Landmarks) -> tuple[LandmarkReading, Floats]:
    """A reading with a guess before the first frame as the neutral face, without that frame; and its doubt (68, m)."""
    before = landmarks.times[0] - 1.0
    guess = guess_neutral(landmarks)
    face = guess.face
    count = min(landmarks.positions.shape[1], len(face))
    faces = np.concatenate([face[None, :count], landmarks.positions[:, :count]])
    with_face = Landmarks(np.append(before, landmarks.times), faces)
    reading = read_landmarks(with_face, neutral=(before, before))
    pose = Pose3(reading.pose.rotations[1:], reading.pose.scales[1:], reading.pose.shifts[1:])
    names = [name for name, number in landmark_numbers().items() if number < count]
    errors = guess.errors[:, [landmark_numbers()[name] for name in names]]
    doubt = shifts_as_faps(errors, names, reading.units).T
    return replace(reading, frames=reading.frames[1:], chosen=reading.chosen[:0], pose=pose), doubt
