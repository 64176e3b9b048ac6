"""MediaPipe's landmarks of a face mesh as FAPs: which of them are feature points, and how sure it is of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from types import MappingProxyType

from ...mpeg4.streams.capture import CAPTURE_PRESETS, Landmarks
from ...tables import TomlTable, read_toml
from .landmarks import LandmarkReading, read_points
from .neutral import Neutral, neutral_rows

TOPOLOGIES = CAPTURE_PRESETS.parent / "topologies"


def read_landmarks(landmarks: Landmarks, *, neutral: Neutral | None = None) -> LandmarkReading:
    """FAPs of MediaPipe's landmarks.

    Parameters
    ----------
    neutral : seconds from and to which the face is neutral, or a frame's number; None: its usual shape is.

    Raises
    ------
    ParameterError, ModelError : see `landmarks.read_points`.
    """
    preset, points = _preset(), landmark_numbers()
    tracked = {name: index for name, index in points.items() if index < landmarks.positions.shape[1]}
    stretch = None
    if neutral is not None:
        inside = neutral_rows(neutral, landmarks.times, landmarks.rate)
        stretch = (int(inside[0]), int(inside[-1]))
    return read_points(
        landmarks.positions[:, list(tracked.values())],
        list(tracked),
        stable=stable_points(),
        eye_radius=preset.number("eye_radius"),
        unseen=[int(number) for number in preset.numbers("unseen")],
        neutral=stretch,
    )


@lru_cache(maxsize=1)
def _preset() -> TomlTable:
    """What MediaPipe's landmarks are and can tell."""
    return read_toml(CAPTURE_PRESETS / "mediapipe_landmarks.toml")


def stable_points() -> Sequence[str]:
    """Feature points that expression does not move; they carry the head's pose."""
    return _preset().texts("stable")


@lru_cache(maxsize=1)
def landmark_numbers() -> Mapping[str, int]:
    """Feature point -> MediaPipe's landmark."""
    tables = read_toml(TOPOLOGIES / _preset().text("topology")).table("points"), _preset().table("pupils")
    return MappingProxyType({name: table.integer(name) for table in tables for name in table})
