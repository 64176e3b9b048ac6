"""Controls that pull against each other, smile against frown, and what it costs to have both on.

What a pair costs is shared by how strong the two were before: the weaker bears most. Where one of them is off nothing
is borne by the other, so a motion goes from one to the other without a jump.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ...arrays import Floats

#: Controls are opposed where the cosine between what they do is less than minus this.
OPPOSED = 0.4
#: What both of them being on may cost the weaker, as a share of what the smaller one's whole range does.
COSTS = (0.02, 0.08, 0.32)
#: A control counts as on where it is at more than this share of its range.
ON = 0.02

#: Pairs of controls that are settled together: a pair, and its mirror image.
Pairs: TypeAlias = Sequence[tuple[int, int]]


@dataclass(frozen=True)
class Settled:
    """Pairs, and what both of one being on costs."""

    pairs: Pairs
    cost: float


def opposed_pairs(matrix: Floats, low: Floats, high: Floats, mirror: Mapping[int, int]) -> list[Pairs]:
    """The pairs that pull against each other, each with its mirror image.

    Parameters
    ----------
    matrix : (K, K) cosines. low, high : (K,) limits; a control that goes both ways from its rest opposes nothing.
    mirror : control -> its mirror image, of those that have one.
    """
    way = np.where(high > 0.0, 1.0, -1.0) * ((low >= 0.0) | (high <= 0.0))
    against = np.triu(matrix * np.outer(way, way) < -OPPOSED, 1)
    groups: dict[tuple[tuple[int, int], ...], None] = {}
    for first, second in np.argwhere(against).tolist():
        image = sorted((mirror.get(first, first), mirror.get(second, second)))
        both = {(first, second), (image[0], image[1])}
        groups[tuple(sorted(pair for pair in both if against[pair]))] = None
    return [list(group) for group in groups]


def both_on(pairs: Pairs, values: Floats, reach: Floats) -> float:
    """The most that the weaker of a pair is on at one time, as a share of its range, of values (T, K)."""
    shares = np.abs(values) / reach
    return max(float(np.minimum(shares[:, one], shares[:, other]).max(initial=0.0)) for one, other in pairs)


def against(pairs: Pairs, matrix: Floats) -> float:
    """How much pairs pull against each other, 0 to 1."""
    return max(abs(float(matrix[one, other])) for one, other in pairs)


def costs(settled: Sequence[Settled], moved: Floats, reach: Floats) -> Floats:
    """(T, K) what each control costs beside what it was before: scaled values (T, K). `reach` : (K,) scaled too."""
    cost, size = np.zeros_like(moved), np.abs(moved)
    for each in settled:
        for one, other in each.pairs:
            least = min(reach[one], reach[other])
            whole = size[:, one] + size[:, other] + ON * least
            cost[:, one] += each.cost * least * size[:, other] / whole
            cost[:, other] += each.cost * least * size[:, one] / whole
    return cost
