"""The production integrator: two backward-Euler stages a step, each a minimisation with one prefactored matrix.

With a = (f - c v + elastic)/m and v' = (x' - x)/h, the end x' of a stage of length h from (x, v) minimises

    1/2 sum w |x' - y|^2 + E(x') - f . x',     w = (m + c h)/h^2,     y = x + h m v/(m + c h).

Backward Euler alone is stable at any step but drains a swing that takes a few frames: loose flesh would not overshoot.
Two stages of length (1 - 1/sqrt 2) of the step, the second from where the first one's velocity and acceleration lead,
are second-order accurate, and still stable at any step and strongly damped where the step is too long to tell
(R. Alexander: Diagonally implicit Runge-Kutta methods for stiff O.D.E.'s, SIAM J. Numer. Anal. 14, 1977).
"""

from __future__ import annotations

import math

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError, SolverError
from .elastic import Factor, diagonal_matrix
from .quasi_newton import Minimum, minimise
from .skin import Force, Skin, State, force_at

_TOLERANCE_RATE = 2.5e-4
"""m/s: the default tolerance, 0.01 mm at 25 steps a second; shorter steps add up, so each must be the better."""
_RATES = 0.2, 0.95
"""Corrections are never expected to shrink faster or slower than this."""
_STAGE = 1 - 1 / math.sqrt(2)
"""Length of a stage in steps: the smaller root of g^2 - 2 g + 1/2, which makes two stages of second order."""


class ImplicitSolver:
    """Two-stage implicit Runge-Kutta with a fixed step, reused frame after frame.

    Parameters
    ----------
    skin : the skin.
    step : s, one step; a frame, or a fraction of one.
    tolerance : m, the largest correction of a node left in a step, shared out to its stages; 0.01 mm at 25 steps a
        second if left out, and in proportion to the step otherwise.
    max_iterations : solves with the prefactored matrix per step.

    Raises
    ------
    ParameterError : a step or tolerance that is not above 0.
    """

    def __init__(self, skin: Skin, step: float, *, tolerance: float | None = None, max_iterations: int = 200) -> None:
        tolerance = _TOLERANCE_RATE * step if tolerance is None else tolerance
        for name, value in (("step", step), ("tolerance", tolerance)):
            if not (np.isfinite(value) and value > 0):
                raise ParameterError(name, "must be finite and above 0", value)
        self.skin, self.length, self.tolerance, self.max_iterations = skin, step, tolerance, max_iterations
        self._stage = _STAGE * step
        self.inertia = skin.mass / self._stage**2 + skin.damping / self._stage
        self._share = (skin.mass / (skin.mass + skin.damping * self._stage))[:, None]
        self._factor = Factor(skin.matrix() + diagonal_matrix(self.inertia))
        self._rate = 0.5
        self.last: Minimum | None = None
        """How the last stage's minimisation went: iterations and residual."""

    def step(self, state: State, force: Force | None = None, anchors: Floats | None = None) -> State:
        """One step on.

        Parameters
        ----------
        state : positions (V, 3) m and velocities (V, 3) m/s.
        force : (V, 3) N over the step, or a function of the positions, taken at the step's beginning.
        anchors : (V, 3) m, places on the bone over the step; the rest positions if left out.

        Raises
        ------
        ParameterError : a load of the wrong shape or not finite.
        SolverError : tolerance not reached; carries the residual in m.
        """
        load = force_at(force, state.positions)
        first = self._advance(state, load, anchors)
        rest = self.length - self._stage
        acceleration = (first.velocities - state.velocities) / self._stage
        between = State(state.positions + rest * first.velocities, state.velocities + rest * acceleration)
        return self._advance(between, load, anchors)

    def _advance(self, state: State, load: Floats, anchors: Floats | None) -> State:
        """One backward-Euler stage."""
        coast = state.positions + self._stage * self._share * state.velocities
        inertia = self.inertia[:, None]

        def objective(positions: Floats) -> tuple[float, Floats]:
            energy, elastic = self.skin.energy_and_force(positions, anchors)
            moved = positions - coast
            pull = inertia * moved
            energy += float((moved * (0.5 * pull - load)).sum())
            return energy, pull - elastic - load

        found = minimise(
            objective,
            state.positions + self._stage * state.velocities,
            self._factor,
            tolerance=_STAGE * self.tolerance,
            max_iterations=self.max_iterations,
            rate=self._rate,
        )
        self.last = found
        if not found.converged:
            raise SolverError(
                f"a step of {self.length:g} s was not solved within {self.tolerance:g} m; take shorter steps or lower "
                "the forces",
                residual=found.residual,
            )
        self._rate = float(np.clip(found.rate, *_RATES))
        return State(found.positions, (found.positions - state.positions) / self._stage)
