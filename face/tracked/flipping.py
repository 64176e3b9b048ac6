"""Turns that a recording has the other way round: the phone was held otherwise, or the picture was mirrored."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType

from ...arrays import Floats
from ...errors import ParameterError

#: What may be turned round, and the FAPs that change their signs.
FLIPS: Mapping[str, tuple[int, ...]] = MappingProxyType(
    {"yaw": (49,), "pitch": (48,), "roll": (50,), "eye_yaw": (23, 24), "eye_pitch": (25, 26)}
)


def checked_flips(names: Iterable[str]) -> tuple[str, ...]:
    """The names; ParameterError lists what may be turned round."""
    flips = tuple(names)
    for name in flips:
        if name not in FLIPS:
            raise ParameterError("flip", f"must be some of {', '.join(FLIPS)}", name)
    return flips


def flipped(frames: Floats, names: Iterable[str]) -> Floats:
    """(T, 68) FAPs with the named turns the other way round."""
    turned = frames.copy()
    for name in names:
        turned[:, [number - 1 for number in FLIPS[name]]] *= -1.0
    return turned
