"""How far a camera can be trusted: per FAP by measurement, per frame by where the camera stands."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType

import numpy as np

from ..arrays import Floats
from ..errors import FormatError
from ..face.tracked.landmarks import LandmarkReading
from ..mpeg4 import FAP_COUNT, FAPS
from ..mpeg4.streams.capture import CAPTURE_PRESETS
from ..tables import read_csv

TABLE = CAPTURE_PRESETS / "camera_faps.csv"

#: Skin turned less than this from the camera (cosine) is seen as well as from the front; the edge of the face is not.
WELL_SEEN = float(np.cos(np.radians(50.0)))

#: Points before the ears, the middle of which is taken for the middle of the head.
EARS = ("10.7", "10.8", "10.9", "10.10")

#: What a reading against a neutral face of nobody is worth beside one against the person's own.
GENERIC_WORTH = 0.5


@dataclass(frozen=True)
class CameraFap:
    """What a camera can tell of one FAP.

    Attributes
    ----------
    number : FAP number. trust : 0 (unseen) to 1, the measured correlation of what was read with what was shown.
    reason : why the camera cannot see it, or what it mistakes; empty where it sees it.
    """

    number: int
    trust: float
    reason: str


@lru_cache(maxsize=1)
def camera_faps() -> Mapping[int, CameraFap]:
    """FAP number -> what a camera can tell of it, for FAPs 3 to 68; presets/capture/camera_faps.csv.

    Raises
    ------
    FormatError : the table is damaged.
    """
    table = {}
    for row in read_csv(TABLE, "fap", "trust", "reason"):
        number = row.integer("fap", least=3, most=FAP_COUNT)
        table[number] = CameraFap(number, row.number("trust", least=0.0, most=1.0), row.text("reason", ""))
    if sorted(table) != list(range(3, FAP_COUNT + 1)):
        raise FormatError(TABLE, f"must have each of FAPs 3 to {FAP_COUNT}: install Risorius again")
    return MappingProxyType(table)


def confidence(reading: LandmarkReading, *, generic: bool = False) -> Floats:
    """(T, 68) confidence in 0..1 of a reading's FAPs; 0 where they are unknown.

    The measured trust in the FAP, times how far its feature point is turned to the camera (the further side of a turned
    head is guessed), times `GENERIC_WORTH` where the neutral face is nobody's.
    """
    worth = np.array([0.0, 0.0, *(camera_faps()[number].trust for number in range(3, FAP_COUNT + 1))])
    facing = np.array([_facing(reading, FAPS[number].feature_point) for number in FAPS]).T
    known = ~np.isnan(reading.frames)
    sure: Floats = np.where(known, worth * np.nan_to_num(facing) * (GENERIC_WORTH if generic else 1.0), 0.0)
    return sure


def _facing(reading: LandmarkReading, point: str | None) -> Floats:
    """(T,) 1 where a feature point of the face looks at the camera, 0 where it looks away, NaN without a face."""
    face = reading.neutral
    if point is None or point not in face or any(ear not in face for ear in EARS):
        return np.where(np.isnan(reading.pose.scales), np.nan, 1.0)
    outward = face[point] - np.mean([face[ear] for ear in EARS], axis=0)
    outward = np.array([outward[0], 0.0, outward[2]])  # round the head's height; lids and chin look ahead too
    towards = reading.pose.rotations[:, 2] @ outward / np.linalg.norm(outward)
    facing: Floats = np.clip(towards / WELL_SEEN, 0.0, 1.0)
    return facing
