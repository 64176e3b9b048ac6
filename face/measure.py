"""Reading FAPs and the paper's features off a deformed face."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..errors import ModelError, ParameterError
from ..mpeg4 import ANGLE_UNIT, FAP_COUNT, FEATURES
from .anatomy import Anatomy
from .mesh.fap_units import unit_length


def _checked(anatomy: Anatomy, positions: Floats) -> Floats:
    """Positions as float64 of the mesh's shape, finite."""
    positions = np.asarray(positions, dtype=np.float64)
    expected = anatomy.mesh.positions.shape
    if positions.shape != expected:
        raise ParameterError("positions", f"must have the neutral mesh's shape {expected}", positions.shape)
    if not np.isfinite(positions).all():
        raise ParameterError("positions", "must be finite", "NaN or infinite coordinates")
    return positions


def measure(anatomy: Anatomy, positions: Floats) -> Floats:
    """(68,) FAPs of deformed vertices (V, 3) in FAP units; NaN where the face has no such point (and for FAPs 1 and 2).

    The head's own turn (FAPs 48-50) is taken out first where the mesh shows a skull; FAPs are measured along the
    head's axes as ISO/IEC 14496-2 gives them.
    """
    faps = np.full(FAP_COUNT, np.nan)
    rest = anatomy.mesh.positions
    head, positions = rest.copy(), _checked(anatomy, positions)
    for read in (anatomy.measured, anatomy.head_turn.skull):
        head[read] = anatomy.mesh.head_frame.to_head(positions[read])
    head, turn = anatomy.head_turn.undo(head, rest, anatomy.measured)
    for number, value in turn.items():
        faps[number - 1] = value
    rows = anatomy.rows
    reader = anatomy.points.matrix(rows.names)
    shift = np.asarray(reader @ (head - rest))
    faps[rows.numbers - 1] = (shift * rows.directions).sum(axis=1) / rows.units
    roll = _tongue_roll(anatomy, head, rest)
    if roll is not None:
        faps[47 - 1] = roll
    for ball in anatomy.eyeballs:
        for number, value in ball.measure(head[ball.index]).items():
            faps[number - 1] = value
    return faps


def _tongue_roll(anatomy: Anatomy, head: Floats, rest: Floats) -> float | None:
    """FAP 47 of vertices (V, 3) in head space: how far both borders 6.3 and 6.4 turned up about the middle 6.2."""
    points, names = anatomy.mesh.points, ("6.2", "6.3", "6.4")
    if anatomy.tongue is None or any(name not in points or not points[name].is_bound for name in names):
        return None
    reader = points.matrix(names)
    before, after = np.asarray(reader @ rest), np.asarray(reader @ head)
    rise = (after - before)[1:, 1] - (after - before)[0, 1]
    aside = np.abs(after[1:, 0] - after[0, 0])
    return float(np.arctan2(rise, aside).mean()) / ANGLE_UNIT


def features(anatomy: Anatomy, positions: Floats) -> Floats:
    """(15,) features of Table 3 (Raouzaiou et al. 2002) in FAP units of the features.

    Raises
    ------
    ModelError : names a feature point that the face lacks.
    """
    now = _checked(anatomy, positions)
    rest = anatomy.mesh.head_frame.to_face(anatomy.mesh.positions)
    points = anatomy.points
    values = np.empty(len(FEATURES))
    for i, feature in enumerate(FEATURES):
        pair = (feature.point_a, feature.point_b)
        missing = [name for name in pair if name not in points or not points[name].is_bound]
        if missing:
            raise ModelError(f"feature f{i + 1} needs the feature point {' and '.join(missing)}")
        reader = points.matrix(pair)
        before, after = (float(np.linalg.norm(np.diff(np.asarray(reader @ p), axis=0))) for p in (rest, now))
        values[i] = feature.value(after, before, unit_length(feature.unit, anatomy.mesh.units))
    return values
