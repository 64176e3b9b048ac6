"""Profiles as fuzzy classes: Raouzaiou et al. 2002, section 5, figure 6.

A profile is a fuzzy class per FAP. The shape of the membership function is lost: `membership` is the one that served
the emotion best that fared worst on posed faces (docs/evidence.md).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType

import numpy as np

from ...arrays import Floats
from .archetypes import VARIANTS, archetype
from .profile import ARCHETYPES, Archetype, Profile

# Half of the range's length is the paper's own spread. Faces differ in strength by more than the printed variants do,
# so a range is widened to this share of its centre, and to this many units where it is printed around 0. Chosen with
# the shape on posed faces (docs/evidence.md).
RELATIVE_WIDTH = 1.0
LEAST_WIDTH = 80.0  # FAP units

# With less than this share of its FAPs seen, a profile is not judged at all: one lucky FAP is no evidence.
LEAST_SEEN = 0.5

# What a membership is taken for at least where FAPs are compared by logarithms.
LEAST_MEMBERSHIP = 1e-6


@dataclass(frozen=True, eq=False)
class FuzzyClass:
    """What recognition works on: FAP indices, centres and widths of one profile, (k,) each."""

    indices: tuple[int, ...]
    centres: Floats
    widths: Floats

    @classmethod
    def of(cls, profile: Profile) -> FuzzyClass:
        """The fuzzy class of one profile."""
        lows, highs = (np.array(ends) for ends in zip(*profile.ranges.values(), strict=True))
        centres = (lows + highs) / 2.0
        widths = np.maximum(np.maximum((highs - lows) / 2.0, RELATIVE_WIDTH * np.abs(centres)), LEAST_WIDTH)
        return cls(tuple(number - 1 for number in profile.ranges), centres, widths)

    def memberships(self, values: Floats) -> Floats:
        """(k,) memberships of a frame (68,); NaN where not seen."""
        asked = values[list(self.indices)]
        found: Floats = np.where(np.isnan(asked), np.nan, membership(asked, self.centres, self.widths))
        return found


def membership(values: Floats, centres: Floats, widths: Floats) -> Floats:
    """Membership in fuzzy classes: 1 at the centre, 1/2 one width away, a normal curve.

    Parameters
    ----------
    values, centres, widths : arrays of one shape, in FAP units; widths > 0.

    Returns
    -------
    Memberships in [0, 1], of the same shape.
    """
    return np.asarray(np.exp2(-(((values - centres) / widths) ** 2)), dtype=np.float64)


@cache
def archetype_classes() -> Mapping[tuple[Archetype, int], FuzzyClass]:
    """The fuzzy classes of all profiles of Table 5, in MPEG-4 signs, by emotion and variant."""
    found = {
        (name, variant): FuzzyClass.of(archetype(name, variant)) for name in ARCHETYPES for variant in VARIANTS[name]
    }
    return MappingProxyType(found)
