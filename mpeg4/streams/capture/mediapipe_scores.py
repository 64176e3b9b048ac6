"""MediaPipe's blend shape scores: the 52 names of ARKit (``_neutral`` in place of tongueOut), JSON.

Tables of them in CSV are read as any table of ARKit blend shapes (`live_link`).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ....arrays import Floats
from ....errors import FormatError
from .columns import arkit_columns
from .json_file import JsonFrame, json_times
from .rotation import head_faps
from .samples import Samples

SCORE_NAMES = ("category_name", "categoryName", "displayName", "name")


def read_scores(frames: list[JsonFrame], *, rate: float | None = None, start: float | str | None = None) -> Samples:
    """The samples of frames with blend shapes, and the head's pose where they have a transformation matrix.

    Raises
    ------
    FormatError : no frame has blend shapes, or an entry that is none: names the frame.
    """
    scores = [_scores(frame) for frame in frames]
    known = {name for score in scores for name in score} & set(arkit_columns().gains)
    if not known:
        raise FormatError(
            frames[0].path, "has no blend shapes with ARKit's names: turn on output_face_blendshapes in MediaPipe"
        )
    columns = {name: np.array([score.get(name, math.nan) for score in scores]) for name in known}
    values = arkit_columns().frames(columns)
    values[:, 47:50] = head_faps(np.stack([rotation_of(frame) for frame in frames]))
    times = json_times(frames, rate)
    return Samples.at_times(times, values[times.rows], start=start)


def _scores(frame: JsonFrame) -> dict[str, float]:
    """Score by name in lower case; empty where no face was seen."""
    found: Any = frame.entry("blendshapes")
    while isinstance(found, list) and len(found) == 1 and not _is_score(found[0]):
        found = found[0]
    if isinstance(found, dict) and isinstance(found.get("categories"), list):
        found = found["categories"]
    if found is None:
        return {}
    if isinstance(found, dict):
        return {str(name).lower(): frame.number_at(f"blendshapes.{name}", score) for name, score in found.items()}
    if not isinstance(found, list):
        raise frame.refuse("blendshapes", "must be an object of name and score, or a list of categories")
    scores = {}
    for entry in found:
        if not isinstance(entry, dict) or not _is_score(entry):
            raise frame.refuse("blendshapes", f"must contain a name and a score, but it contains {str(entry)[:40]!r}")
        name = next(str(entry[key]) for key in SCORE_NAMES if entry.get(key))
        scores[name.lower()] = frame.number_at(f"blendshapes.{name}", entry["score"])
    return scores


def _is_score(entry: Any) -> bool:
    """Whether an entry is one category with its score."""
    return isinstance(entry, dict) and "score" in entry and any(entry.get(key) for key in SCORE_NAMES)


def rotation_of(frame: JsonFrame) -> Floats:
    """(3, 3) rotation of the head in left, up and forward; NaN where the frame has no transformation matrix.

    MediaPipe's matrix carries its face model (x to the subject's left, y up, z out of the face) before a camera that
    looks along -z: the axes of the head. Python's API gives it by rows, JavaScript's by columns.
    """
    matrix: Any = frame.entry("matrix")
    while isinstance(matrix, list) and len(matrix) == 1:
        matrix = matrix[0]
    if isinstance(matrix, dict):
        matrix = matrix.get("data")
    if matrix is None:
        return np.full((3, 3), np.nan)
    flat = (
        [value for row in matrix for value in (row if isinstance(row, list) else [row])]
        if isinstance(matrix, list)
        else []
    )
    if len(flat) != 16:
        raise frame.refuse("matrix", f"must have 16 numbers, but it has {len(flat)}")
    whole = np.array([frame.number_at("matrix", value) for value in flat]).reshape(4, 4)
    if np.abs(whole[3, :3]).max() > 1e-6:
        whole = whole.T
    if not np.isfinite(whole).all() or not np.linalg.det(whole[:3, :3]) > 0.0:
        raise frame.refuse("matrix", "must be a rotation with a shift and a scale")
    u, _, vt = np.linalg.svd(whole[:3, :3])
    rotation: Floats = u @ vt
    return rotation
