"""Left and right of a FAP frame: the mirror, and faces that mean to be symmetric."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....arrays import Floats
from ....mpeg4 import FAP_COUNT, FAPS, Motion
from ...figures import Length, Share, read_figures


@dataclass(frozen=True)
class SymmetryFigures:
    """Which differences of left and right are not meant (presets/anatomy/natural.toml)."""

    units: Length
    share: Share


SYMMETRY = read_figures("natural.symmetry", SymmetryFigures)


def mirror_fap(number: int) -> int:
    """The FAP of the other side, or the same in the middle."""
    return FAPS[number].mirror or number


#: FAPs that move their points to the same side on both halves of the face, and so change sign in the mirror.
SIDEWAYS = tuple(
    number
    for number, fap in FAPS.items()
    if fap.motion in (Motion.LEFT, Motion.RIGHT) and FAPS[mirror_fap(number)].motion is fap.motion
)


def mirrored(faps: Floats) -> Floats:
    """FAPs (68,) as seen in the mirror."""
    seen: Floats = faps[[mirror_fap(number) - 1 for number in range(1, len(faps) + 1)]]
    seen[np.array(SIDEWAYS) - 1] *= -1.0
    return seen


def evened(faps: Floats) -> tuple[Floats, bool]:
    """FAPs (68,) without small differences of left and right, missing sides filled; and whether any larger is left."""
    result = faps.copy()
    asymmetric = False
    for number in range(3, FAP_COUNT + 1):
        other = mirror_fap(number)
        if other <= number:
            continue
        a, b = faps[number - 1], faps[other - 1]
        if np.isnan(a) and np.isnan(b):
            continue
        if np.isnan(a) or np.isnan(b):
            result[[number - 1, other - 1]] = a if np.isnan(b) else b
        elif abs(a - b) <= max(SYMMETRY.units, SYMMETRY.share * max(abs(a), abs(b))):
            result[[number - 1, other - 1]] = (a + b) / 2.0
        else:
            asymmetric = True
    return result, asymmetric
