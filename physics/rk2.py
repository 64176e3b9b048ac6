"""The paper's integrator: second-order Runge-Kutta (midpoint), with a step that the stiffest mode allows.

Equation (23), its signs as in `docs/physics.md`: a = (f_muscle + f_elastic - c v)/m.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.sparse.linalg import LinearOperator, eigsh

from ..arrays import Floats
from ..errors import ParameterError, SolverError
from .skin import Force, Skin, State, force_at

_SAFETY = 0.9
"""Part of the largest stable step that is taken."""
_UNDAMPED = 0.1
"""Step times frequency without any damping, where midpoint grows a mode by (omega h)^4 / 8, 1e-5, a step."""
_MARGIN = 1.01
"""Lanczos finds the highest frequency from below, to a thousandth."""


def highest_frequency(skin: Skin) -> float:
    """Angular frequency in rad/s that no mode of the skin exceeds, at any strain."""
    matrix, root = skin.matrix(high=True), 1 / np.sqrt(skin.mass)
    count = len(root)
    if count < 20:
        scaled = root[:, None] * matrix.toarray() * root
        return math.sqrt(max(float(np.linalg.eigvalsh(scaled)[-1]), 0.0)) * _MARGIN

    def scale(vector: Floats) -> Floats:
        return np.asarray(root * (matrix @ (root * vector.ravel())))

    operator = LinearOperator((count, count), matvec=scale, dtype=np.float64)
    begin = np.random.default_rng(0).normal(size=count)
    (largest,) = eigsh(operator, k=1, which="LA", tol=1e-3, v0=begin, return_eigenvectors=False)
    return math.sqrt(max(float(largest), 0.0)) * _MARGIN


def stable_step(frequency: float, damping: tuple[float, float]) -> float:
    """The longest step in s, with a margin, at which midpoint amplifies no mode.

    Parameters
    ----------
    frequency : rad/s, of the stiffest mode.
    damping : least and greatest c / m of the nodes, 1/s.
    """
    least, most = damping
    longest = 2 / max(most, frequency, 1e-300)
    if frequency == 0:
        return _SAFETY * longest
    if least <= 0:
        return min(_UNDAMPED / frequency, _SAFETY * longest)
    root = complex(-least / 2, math.sqrt(max(frequency**2 - least**2 / 4, 0.0)))
    low, high = 0.0, longest
    for _ in range(60):
        middle = (low + high) / 2
        z = middle * root
        low, high = (middle, high) if abs(1 + z + z * z / 2) <= 1 else (low, middle)
    return _SAFETY * low


class Rk2Solver:
    """Midpoint steps through a time step, as many as stability asks for.

    Parameters
    ----------
    skin : the skin.
    step : s, one step; a frame.
    substeps : how many midpoint steps each is cut into; None chooses the fewest that are stable.
    substep_limit : more than this many are refused.

    Raises
    ------
    ParameterError : a step that is not above 0, or fewer than one substep.
    SolverError : the skin is too stiff for the limit, or for the substeps asked for.
    """

    def __init__(self, skin: Skin, step: float, *, substeps: int | None = None, substep_limit: int = 2000) -> None:
        if not (np.isfinite(step) and step > 0):
            raise ParameterError("step", "must be finite and above 0 s", step)
        if substeps is not None and substeps < 1:
            raise ParameterError("substeps", "must be 1 or more", substeps)
        rate = skin.damping / skin.mass
        longest = stable_step(highest_frequency(skin), (float(rate.min()), float(rate.max())))
        needed = math.ceil(step / longest)
        if needed > substep_limit:
            raise SolverError(
                f"second-order Runge-Kutta needs {needed} substeps in {step:g} s, more than the limit of "
                f"{substep_limit}; use the implicit integrator, a coarser mesh, or a tissue without bending"
            )
        if substeps is not None and substeps < needed:
            raise SolverError(f"{substeps} substeps in {step:g} s are unstable; use at least {needed}")
        self.skin, self.length, self.substeps = skin, step, substeps or needed

    def step(self, state: State, force: Force | None = None, anchors: Floats | None = None) -> State:
        """One step on.

        Parameters
        ----------
        state : positions (V, 3) m and velocities (V, 3) m/s.
        force : (V, 3) N over the step, or a function of the positions, as in equation (23).
        anchors : (V, 3) m, places on the bone over the step; the rest positions if left out.

        Raises
        ------
        ParameterError : a load of the wrong shape or not finite.
        SolverError : the motion ran away (forces beyond what the step can bear).
        """
        h = self.length / self.substeps
        x, v = state.positions, state.velocities
        for _ in range(self.substeps):
            half = h / 2
            x_mid, v_mid = x + half * v, v + half * self._acceleration(x, v, force, anchors)
            x, v = x + h * v_mid, v + h * self._acceleration(x_mid, v_mid, force, anchors)
        if not np.isfinite(x).all():
            raise SolverError("second-order Runge-Kutta diverged; use the implicit integrator or lower the forces")
        return State(x, v)

    def _acceleration(self, x: Floats, v: Floats, force: Force | None, anchors: Floats | None) -> Floats:
        """Equation (23) for every node, (V, 3) m/s^2."""
        total = self.skin.force(x, anchors) + force_at(force, x) - self.skin.damping[:, None] * v
        return np.asarray(total / self.skin.mass[:, None])
