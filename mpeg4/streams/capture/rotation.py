"""Rotations of a head as FAPs 48 to 50: pitch (down), yaw (to the subject's left), roll (to the right shoulder)."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from ....arrays import Floats
from ....errors import FormatError
from ...standard import ANGLE_UNIT

#: No head and no eye turns further than this, in rad; larger figures are degrees.
MOST_RADIANS = 3.5


def in_radians(
    angles: Mapping[str, Floats], refuse: Callable[[int, str, str], FormatError]
) -> tuple[dict[str, Floats], tuple[str, ...]]:
    """Angles (T,) by name in rad, and what was assumed: those of a file are all in one unit, which the largest tells.

    Parameters
    ----------
    refuse : the error for an angle of more than a whole turn: its row, its name, the problem.
    """
    largest = max((float(np.nanmax(np.abs(values), initial=0.0)) for values in angles.values()), default=0.0)
    if largest <= MOST_RADIANS:
        return dict(angles), ()
    for name, values in angles.items():
        beyond = np.flatnonzero(np.abs(np.nan_to_num(values)) > 360.0)
        if len(beyond):
            problem = f"must be an angle in rad or degrees, but it is {values[beyond[0]]:g}: correct or remove it"
            raise refuse(int(beyond[0]), name, problem)
    said = f"its turns go up to {largest:.3g}: taken as degrees"
    return {name: np.radians(values) for name, values in angles.items()}, (said,)


def euler_matrix(x: Floats, y: Floats, z: Floats) -> Floats:
    """(T, 3, 3) rotations Rx Ry Rz from angles (T,) in rad, right-handed."""
    zero, one = np.zeros_like(x), np.ones_like(x)
    about_x = np.array([[one, zero, zero], [zero, np.cos(x), -np.sin(x)], [zero, np.sin(x), np.cos(x)]])
    about_y = np.array([[np.cos(y), zero, np.sin(y)], [zero, one, zero], [-np.sin(y), zero, np.cos(y)]])
    about_z = np.array([[np.cos(z), -np.sin(z), zero], [np.sin(z), np.cos(z), zero], [zero, zero, one]])
    product: Floats = np.einsum("ijt,jkt,klt->til", about_x, about_y, about_z)
    return product


def head_faps(rotations: Floats) -> Floats:
    """(T, 3) FAPs 48, 49 and 50 of rotations (T, 3, 3) in the head's axes: left, up, forward.

    The order is that of the head's motion (`face.bodies.head_turn`): yaw, then pitch, then roll, about axes that
    stand still.
    """
    yaw = np.arctan2(-rotations[:, 2, 0], rotations[:, 2, 2])
    pitch = np.arcsin(np.clip(rotations[:, 2, 1], -1.0, 1.0))
    roll = np.arctan2(-rotations[:, 0, 1], rotations[:, 1, 1])
    return np.stack([pitch, yaw, roll], axis=1) / ANGLE_UNIT


def in_head_axes(rotations: Floats, axes: Floats) -> Floats:
    """(T, 3, 3) rotations in a tracker's axes as rotations in left, up and forward.

    Parameters
    ----------
    axes : (3, 3) rows are the subject's left, up and forward in the tracker's axes, for a face that looks straight on.
    """
    turned: Floats = axes @ rotations @ axes.T
    return turned
