"""Landmarks over time to a FAP stream that says how sure it is, and says nothing where it cannot know."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..errors import ParameterError
from ..face.tracked.landmarks import LandmarkReading, Pose3
from ..face.tracked.mediapipe_landmarks import read_landmarks
from ..mpeg4 import FapStream
from ..mpeg4.streams.capture import Landmarks, Samples
from .generic_face import generic_landmarks, unusual_mouth
from .smoothing import Smoothing, smooth
from .trust import GENERIC_WORTH, confidence

#: The neutral face of nobody, in place of a stretch of the recording.
GENERIC = "generic"

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
    doubts : points of the mouth that a neutral face seldom has where this one does: it may be smiling or speaking.
    delay : seconds by which slow motions come late.
    reading : the same before smoothing, at the pictures' own times, with the head's pose and the neutral face.
    """

    stream: FapStream
    confidence: Floats
    lost: Ints
    neutral: Floats
    generic: bool
    doubts: tuple[str, ...]
    delay: float
    reading: LandmarkReading


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
    neutral : seconds from and to which the face is neutral; "generic": a neutral face of nobody; None: the face's usual
        shape is neutral. A single picture is always read against the generic face.
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
    generic = neutral == GENERIC or len(landmarks.times) == 1
    if generic:
        reading = _against_generic(landmarks)
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
    return Track(stream, sure, lost, chosen, generic, doubts, Smoothing(smoothing).delay, reading)


def _enough(sure: Floats, least: float, generic: bool) -> Bools:
    """Which values are sure enough; none of which nothing is known."""
    bar = least * (GENERIC_WORTH if generic else 1.0)
    return np.asarray((sure >= bar) & (sure > 0.0))


def _against_generic(landmarks: Landmarks) -> LandmarkReading:
    """A reading with the generic face before the first frame as the neutral one, and without that frame."""
    before = landmarks.times[0] - 1.0
    face = generic_landmarks()
    count = min(landmarks.positions.shape[1], len(face))
    faces = np.concatenate([face[None, :count], landmarks.positions[:, :count]])
    with_face = Landmarks(np.append(before, landmarks.times), faces)
    reading = read_landmarks(with_face, neutral=(before, before))
    pose = Pose3(reading.pose.rotations[1:], reading.pose.scales[1:], reading.pose.shifts[1:])
    return replace(reading, frames=reading.frames[1:], chosen=reading.chosen[:0], pose=pose)
