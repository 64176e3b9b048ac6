"""What muscles do to the skin over a whole clip, from a few equilibria.

Along a clip the amounts of the muscles run through few directions, and what stiffening springs add to the low-strain
response is small and smooth over them. So the equilibrium is solved for some of the clip's own amounts, the farthest
from all others first, and what it adds is interpolated for the rest by radial functions over the amounts: powers of the
distance (Wendland 2005, Scattered data approximation, chapter 8). Each new equilibrium is sought from what the others
foretold of it, and held against that; none is added any more where it agrees.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.distance import cdist

from ...arrays import Floats, Ints
from ...errors import SolverError
from ...progress import Progress, Work
from .actuators import Amounts
from .relaxation import Relaxation

#: Foretold equilibria are within this share of the largest displacement, or within this, metres, before sampling ends.
AGREED_SHARE, AGREED = 2e-3, 2e-5

#: Amounts that differ less than this from others, metres, are the same; directions that together take no amount farther
#: are left out.
SAME = 1e-4

#: So many amounts are tried at once, or this share of those that are sampled already.
TRIED, TRIED_SHARE = 3, 0.25

#: The power of the distance that foretells. Springs that stiffen one after the other bend a field often: a cube, which
#: is smoother, and a plane through all amounts, which takes a sample for each direction, need a third more equilibria.
POWER = 1.5

#: What is said meanwhile.
TEXT = "Solving the skin where the motion goes"


@dataclass(frozen=True, eq=False)
class SampledPull:
    """The muscles' displacements of the outer skin over a clip of T steps.

    Attributes
    ----------
    low_strain : amounts (s, k) of muscles -> (s, n, 3) metres, what they do to a linear skin.
    muscles : (T, k) amounts of every step, metres.
    steps : (m,) which steps of the clip were solved. beyond : (m, n, 3) metres, what their equilibria add to that.
    weights : (T, m) how what every step adds is a sum of these; rows sum to 1.
    disagreement : metres, how far the equilibria that were tried last lay from what the others had foretold.
    """

    low_strain: Callable[[Floats], Floats]
    muscles: Floats
    steps: Ints
    beyond: Floats
    weights: Floats
    disagreement: float

    def at(self, steps: Ints | slice[int, int, None]) -> Floats:
        """(s, n, 3) displacements at some steps, metres."""
        return self.low_strain(self.muscles[steps]) + np.tensordot(self.weights[steps], self.beyond, axes=1)


def sampled_pull(relaxation: Relaxation, clip: Sequence[Amounts]) -> Work[SampledPull]:
    """The equilibria of a clip's amounts, one for each of its steps (1 or more).

    Raises
    ------
    SolverError : contractions beyond what the skin can bear; names the step.
    """

    muscles = np.array([amounts.muscles for amounts in clip])
    places = _places(muscles)
    chosen: list[int] = []
    added: list[Floats] = []
    largest = off = 0.0
    tried = [0]
    while tried:
        weights = foretelling(places, chosen)
        off = 0.0
        for step in tried:
            yield Progress(1.0 - 1.0 / (1.0 + len(added) / (1 + places.shape[1])), TEXT)
            fields = (weight * field for weight, field in zip(weights[step], added, strict=False))
            foretold = sum(fields, np.zeros_like(relaxation.skin.positions))
            try:
                # The first is found as a pose is, so that a clip which holds a face holds its pose.
                found = relaxation.added(clip[step], foretold if added else None)
            except SolverError as error:
                raise error.in_frame(step) from error
            off = max(off, float(np.linalg.norm(found - foretold, axis=1).max()))
            linear = relaxation.actuators.low_strain(clip[step])
            largest = max(largest, float(np.linalg.norm(linear, axis=1).max()))
            added.append(found)
        spanned = len(chosen) > places.shape[1]
        chosen += tried
        if spanned and off <= max(AGREED, AGREED_SHARE * largest):
            break
        more = max(TRIED, int(TRIED_SHARE * len(chosen)))
        tried = farthest(places, chosen, more if len(chosen) > places.shape[1] else 1)
    beyond = relaxation.sheet.show(np.array(added))
    low_strain, every = relaxation.actuators.low_strain_each, foretelling(places, chosen)
    return SampledPull(low_strain, muscles, np.array(chosen), beyond, every, off)


def farthest(places: Floats, chosen: Sequence[int], count: int) -> list[int]:
    """At most so many of places (T, d), each the farthest from those chosen and found before; none that is the same."""
    away = np.min([np.linalg.norm(places - places[step], axis=1) for step in chosen], axis=0)
    found: list[int] = []
    for _ in range(count):
        step = int(away.argmax())
        if away[step] <= SAME:
            break
        found.append(step)
        away = np.minimum(away, np.linalg.norm(places - places[step], axis=1))
    return found


def _places(amounts: Floats) -> Floats:
    """(T, d) where the amounts (T, k) of a clip lie among each other, in as few coordinates as they need, metres."""
    about = amounts - amounts.mean(axis=0)
    _, _, ways = np.linalg.svd(about, full_matrices=False)
    coordinates: Floats = about @ ways.T
    left_out = np.sqrt(np.cumsum((coordinates**2)[:, ::-1], axis=1))[:, ::-1].max(axis=0)
    return coordinates[:, : int((left_out > SAME).sum())]


def foretelling(places: Floats, chosen: Sequence[int]) -> Floats:
    """(T, m) weights of the chosen steps that foretell each step; rows sum to 1."""
    if len(chosen) < 2:
        return np.ones((len(places), len(chosen)))
    known, count = places[chosen], len(chosen)
    system, wanted = np.ones((count + 1, count + 1)), np.ones((count + 1, len(places)))
    system[-1, -1] = 0.0
    system[:count, :count], wanted[:count] = cdist(known, known) ** POWER, cdist(known, places) ** POWER
    return np.asarray(np.linalg.solve(system, wanted)[:count].T)
