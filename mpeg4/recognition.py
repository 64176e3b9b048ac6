"""From FAPs back to emotions: Raouzaiou et al. 2002, section 5, equations (8) to (11).

A profile is a fuzzy class per FAP; the belief in it is the product of the observed FAPs' memberships (8); the belief in
an emotion is that in its best profile (9). The shape of the membership function (figure 6) is lost: `membership` is a
bell that is 1 at the centre of the range.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Bools, Floats
from ..errors import ParameterError
from .archetypes import VARIANTS, archetype
from .features import FEATURE_COUNT, faps_from_features
from .profile import ARCHETYPES, Archetype, Profile
from .standard import FAP_COUNT

# Half of the range's length is the paper's own spread. Faces differ in strength by more than the printed variants do,
# so a range is widened to this share of its centre, and to this many units where it is printed around 0. Of 0.35, 0.5,
# 0.75 and 1, this share recognised most archetypes scaled to activations 2 to 7; judged on profiles, not yet on faces.
RELATIVE_WIDTH = 0.75
LEAST_WIDTH = 40.0  # FAP units

# A FAP that was not seen speaks neither for nor against a profile: it counts as one width off the centre. Left out
# instead, it would favour the profiles that ask for what cannot be seen.
UNSEEN_MEMBERSHIP = 0.5

# With less than this share of its FAPs seen, a profile is not judged at all: one lucky FAP is no evidence.
LEAST_SEEN = 0.5

# What recognition works on: (archetype, variant, FAP indices, centres, widths) of every profile.
_Class: TypeAlias = tuple[Archetype, int, tuple[int, ...], Floats, Floats]


class Beliefs(dict[Archetype, float]):
    """Archetype -> belief in [0, 1].

    Attributes
    ----------
    profiles : archetype -> variant -> belief in that profile of Table 5.
    """

    def __init__(self, profiles: Mapping[Archetype, Mapping[int, float]]) -> None:
        super().__init__({name: max(of_variants.values()) for name, of_variants in profiles.items()})
        self.profiles: dict[Archetype, dict[int, float]] = {name: dict(part) for name, part in profiles.items()}

    @property
    def best(self) -> Archetype | None:
        """The emotion of the largest belief (11); None where nothing is believed at all."""
        name = max(self, key=self.__getitem__)
        return name if self[name] > 0.0 else None


def membership(values: Floats, centres: Floats, widths: Floats) -> Floats:
    """Membership in fuzzy classes: 1 at the centre, 1/2 one width away, falling on both sides, never quite 0.

    Parameters
    ----------
    values, centres, widths : arrays of one shape, in FAP units; widths > 0.

    Returns
    -------
    Memberships in (0, 1], of the same shape.
    """
    return np.asarray(1.0 / (1.0 + ((values - centres) / widths) ** 2), dtype=np.float64)


def recognise(frame: ArrayLike) -> Beliefs:
    """Beliefs that a FAP frame shows each archetypal emotion: equations (8) and (9).

    Parameters
    ----------
    frame : (68,) FAPs in FAP units and MPEG-4 signs, index = FAP number - 1; NaN where not observed, which counts as
        a membership of 1/2. A profile of which less than half is observed has the belief 0.

    Returns
    -------
    Archetype -> belief; its ``profiles`` gives each variant's belief, its ``best`` the decision of equation (11).

    Raises
    ------
    ParameterError
        When the frame has another shape or infinite values.
    """
    values = np.asarray(frame, dtype=np.float64)
    if values.shape != (FAP_COUNT,) or np.isinf(values).any():
        raise ParameterError("frame", f"must be {FAP_COUNT} numbers (NaN where unknown)", values.shape)
    return _beliefs(values, np.ones(FAP_COUNT, dtype=np.bool_))


def recognise_features(features: ArrayLike) -> Beliefs:
    """Beliefs from the 15 features of Table 3.

    Parameters
    ----------
    features : (15,) as printed in the table, in FAP units; NaN where unknown. Profiles are judged by the FAPs that
        features can show at all, so that a smile is not held against them for its unmeasured corners.

    Returns
    -------
    As `recognise`.

    Raises
    ------
    ParameterError
        When there are not 15 finite-or-NaN numbers.
    """
    return _beliefs(faps_from_features(features), _shown_by_features())


def _beliefs(values: Floats, visible: Bools) -> Beliefs:
    """Equations (8) and (9) over the visible FAPs, (68,) each; NaN where a visible FAP was not seen."""
    beliefs: dict[Archetype, dict[int, float]] = {name: {} for name in ARCHETYPES}
    for name, variant, indices, centres, widths in _classes():
        asked, judged = values[list(indices)], visible[list(indices)]
        seen = ~np.isnan(asked)
        if not judged.any() or seen.sum() < LEAST_SEEN * judged.sum():
            beliefs[name][variant] = 0.0
            continue
        memberships = np.where(seen, membership(asked, centres, widths), UNSEEN_MEMBERSHIP)
        beliefs[name][variant] = float(memberships[judged].prod())
    return Beliefs(beliefs)


def _shown_by_features() -> Bools:
    """(68,) the FAPs that some feature shows."""
    return ~np.isnan(faps_from_features(np.zeros(FEATURE_COUNT)))


@cache
def _classes() -> tuple[_Class, ...]:
    """The fuzzy classes of all profiles of Table 5, in MPEG-4 signs."""
    return tuple(
        (name, variant, *_class(archetype(name, variant))) for name in ARCHETYPES for variant in VARIANTS[name]
    )


def _class(profile: Profile) -> tuple[tuple[int, ...], Floats, Floats]:
    """FAP indices, centres and widths of one profile."""
    lows, highs = (np.array(ends) for ends in zip(*profile.ranges.values(), strict=True))
    centres = (lows + highs) / 2.0
    widths = np.maximum(np.maximum((highs - lows) / 2.0, RELATIVE_WIDTH * np.abs(centres)), LEAST_WIDTH)
    return tuple(number - 1 for number in profile.ranges), centres, widths
