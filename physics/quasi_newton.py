"""Minimising an elastic energy with one prefactored matrix: L-BFGS whose initial Hessian is that matrix.

The matrix P bounds the true stiffness at low strain, so P^-1 times the force is already a good step (projective
dynamics takes it alone); a few remembered steps teach it what the bound misses: springs that pull along themselves
only, and springs past their threshold. The inverse of P is applied to each gradient once; the recursion's other
uses of it are sums of those. (Liu, Bouaziz, Kavan 2017, Quasi-Newton methods for real-time simulation of
hyperelastic materials, ACM Trans. Graph. 36(3).)
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from .elastic import Factor

_DECREASE = 1e-4
"""Armijo's constant."""
_HALVINGS = 30


@dataclass(frozen=True, eq=False)
class Minimum:
    """Where the minimiser stopped.

    Parameters
    ----------
    positions : (V, 3) m.
    residual : m, the largest correction of a node that is still expected; NaN where forces are beyond any number.
    iterations : solves with the matrix.
    rate : largest ratio of one correction to the one before; a guess for the next problem of the kind.
    converged : the residual is within the tolerance.
    """

    positions: Floats
    residual: float
    iterations: int
    rate: float
    converged: bool


@dataclass(frozen=True, eq=False)
class _Pair:
    """A step s, its change of gradient y, and P^-1 y."""

    s: Floats
    y: Floats
    z: Floats
    curvature: float


def minimise(
    objective: Callable[[Floats], tuple[float, Floats]],
    start: Floats,
    factor: Factor,
    *,
    tolerance: float,
    max_iterations: int,
    memory: int = 6,
    rate: float | None = None,
) -> Minimum:
    """Minimise an energy from `start`; the energy never rises from one iterate to the next.

    Parameters
    ----------
    objective : positions (V, 3) m to energy in J and its gradient (V, 3) N.
    start : (V, 3) m.
    factor : of P (V, V) N/m.
    tolerance : m, the largest correction of a node, as P^-1 times the gradient tells it, that may be left.
    max_iterations : solves with P.
    memory : remembered steps.
    rate : given, corrections are expected to shrink by it (by the largest observed ratio, once there are two), and
        the last solve is saved when what is left after a step must then lie within the tolerance.
    """
    x = np.array(start, dtype=np.float64)
    energy, gradient = objective(x)
    history: deque[_Pair] = deque(maxlen=memory)
    scaled = factor.solve(gradient)
    before = np.inf
    expected = 1.0 if rate is None else rate
    ratios: list[float] = []
    for iteration in range(1, max_iterations + 1):
        residual = _largest(scaled)
        if residual <= tolerance:
            return Minimum(x, residual, iteration, expected, True)
        step, energy, new = _descend(objective, x, energy, gradient, _direction(gradient, scaled, history))
        if step is None or new is None:
            step, energy, new = _descend(objective, x, energy, gradient, -scaled)
            history.clear()
            if step is None or new is None:
                return Minimum(x, residual, iteration, expected, False)
        x = x + step
        moved = _largest(step)
        if np.isfinite(before):
            ratios.append(moved / before)
            expected = min(max(ratios), 1.0)
        before = moved
        if rate is not None and expected < 1 and moved * expected / (1 - expected) <= tolerance:
            return Minimum(x, moved * expected / (1 - expected), iteration, expected, True)
        rescaled = factor.solve(new)
        y, z = new - gradient, rescaled - scaled
        curvature = float(np.vdot(step, y))
        if curvature > 1e-10 * float(np.vdot(y, z)) > 0:
            history.append(_Pair(step, y, z, curvature))
        gradient, scaled = new, rescaled
    residual = _largest(scaled)
    return Minimum(x, residual, max_iterations, expected, residual <= tolerance)


def _direction(gradient: Floats, scaled: Floats, history: deque[_Pair]) -> Floats:
    """Two-loop recursion from P^-1 gradient (`scaled`), with P^-1 y known for every remembered pair."""
    if not history:
        return -scaled
    q, r, weights = gradient, scaled, []
    for pair in reversed(history):
        weight = float(np.vdot(pair.s, q)) / pair.curvature
        weights.append(weight)
        q, r = q - weight * pair.y, r - weight * pair.z
    latest = history[-1]
    r = r * (latest.curvature / float(np.vdot(latest.y, latest.z)))
    for pair, weight in zip(history, reversed(weights), strict=True):
        r = r + (weight - float(np.vdot(pair.y, r)) / pair.curvature) * pair.s
    return np.asarray(-r)


def _descend(
    objective: Callable[[Floats], tuple[float, Floats]],
    x: Floats,
    energy: float,
    gradient: Floats,
    direction: Floats,
) -> tuple[Floats | None, float, Floats | None]:
    """Halve the direction until the energy falls enough: step, energy and gradient there, or None."""
    slope = float(np.vdot(gradient, direction))
    if slope >= 0:
        return None, energy, None
    rounding = 4 * np.finfo(np.float64).eps * abs(energy)
    for _ in range(_HALVINGS):
        new_energy, new_gradient = objective(x + direction)
        if new_energy <= energy + _DECREASE * slope + rounding:
            return direction, new_energy, new_gradient
        direction, slope = direction / 2, slope / 2
    return None, energy, None


def _largest(vectors: Floats) -> float:
    """The longest of the vectors (V, 3)."""
    return float(np.sqrt(np.einsum("ij,ij->i", vectors, vectors).max()))
