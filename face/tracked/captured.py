"""What trackers saw becomes samples of FAPs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType

import numpy as np

from ...errors import ParameterError
from ...mpeg4.streams.capture import (
    CAPTURE_PRESETS,
    JsonFrame,
    Landmarks,
    Samples,
    TableFile,
    landmarks_from_csv,
    landmarks_from_json,
    read_arkit,
    read_fap_csv,
    read_openface,
    read_scores,
)
from ...tables import TomlTable, read_toml
from .formats import StreamFormat
from .landmarks import LandmarkReading, read_points

#: Width over height of an image, if nobody says it.
ASPECT = 16.0 / 9.0

TOPOLOGIES = CAPTURE_PRESETS.parent / "topologies"


@dataclass(frozen=True)
class Told:
    """What a caller knows of a recording that its file may not say; see `recording.read_recording`."""

    rate: float | None = None
    aspect: float = ASPECT
    neutral: tuple[float, float] | None = None


def samples_of_table(table: TableFile, format: StreamFormat, told: Told) -> Samples:
    """The samples of a tracker's CSV file, or of a table of FAPs.

    Raises
    ------
    FormatError : names line and column. ParameterError, ModelError : see `read_landmarks`.
    """
    if format is StreamFormat.LANDMARKS:
        return _samples(landmarks_from_csv(table, aspect=told.aspect, rate=told.rate), told)
    if format is StreamFormat.OPENFACE:
        return read_openface(table)
    if format is StreamFormat.FAPS:
        return read_fap_csv(table)
    return read_arkit(table, rate=told.rate)


def samples_of_json(recorded: list[JsonFrame], format: StreamFormat, told: Told) -> Samples:
    """The samples of a tracker's JSON file; errors as `samples_of_table`, naming the frame."""
    if format is StreamFormat.LANDMARKS:
        return _samples(landmarks_from_json(recorded, aspect=told.aspect, rate=told.rate), told)
    return read_scores(recorded, rate=told.rate)


def _samples(landmarks: Landmarks, told: Told) -> Samples:
    """The samples of landmarks."""
    return Samples(landmarks.times, read_landmarks(landmarks, neutral=told.neutral).frames, landmarks.assumed)


def read_landmarks(landmarks: Landmarks, *, neutral: tuple[float, float] | None = None) -> LandmarkReading:
    """FAPs of MediaPipe's landmarks.

    Parameters
    ----------
    neutral : seconds from and to which the face is neutral; None: its usual shape is.

    Raises
    ------
    ParameterError, ModelError : see `landmarks.read_points`.
    """
    preset, points = _preset(), landmark_numbers()
    tracked = {name: index for name, index in points.items() if index < landmarks.positions.shape[1]}
    stretch = None
    if neutral is not None:
        inside = np.flatnonzero((landmarks.times >= neutral[0]) & (landmarks.times <= neutral[1]))
        if len(inside) == 0:
            raise ParameterError("neutral", f"must be in 0..{landmarks.times[-1]:.2f} seconds", neutral)
        stretch = (int(inside[0]), int(inside[-1]))
    return read_points(
        landmarks.positions[:, list(tracked.values())],
        list(tracked),
        stable=preset.texts("stable"),
        eye_radius=preset.number("eye_radius"),
        unseen=[int(number) for number in preset.numbers("unseen")],
        neutral=stretch,
    )


@lru_cache(maxsize=1)
def _preset() -> TomlTable:
    """What MediaPipe's landmarks are and can tell."""
    return read_toml(CAPTURE_PRESETS / "mediapipe_landmarks.toml")


@lru_cache(maxsize=1)
def landmark_numbers() -> Mapping[str, int]:
    """Feature point -> MediaPipe's landmark."""
    tables = read_toml(TOPOLOGIES / _preset().text("topology")).table("points"), _preset().table("pupils")
    return MappingProxyType({name: table.integer(name) for table in tables for name in table})
