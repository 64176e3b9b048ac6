"""A neutral face of nobody, as MediaPipe sees it: stands in where no picture shows the person's own neutral face."""

from __future__ import annotations

import csv
from functools import lru_cache

import numpy as np

from ..arrays import Floats
from ..mpeg4.capture import CAPTURE_PRESETS
from .face_mesh import LANDMARKS

TABLE = CAPTURE_PRESETS / "generic_face.csv"


@lru_cache(maxsize=1)
def generic_landmarks() -> Floats:
    """(478, 3) left, up, forward in mm, looking straight on; NaN for landmarks that are no feature points. Read-only.

    Source: presets/capture/generic_face.csv.
    """
    face = np.full((LANDMARKS, 3), np.nan)
    with TABLE.open(encoding="utf-8") as stream:
        for row in csv.DictReader(line for line in stream if not line.startswith("#")):
            face[int(row["landmark"])] = [float(row[axis]) for axis in ("left_mm", "up_mm", "forward_mm")]
    face.flags.writeable = False
    return face
