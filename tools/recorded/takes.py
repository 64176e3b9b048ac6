"""The recordings of real people in the shared folder."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import risorius.api as api
from places import shared_folder
from risorius.api import Recording
from risorius.arrays import Bools, Floats

#: Title -> file in the shared folder's samples.
TAKES = {
    "Live Link Face": "trackers/livelink/range_of_motion.csv",
    "OpenFace": "trackers/pyfeat/OpenFace_Test.csv",
}

BLINK = "EyeBlinkLeft"


@dataclass(frozen=True, eq=False)
class Take:
    """One recording.

    Attributes
    ----------
    title : of its tracker. recording : as it was read. frames : (T, 68) as a face plays them.
    blinks : (T,) the file's own score of the left eye's blink, NaN where it has none.
    """

    title: str
    recording: Recording
    frames: Floats
    blinks: Floats

    @property
    def unknown(self) -> Bools:
        """(T,) where nothing is known."""
        return np.asarray(np.isnan(self.recording.stream.frames).all(axis=1))


def read_take(title: str) -> Take:
    """One recording of `TAKES`."""
    path = shared_folder() / "samples" / TAKES[title]
    recording = api.read_recording(path)
    frames, _ = recording.played()
    blinks = np.full(len(frames), np.nan)
    known = np.flatnonzero(recording.stream.mask.any(axis=1))
    scores = _column(path, BLINK)
    if len(scores) == len(known):
        blinks[known] = scores
    return Take(title, recording, frames, blinks)


def _column(path: Path, name: str) -> Floats:
    """(R,) one column of a table as numbers; empty where it has none."""
    with path.open(encoding="utf-8-sig", newline="") as table:
        return np.array([float(row[name]) for row in csv.DictReader(table) if name in row])
