"""The emotion wheel: the activation scale, angles on a circle, and the arc between two directions.

Source: Raouzaiou et al. 2002, section 4 (Whissell's activation, Plutchik's angular measure).
"""

from __future__ import annotations

import math

from ...errors import ParameterError

ACTIVATION_MIN = 1.0
ACTIVATION_MAX = 7.0

# Two angles closer than this (degrees) are one direction: far below the table's tenth of a degree, far above rounding.
ANGLE_TOLERANCE = 1e-9


def check_activation(value: float | None, name: str = "activation") -> float:
    """The activation as a float.

    Raises
    ------
    ParameterError
        When it is no number of Whissell's scale, 1 (calm) to 7 (extreme).
    """
    rule = f"must be a number on the scale from {ACTIVATION_MIN:g} (calm) to {ACTIVATION_MAX:g} (extreme)"
    try:
        number = float(value)  # type: ignore[arg-type]  # None is refused below like any other non-number
    except (TypeError, ValueError):
        raise ParameterError(name, rule, value) from None
    if not ACTIVATION_MIN <= number <= ACTIVATION_MAX:  # NaN fails this too
        raise ParameterError(name, rule, value)
    return number


def check_angle(value: float, name: str = "angle") -> float:
    """The angle in degrees, brought into [0, 360).

    Raises
    ------
    ParameterError
        When it is no finite number.
    """
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ParameterError(name, "must be a number of degrees", value) from None
    if not math.isfinite(number):
        raise ParameterError(name, "must be a finite number of degrees", value)
    wrapped = number % 360.0
    return 0.0 if wrapped == 360.0 else wrapped  # -1e-20 % 360 rounds up to 360


def turn(start: float, end: float) -> float:
    """Degrees from one angle to another going up the scale, in [0, 360)."""
    return check_angle(end - start)


def position(angle: float, start: float, end: float) -> float:
    """Where an angle lies on the shorter arc between two others: 0 at `start`, 1 at `end`.

    This is the weight of `end` in equations (5) and (6), read as the worked example (13) has them. The wheel is a
    circle, so the arc from 323.4 to 70.3 runs through 0. Two directions that are one have the weight 1/2; opposite
    directions have two arcs, and the one that holds the angle is taken.

    Raises
    ------
    ParameterError
        When the angle lies outside the shorter arc.
    """
    angle, start, end = check_angle(angle), check_angle(start), check_angle(end)
    arc, reached = turn(start, end), turn(start, angle)
    if reached >= 360.0 - ANGLE_TOLERANCE:  # a hair before the start
        reached = 0.0
    if abs(arc - 180.0) <= ANGLE_TOLERANCE:
        return min(reached, 360.0 - reached) / 180.0
    if arc > 180.0:
        return 1.0 - position(angle, end, start)
    if reached > arc + ANGLE_TOLERANCE:
        raise ParameterError("angle", f"must be on the shorter arc between {start:g} and {end:g} degrees", angle)
    return min(reached / arc, 1.0) if arc > ANGLE_TOLERANCE else 0.5
