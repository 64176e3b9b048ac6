"""Where a head has gone: the turn and shift of its skull, whatever its expression."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Floats, Ints
from ..face import Face
from ..mesh.head_frame import rotation_between
from ..tracked.mediapipe_landmarks import stable_points

#: The fit is repeated so often with weight on those that agree, to about this share of the distance of the pupils.
ROUNDS, AGREED = 12, 1e-4


def head_motion(face: Face, positions: ArrayLike) -> tuple[Floats, Floats]:
    """Rotation (3, 3) and shift (3,) that carry a face's skull at rest to where it is: ``rotation @ rest + shift``.

    Parameters
    ----------
    positions : (V, 3) deformed vertices, in any rigid place, metres.

    A mask, which has no skull, is told by feature points that expression hardly moves.

    Examples
    --------
    >>> face = api.default_face()
    >>> pose = face.pose(api.expression("joy").frame())
    >>> turn, shift = api.head_motion(face, pose.positions)
    >>> bool(np.abs(turn - np.eye(3)).max() < 1e-3 and np.abs(shift).max() < 1e-4)
    True
    """
    rest, there = _carriers(face, face.vertices), _carriers(face, np.asarray(positions, dtype=np.float64))
    weights = np.ones(len(rest))
    turn, shift = np.eye(3), np.zeros(3)
    for _ in range(ROUNDS):
        shares = weights / weights.sum()
        middle, moved = shares @ rest, shares @ there
        turn = rotation_between((rest - middle) * shares[:, None], there - moved)
        shift = moved - turn @ middle
        off = np.linalg.norm(rest @ turn.T + shift - there, axis=1)
        weights = 1.0 / (off + AGREED * face.units.es0)
    return turn, shift


def _carriers(face: Face, positions: Floats) -> Floats:
    """(n, 3) places of vertices (V, 3) that expression does not move."""
    skull: Ints = face.anatomy.mesh.with_copies(face.anatomy.head_turn.skull)
    if len(skull) and not face.is_mask:
        return positions[skull]
    names = [name for name in stable_points() if name in face.points and face.points[name].is_bound]
    return np.asarray(face.points.matrix(names) @ positions)
