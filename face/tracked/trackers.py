"""The files of trackers: how each format is recognised, and how it becomes samples of FAPs. A new one is a row here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeAlias, TypeVar

from ...mpeg4.streams.capture import JsonFrame, Samples, TableFile
from ...mpeg4.streams.capture.fap_csv import holds_faps, read_fap_csv
from ...mpeg4.streams.capture.landmark_file import (
    Landmarks,
    holds_landmarks,
    landmarks_from_csv,
    landmarks_from_json,
)
from ...mpeg4.streams.capture.live_link import holds_arkit, read_arkit
from ...mpeg4.streams.capture.mediapipe_scores import read_scores
from ...mpeg4.streams.capture.openface import PY_FEAT, holds_openface, holds_py_feat, read_openface
from .formats import StreamFormat
from .mediapipe_landmarks import read_landmarks
from .neutral import Neutral

#: Width over height of an image, if nobody says it.
ASPECT = 16.0 / 9.0

Content = TypeVar("Content")


@dataclass(frozen=True)
class Told:
    """What a caller knows of a recording that its file may not say; see `recording.read_recording`."""

    rate: float | None = None
    start: float | str | None = None
    face: int | None = None
    aspect: float = ASPECT
    neutral: Neutral | None = None


@dataclass(frozen=True)
class Tracker(Generic[Content]):
    """One format.

    Attributes
    ----------
    formats : what it is taken for where it is recognised, then others that may be said of it.
    example : what it is recognised by, in words for people.
    holds : whether a file holds it. samples : what the file says, as FAPs; raises a FormatError.
    """

    formats: tuple[StreamFormat, ...]
    example: str
    holds: Callable[[Content], bool]
    samples: Callable[[Content, Told], Samples]


Frames: TypeAlias = list[JsonFrame]

TABLES: tuple[Tracker[TableFile], ...] = (
    Tracker(
        (StreamFormat.FAPS,),
        "FAPs (F03_open_jaw)",
        holds_faps,
        lambda table, told: read_fap_csv(table, rate=told.rate, start=told.start, face=told.face),
    ),
    Tracker(
        (StreamFormat.ARKIT,),
        "ARKit (jawOpen)",
        lambda table: holds_py_feat(table) and holds_arkit(table),  # Py-Feat's newer detectors have blend shapes, too
        lambda table, told: read_arkit(table, rate=told.rate, start=told.start, face=told.face),
    ),
    Tracker(
        (StreamFormat.LANDMARKS,),
        "landmarks (x_0)",
        holds_landmarks,
        lambda table, told: _samples(
            landmarks_from_csv(table, aspect=told.aspect, rate=told.rate, face=told.face), told
        ),
    ),
    Tracker(
        (StreamFormat.PY_FEAT,),
        "Py-Feat (AU01)",
        holds_py_feat,
        lambda table, told: read_openface(table, rate=told.rate, start=told.start, face=told.face, preset=PY_FEAT),
    ),
    Tracker(
        (StreamFormat.OPENFACE,),
        "OpenFace (AU01_r)",
        holds_openface,
        lambda table, told: read_openface(table, rate=told.rate, start=told.start, face=told.face),
    ),
    Tracker(
        (StreamFormat.ARKIT, StreamFormat.MEDIAPIPE),
        "ARKit (jawOpen)",
        holds_arkit,
        lambda table, told: read_arkit(table, rate=told.rate, start=told.start, face=told.face),
    ),
)
"""CSV files, in the order in which they are looked for."""

RECORDINGS: tuple[Tracker[Frames], ...] = (
    Tracker(
        (StreamFormat.MEDIAPIPE, StreamFormat.ARKIT),
        "blend shapes",
        lambda frames: _any_has("blendshapes", frames),
        lambda frames, told: read_scores(frames, rate=told.rate, start=told.start, face=told.face),
    ),
    Tracker(
        (StreamFormat.LANDMARKS,),
        "landmarks",
        lambda frames: _any_has("landmarks", frames),
        lambda frames, told: _samples(
            landmarks_from_json(frames, aspect=told.aspect, rate=told.rate, face=told.face), told
        ),
    ),
)
"""JSON files with a list of frames, likewise."""


def _any_has(name: str, frames: Frames) -> bool:
    """Whether any frame has an entry."""
    return any(frame.entry(name) is not None for frame in frames)


def _samples(landmarks: Landmarks, told: Told) -> Samples:
    """The samples of landmarks."""
    frames = read_landmarks(landmarks, neutral=told.neutral).frames
    if landmarks.rows is None:
        return Samples(landmarks.times, frames)
    return Samples.at_times(landmarks.rows, frames, start=told.start)
