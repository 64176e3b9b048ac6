"""What muscles do to the skin over a whole clip, from a few equilibria.

Along a clip the amounts of the muscles run through few directions, and the skin's equilibrium is smooth over them. So it
is solved for some of the clip's own amounts, the farthest from all others first, and interpolated for the rest by radial
functions over the amounts that reproduce whatever is linear (`scipy.interpolate.RBFInterpolator`). Each new equilibrium
is first held against what the others foretold of it; none is added any more where that agrees.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RBFInterpolator

from ...arrays import Floats, Ints
from ...progress import Progress, Work
from .actuators import Amounts
from .relaxation import Relaxation

#: Foretold equilibria are within this share of the largest displacement, or within this, metres, before sampling ends.
AGREED_SHARE, AGREED = 2e-3, 2e-5

#: Amounts that differ less than this from others, metres, are the same; directions that together take no amount farther
#: are left out.
SAME = 2e-6

#: So many amounts are tried at once, or this share of those that are sampled already.
TRIED, TRIED_SHARE = 3, 0.25

#: What is said meanwhile.
TEXT = "Solving the skin where the motion goes"


@dataclass(frozen=True, eq=False)
class SampledPull:
    """The muscles' displacements of the outer skin over a clip of T steps.

    Attributes
    ----------
    steps : (m,) which steps of the clip were solved. displacements : (m, n, 3) metres, of these.
    weights : (T, m) how every step is a sum of them; rows sum to 1.
    disagreement : metres, how far the equilibria that were tried last lay from what the others had foretold.
    """

    steps: Ints
    displacements: Floats
    weights: Floats
    disagreement: float

    def at(self, step: int) -> Floats:
        """(n, 3) displacement at a step, metres."""
        flat = self.displacements.reshape(len(self.steps), -1)
        return (self.weights[step] @ flat).reshape(self.displacements.shape[1:])


def sampled_pull(relaxation: Relaxation, clip: list[Amounts]) -> Work[SampledPull]:
    """The equilibria of a clip's amounts, one for each of its steps (1 or more).

    Raises
    ------
    SolverError : contractions beyond what the skin can bear.
    """
    places = _places(np.array([amounts.muscles for amounts in clip]))
    chosen, solved = [0], [relaxation.pulled(clip[0])]
    largest, off = 0.0, 0.0
    while True:
        count = 1 if len(chosen) <= places.shape[1] else max(TRIED, int(TRIED_SHARE * len(chosen)))
        tried = farthest(places, chosen, count)
        if not tried:
            break
        weights = _weights(places, chosen)
        off = 0.0
        for step in tried:
            yield Progress(1.0 - 1.0 / (1.0 + len(solved) / max(places.shape[1], 1)), TEXT)
            found = relaxation.pulled(clip[step])
            foretold = sum(w * field for w, field in zip(weights[step], solved, strict=False))
            off = max(off, float(np.linalg.norm(found - foretold, axis=1).max()))
            largest = max(largest, float(np.linalg.norm(found, axis=1).max()))
            solved.append(found)
        foretold_all = len(chosen) > places.shape[1]
        chosen += tried
        if foretold_all and off <= max(AGREED, AGREED_SHARE * largest):
            break
    return SampledPull(np.array(chosen), np.array(solved), _weights(places, chosen), off)


def _places(amounts: Floats) -> Floats:
    """(T, d) where the amounts (T, k) of a clip lie among each other, in as few coordinates as they need, metres."""
    about = amounts - amounts.mean(axis=0)
    _, sizes, ways = np.linalg.svd(about, full_matrices=False)
    coordinates: Floats = about @ ways.T
    left_out = np.sqrt(np.cumsum((coordinates**2)[:, ::-1], axis=1))[:, ::-1].max(axis=0)
    return coordinates[:, : int((left_out > SAME).sum())]


def farthest(places: Floats, chosen: list[int], count: int) -> list[int]:
    """At most so many steps, each the farthest from those chosen and from those before it; none that is the same."""
    away = np.min([np.linalg.norm(places - places[step], axis=1) for step in chosen], axis=0)
    found: list[int] = []
    for _ in range(count):
        step = int(away.argmax())
        if away[step] <= SAME:
            break
        found.append(step)
        away = np.minimum(away, np.linalg.norm(places - places[step], axis=1))
    return found


def _weights(places: Floats, chosen: list[int]) -> Floats:
    """(T, m) weights of the chosen steps that foretell each step; rows sum to 1."""
    known = places[chosen]
    if len(chosen) == 1:
        return np.ones((len(places), 1))
    _, sizes, ways = np.linalg.svd(known - known.mean(axis=0), full_matrices=False)
    spanned = ways[: min(len(chosen) - 1, int((sizes > SAME).sum()))]
    foretell = RBFInterpolator(known @ spanned.T, np.eye(len(chosen)), kernel="cubic", degree=1)
    return np.asarray(foretell(places @ spanned.T))
