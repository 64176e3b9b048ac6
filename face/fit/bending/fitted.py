"""The whole fit: front first, then the whole head, then lids and lips, ever softer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ....arrays import Floats, Ints
from ....progress import Progress, Work, part_of
from ..surface.margins import Expected, Margin, find_eyes, find_mouth
from ..template.template import FitTemplate, Ring
from .bend import Stage, Wishes, bend
from .ears import ear_wishes
from .target import Target

FRONT = Stage(14, (60.0, 3.0), (22e-3, 9e-3), None)
WHOLE = Stage(8, (80.0, 15.0), (12e-3, 12e-3), (45e-3, 25e-3))
CLOSER = Stage(6, (12.0, 0.8), (9e-3, 7e-3), (20e-3, 12e-3))
CLOSEST = Stage(6, (3.0, 0.15), (6e-3, 5e-3), (12e-3, 8e-3))

#: What lies in front of this belongs to the face, metres of the template, below the eyes and at the temples' height;
#: behind it the ears tell how deep the head is.
STRETCH_FROM, STRETCH_TEMPLES, TEMPLES = -75e-3, -40e-3, 50e-3


@dataclass(frozen=True, eq=False)
class Fit:
    """The template bent onto a head.

    Attributes
    ----------
    skin : (V, 3) where its skin lies, template coordinates.
    margins : "eye_l", "eye_r", "mouth": the rims that were found.
    """

    skin: Floats
    margins: Mapping[str, Margin]


def fit(
    template: FitTemplate, target: Target, wishes: Sequence[Wishes] = (), *, start: Floats | None = None
) -> Work[Fit]:
    """Bend the template onto a head.

    Parameters
    ----------
    wishes : places that points shall come to.
    start : (C, 3) displacements of the cage to begin with; None: none.
    """
    moved = np.zeros((template.skin.cage_matrix.shape[1], 3)) if start is None else start
    yield Progress(0.0, "Fitting the face")
    moved = bend(template, target, moved, FRONT, wishes)
    yield Progress(0.3, "Fitting the whole head")
    ears = ear_wishes(template, target, template.skin.vertices + template.skin.cage_matrix @ moved)
    moved = bend(template, target, _stretched(template, moved, ears), WHOLE, [*wishes, *ears])
    margins: dict[str, Margin] = {}
    for number, stage in enumerate((CLOSER, CLOSEST)):
        yield Progress(0.5 + 0.2 * number, "Fitting lids and lips")
        found = part_of(_margins(template, target, moved), 0.5 + 0.2 * number, 0.6 + 0.2 * number)
        margins = yield from found
        rims = [_rim_wishes(template, template.rings[name], margin) for name, margin in margins.items()]
        yield Progress(0.6 + 0.2 * number, "Fitting the details")
        moved = bend(template, target, moved, stage, [*wishes, *rims])
    return Fit(template.skin.vertices + template.skin.cage_matrix @ moved, margins)


def _stretched(template: FitTemplate, moved: Floats, ears: Sequence[Wishes]) -> Floats:
    """Displacements with the head's sides and back brought along as far as the ears are off.

    The face's front says little about how deep the head is; jaw angles and skull would start too near to it.
    """
    if not ears:
        return moved
    off = np.mean([(ear.offsets - ear.rows @ moved).mean(axis=0) for ear in ears], axis=0)
    _, depth, height = template.skin.vertices[: len(moved)].T
    middle = np.mean([(ear.rows @ depth[:, None]).mean() for ear in ears])
    front = np.interp(height, (0.0, TEMPLES), (STRETCH_FROM, STRETCH_TEMPLES))
    share = np.clip((depth - front) / (middle - front), 0.0, 1.0)
    return np.asarray(moved + share[:, None] * off * np.array([0.0, 1.0, 0.0]))


def _margins(template: FitTemplate, target: Target, moved: Floats) -> Work[dict[str, Margin]]:
    """The rims found where the template's lie now."""
    skin = template.skin.vertices + template.skin.cage_matrix @ moved
    expected = {name: Expected(skin[ring.margin], skin[ring.outside]) for name, ring in template.rings.items()}
    mouth = yield from part_of(find_mouth(target.surface, expected.pop("mouth")), 0.0, 0.5)
    found = yield from part_of(find_eyes(target.surface, expected), 0.5, 1.0)
    return found if mouth is None else found | {"mouth": mouth}


def _rim_wishes(template: FitTemplate, ring: Ring, margin: Margin) -> Wishes:
    """The template's rim shall come to the one found, each node at its share of the way between the corners."""
    rest = template.skin.vertices[ring.margin]
    places = np.empty_like(rest)
    for edge, chosen in _ring_edges(ring):
        places[chosen] = margin.at(edge, ring_shares(template, ring, rest[chosen]))
    return Wishes.of_nodes(template, ring.margin, places)


def ring_shares(template: FitTemplate, ring: Ring, rest: Floats) -> Floats:
    """(N,) where places (N, 3) on the template's rim lie between its right corner (0) and its left one (1)."""
    first, last = template.skin.vertices[ring.margin[[0, ring.second_corner]]]
    if first[0] > last[0]:
        first, last = last, first
    way = last - first
    return np.asarray(np.clip((rest - first) @ way / (way @ way), 0.0, 1.0), dtype=np.float64)


def _ring_edges(ring: Ring) -> tuple[tuple[str, Ints], tuple[str, Ints]]:
    """Places in a ring's margin of its upper edge, corners included, and of its lower one."""
    upper = np.arange(ring.second_corner + 1)
    lower = np.concatenate([np.arange(ring.second_corner, len(ring.margin)), [0]])
    return ("upper", upper), ("lower", lower)
