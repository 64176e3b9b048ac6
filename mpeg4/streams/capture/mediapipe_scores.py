"""MediaPipe's blend shape scores: the 52 names of ARKit (``_neutral`` in place of tongueOut), JSON.

Tables of them in CSV are read as any table of ARKit blend shapes (`live_link`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from ....arrays import Floats
from ....errors import FormatError
from .json_file import JsonFrame, chosen_face, json_times, of_one_face
from .json_scores import category
from .live_link import faps_of_turns
from .rotation import head_faps, in_radians
from .samples import Samples
from .scores import faps_of_scores, unread_words
from .seeming import what_it_seems
from .shape_names import is_turn, means_nothing, shape_named


def read_scores(
    frames: list[JsonFrame],
    *,
    rate: float | None = None,
    start: float | str | None = None,
    face: int | None = None,
) -> Samples:
    """The samples of frames with blend shapes, and the head's pose where they have a transformation matrix.

    Parameters
    ----------
    rate, start : see `times.placed` and `times.Times.since_first`. face : which of several, from 0 on.

    Raises
    ------
    FormatError : no frame has blend shapes, or an entry that is none: names the frame. Several faces: says how many.
    ParameterError : there is no such face.
    """
    frames, face = of_one_face(frames, face)
    faces = [_faces(frame) for frame in frames]
    chosen = chosen_face(frames, [len(found) for found in faces], face)
    scores = [
        _scores(frame, found[chosen]) if chosen < len(found) else {} for frame, found in zip(frames, faces, strict=True)
    ]
    names = dict.fromkeys(name for score in scores for name in score)
    if not any(shape_named(name) for name in names):
        problem = f"has no blend shapes with ARKit's names, such as jawOpen: {what_it_seems(list(names))}"
        raise FormatError(frames[0].path, problem)
    known = {name: np.array([score.get(name, math.nan) for score in scores]) for name in names}
    columns = {name: values for name, values in known.items() if not means_nothing(name) and not is_turn(name)}
    values, assumed, unread = faps_of_scores(columns, _refuser(frames))
    angles, in_degrees = in_radians({name: values for name, values in known.items() if is_turn(name)}, _refuser(frames))
    turned = faps_of_turns(angles, len(frames))
    values = np.where(np.isnan(values), turned, values)
    posed = head_faps(np.stack([rotation_of(frame, chosen) for frame in frames]))
    values[:, 47:50] = np.where(np.isnan(posed), turned[:, 47:50], posed)
    times = json_times(frames, rate)
    said = (*times.assumed, *assumed, *in_degrees, *unread_words(unread))
    return Samples.at_times(replace(times, assumed=said), values[times.rows], start=start)


def _refuser(frames: list[JsonFrame]) -> Callable[[int, str, str], FormatError]:
    """The error for a value: its frame, its name, the problem."""
    return lambda row, name, problem: frames[row].refuse(name, problem)


def _faces(frame: JsonFrame) -> list[Any]:
    """The blend shapes of each face of a frame; none where no face was seen."""
    found: Any = frame.entry("blendshapes")
    if found is None:
        return []
    if isinstance(found, list) and not any(category(entry) is not None for entry in found):
        several = [face for face in found if isinstance(face, list) or (isinstance(face, dict) and "score" not in face)]
        return several if len(several) == len(found) else [found]
    return [found]


def _scores(frame: JsonFrame, found: Any) -> dict[str, float]:
    """Score by name of one face."""
    if isinstance(found, dict) and isinstance(found.get("categories"), list):
        found = found["categories"]
    if isinstance(found, dict) and category(found) is None:
        return {str(name): frame.number_at(f"blendshapes.{name}", score) for name, score in found.items()}
    if not isinstance(found, list):
        raise frame.refuse("blendshapes", "must be an object of name and score, or a list of categories")
    scores = {}
    for entry in found:
        named = category(entry)
        if named is None:
            raise frame.refuse("blendshapes", f"must contain a name and a score, but it contains {str(entry)[:40]!r}")
        scores[named[0]] = frame.number_at(f"blendshapes.{named[0]}", named[1])
    return scores


def _is_matrix(value: Any) -> bool:
    """Whether a value is one of several matrices, not a row of one."""
    return isinstance(value, dict) or (
        isinstance(value, list)
        and (len(value) == 16 or (isinstance(value[:1], list) and len(value) == 4 and isinstance(value[0], list)))
    )


def rotation_of(frame: JsonFrame, face: int = 0) -> Floats:
    """(3, 3) rotation of the head in left, up and forward; NaN where the frame has no transformation matrix.

    MediaPipe's matrix carries its face model (x to the subject's left, y up, z out of the face) before a camera that
    looks along -z: the axes of the head. Python's API gives it by rows, JavaScript's by columns.
    """
    matrix: Any = frame.entry("matrix")
    if isinstance(matrix, list) and len(matrix) > 1 and all(_is_matrix(one) for one in matrix):
        matrix = matrix[face] if face < len(matrix) else None
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
