"""The production integrator: backward Euler, each step a minimisation with one prefactored matrix.

With a = (f - c v + elastic)/m and v' = (x' - x)/h, the step's end x' minimises

    1/2 sum w |x' - y|^2 + E(x') - f . x',     w = (m + c h)/h^2,     y = x + h m v/(m + c h):

stable at any step, and free of forces it never gains energy. First-order accurate: halve the step to halve the error.
"""

from __future__ import annotations

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


class ImplicitSolver:
    """Backward Euler with a fixed step, reused frame after frame.

    Parameters
    ----------
    skin : the skin.
    step : s, one step; a frame, or a fraction of one.
    tolerance : m, the largest correction of a node left in a step; 0.01 mm at 25 steps a second if left out, and in
        proportion to the step otherwise.
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
        self.inertia = skin.mass / step**2 + skin.damping / step
        self._share = (skin.mass / (skin.mass + skin.damping * step))[:, None]
        self._factor = Factor(skin.matrix() + diagonal_matrix(self.inertia))
        self._rate = 0.5
        self.last: Minimum | None = None
        """How the last step's minimisation went: iterations and residual."""

    def step(self, state: State, force: Force | None = None, anchors: Floats | None = None) -> State:
        """One step on.

        Parameters
        ----------
        state : positions (V, 3) m and velocities (V, 3) m/s.
        force : (V, 3) N over the step, or a function of the positions, taken at the step's beginning.
        anchors : (V, 3) m, places on the bone at the step's end; the rest positions if left out.

        Raises
        ------
        ParameterError : a load of the wrong shape or not finite.
        SolverError : tolerance not reached; carries the residual in m.
        """
        load = force_at(force, state.positions)
        coast = state.positions + self.length * self._share * state.velocities
        inertia = self.inertia[:, None]

        def objective(positions: Floats) -> tuple[float, Floats]:
            energy, elastic = self.skin.energy_and_force(positions, anchors)
            moved = positions - coast
            pull = inertia * moved
            energy += float((moved * (0.5 * pull - load)).sum())
            return energy, pull - elastic - load

        found = minimise(
            objective,
            state.positions + self.length * state.velocities,
            self._factor,
            tolerance=self.tolerance,
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
        return State(found.positions, (found.positions - state.positions) / self.length)
