"""A neutral face of nobody, as MediaPipe sees it.

It stands in where no picture shows the person's own neutral face, and tells whether what was taken for neutral may be.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from ..arrays import Floats
from ..mpeg4.streams.capture import CAPTURE_PRESETS
from ..tables import read_csv
from .face_mesh import LANDMARKS

TABLE = CAPTURE_PRESETS / "generic_face.csv"
AXES = ("left_mm", "up_mm", "forward_mm")

#: Points that lie farther from the generic face than this many times their usual distance are unusual. Of 21 neutral
#: heads one comes to it; smiling photographs come to 4 and more (docs/tracking.md).
UNUSUAL = 1.95

#: Corners of the mouth and the middle of the lower lip, where smiles and speech show first; and where distances begin.
MOUTH, ORIGIN = ("8.3", "8.4", "2.3"), "9.15"


@lru_cache(maxsize=1)
def _rows() -> Mapping[str, Mapping[str, float]]:
    """Feature point -> its row of the table.

    Raises
    ------
    FormatError : the table is damaged.
    """
    columns = ("landmark", *AXES, "spread_mm")
    rows = read_csv(TABLE, "point", *columns)
    return {row.text("point"): {column: row.number(column) for column in columns} for row in rows}


@lru_cache(maxsize=1)
def generic_landmarks() -> Floats:
    """(478, 3) left, up, forward in mm, looking straight on; NaN for landmarks that are no feature points. Read-only.

    Source: presets/capture/generic_face.csv.
    """
    face = np.full((LANDMARKS, 3), np.nan)
    for row in _rows().values():
        face[int(row["landmark"])] = [row[axis] for axis in AXES]
    face.flags.writeable = False
    return face


def unusual_mouth(neutral: Mapping[str, Floats]) -> tuple[str, ...]:
    """Points of the mouth that lie where those of a neutral face seldom do.

    Parameters
    ----------
    neutral : feature point -> (3,) left, up, forward in metres, of a face that has been taken for neutral.
    """
    found = []
    for name in MOUTH:
        row, origin = _rows()[name], _rows()[ORIGIN]
        usual = np.array([row[axis] - origin[axis] for axis in AXES])
        apart = float(np.linalg.norm(1e3 * (neutral[name] - neutral[ORIGIN]) - usual))
        if apart > UNUSUAL * row["spread_mm"]:
            found.append(name)
    return tuple(found)
