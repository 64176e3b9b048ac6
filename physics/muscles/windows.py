"""How a muscle's pull falls off along and across it, and the checks its figures share."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError


def longitudinal(ratio: Floats, reach: float, exponent: float) -> Floats:
    """Equations (12) and (20): zero at the attachment, one at the insertion, zero again at the reach and beyond.

    Parameters
    ----------
    ratio : lambda, distance from the attachment over the muscle's length, any shape, >= 0.
    reach : delta > 1, the same ratio at the end of the zone.
    exponent : eta > 0; smaller values spread the influence along the muscle.

    Returns
    -------
    Theta, the shape of `ratio`, in [0, 1].

    Notes
    -----
    Zhang, Sung and Prakash 2001, eqs (12) and (20). The formula is printed for 0 <= lambda <= delta only; outside the
    zone the force is 0.
    """
    power = np.maximum(ratio, 0.0) ** exponent
    rising = np.cos((1 - power) * (np.pi / 2))
    falling = np.cos((power - 1) / (reach**exponent - 1) * (np.pi / 2))
    return np.where(ratio <= 1, rising, np.where(ratio <= reach, falling, 0.0)) * (ratio > 0)


def angular(ratio: Floats, angle: float) -> Floats:
    """Equation (13): one on the muscle's line, zero at its largest angle and beyond.

    Parameters
    ----------
    ratio : gamma, a node's angle from the muscle over `angle`, any shape, >= 0.
    angle : phi in radians, in (0, pi/2].

    Returns
    -------
    Theta_2 = cos(phi gamma) cos(gamma pi/2), the shape of `ratio`, in [0, 1].
    """
    return np.where(ratio <= 1, np.cos(angle * ratio) * np.cos(ratio * (np.pi / 2)), 0.0)


def finite_array(name: str, value: Floats, shape: tuple[int, ...]) -> Floats:
    """The value as a read-only float64 copy of the given shape, or a ParameterError that names it."""
    array = np.array(value, dtype=np.float64)
    if array.shape != shape:
        raise ParameterError(name, f"must have the shape {shape}", array.shape)
    if not np.isfinite(array).all():
        raise ParameterError(name, "must be finite", array.tolist())
    array.flags.writeable = False
    return array


def positive(name: str, value: float) -> None:
    """Raise ParameterError unless the value is finite and above zero."""
    if not (np.isfinite(value) and value > 0):
        raise ParameterError(name, "must be finite and above 0", value)


def directions(vectors: Floats, lengths: Floats) -> Floats:
    """Vectors (V, 3) over their lengths (V,); zero where the length is zero."""
    return np.asarray(vectors / np.where(lengths > 0, lengths, 1.0)[:, None])
