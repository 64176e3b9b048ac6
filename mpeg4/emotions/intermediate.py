"""Emotions between two archetypal ones: Raouzaiou et al. 2002, section 4.2, Rules 1 to 6.

Equations (5) and (6) are printed with their weights swapped: as printed, an emotion close to A_1 would take nearly all
of A_2. The worked example (13), which reproduces Table 8, gives the nearer emotion the larger weight; so does this.
"""

from __future__ import annotations

from ...errors import ParameterError
from .profile import Archetype, Profile, Range
from .wheel import check_activation, check_angle, position


def between(first: Profile, second: Profile, *, activation: float, angle: float) -> Profile:
    """The profile of an emotion between two others on the wheel.

    Rule 1: it employs the FAPs of either. Rule 2: a FAP of both, in the same direction, takes the angular mean of the
    two ranges' centres and lengths, each range first translated to the wanted activation (equation 4). Rule 3: in
    opposite directions, the intersection of the translated ranges; where that is empty the FAP is dropped.
    Rule 4: a FAP of one alone is averaged with the neutral face, so halved whatever the angle. Rules 5 and 6: each
    profile carries its own activation and angle.

    Parameters
    ----------
    first, second : the neighbours, in either order and in the same sign convention.
    activation : of the wanted emotion, 1..7.
    angle : of the wanted emotion in degrees, on the shorter arc between the two (the wheel is a circle).

    Raises
    ------
    ParameterError
        When the activation is off the scale, the angle off the arc, the sign conventions differ, or a profile is the
        neutral face.

    Examples
    --------
    >>> fear, sad = api.archetype("fear"), api.archetype("sadness")
    >>> guilty = api.between(fear, sad, activation=4.0, angle=102.3)
    >>> {str(name): round(share, 2) for name, share in guilty.weights.items()}
    {'fear': 0.16, 'sadness': 0.84}
    """
    for name, profile in (("first profile", first), ("second profile", second)):
        if profile.neutral:
            raise ParameterError(name, "must not be empty: use scaled() to weaken an expression", profile.word)
    if first.signs is not second.signs:
        raise ParameterError("signs of the two profiles", "must be the same", (str(first.signs), str(second.signs)))
    share = position(angle, first.angle, second.angle)
    one, other = first.scaled(check_activation(activation)).ranges, second.scaled(activation).ranges
    ranges: dict[int, Range] = {}
    for number in one.keys() | other.keys():
        if number in one and number in other:
            merged = _merged(one[number], other[number], share)
            if merged is not None:
                ranges[number] = merged
        else:
            low, high = one[number] if number in one else other[number]
            ranges[number] = (low / 2.0, high / 2.0)
    weights = _weights(first, second, share)
    return Profile(
        ranges=ranges,
        activation=activation,
        angle=check_angle(angle),
        weights=weights,
        variants=_variants(first, second),
        category=next(iter(weights)) if len(weights) == 1 else None,
        signs=first.signs,
        prototypes={**first.prototypes, **second.prototypes},
    )


def _merged(one: Range, other: Range, share: float) -> Range | None:
    """Rules 2 and 3 for one FAP of both; a range centred on 0 has no direction to contradict."""
    if (one[0] + one[1]) * (other[0] + other[1]) < 0.0:
        low, high = max(one[0], other[0]), min(one[1], other[1])
        return (low, high) if low <= high else None
    # Mixing centres and lengths by the same weights is mixing the ends, both being linear in them.
    low = (1.0 - share) * one[0] + share * other[0]
    high = (1.0 - share) * one[1] + share * other[1]
    return (low, high) if low <= high else (high, low)


def _weights(first: Profile, second: Profile, share: float) -> dict[Archetype, float]:
    """Shares of the archetypes, by nearness in angle; an archetype of no share at all is left out."""
    shares: dict[Archetype, float] = {}
    for profile, part in ((first, 1.0 - share), (second, share)):
        for name, weight in profile.weights.items():
            if part * weight > 0.0:
                shares[name] = shares.get(name, 0.0) + part * weight
    return shares


def _variants(first: Profile, second: Profile) -> dict[Archetype, int]:
    """Variants of both, without an archetype on which they disagree."""
    both = {**first.variants, **second.variants}
    return {name: number for name, number in both.items() if first.variants.get(name, number) == number}
