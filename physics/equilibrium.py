"""The resting shape of the skin under steady forces: the minimum of elastic energy minus the work of the load."""

from __future__ import annotations

from ..arrays import Floats
from ..errors import ParameterError, SolverError
from .elastic import Factor
from .quasi_newton import Minimum, minimise
from .skin import Skin, force_at


class EquilibriumSolver:
    """Equilibria of one skin, its matrix factored once for any number of loads.

    Parameters
    ----------
    skin : the skin; every piece of it anchored.
    tolerance : m, the largest correction of a node that may be left.
    max_iterations : solves with the prefactored matrix.
    unseen : m, the same where the search ends before: slivers are so stiff that rounding hides what is left.
    factor : of `skin.matrix()`, where it is known.

    Raises
    ------
    ParameterError : a tolerance that is not above 0.
    SolverError : a piece of skin without anchor.
    """

    def __init__(
        self,
        skin: Skin,
        *,
        tolerance: float = 1e-6,
        max_iterations: int = 1000,
        unseen: float = 0.0,
        factor: Factor | None = None,
    ) -> None:
        if not tolerance > 0:
            raise ParameterError("tolerance", "must be above 0 m", tolerance)
        self.skin, self.tolerance, self.max_iterations, self.unseen = skin, tolerance, max_iterations, unseen
        self.factor = Factor(skin.matrix()) if factor is None else factor

    def solve(
        self,
        force: Floats,
        *,
        anchors: Floats | None = None,
        start: Floats | None = None,
        tolerance: float | None = None,
        rate: float | None = None,
    ) -> Minimum:
        """Positions where elastic forces balance the load.

        Parameters
        ----------
        force : (V, 3) N, a dead load: it does not turn with the skin.
        anchors : (V, 3) m, places on the bone; the rest positions if left out.
        start : (V, 3) m, a nearby shape; the anchors if left out.
        tolerance : m, another one than the solver's own.
        rate : by which corrections are expected to shrink, as for `minimise`: it saves the last solve.

        Returns
        -------
        `Minimum` with positions (V, 3) m, residual in m and iterations.

        Raises
        ------
        ParameterError : a load of the wrong shape or not finite.
        SolverError : tolerance not reached; carries the residual in m.
        """
        held = self.skin.rest if anchors is None else anchors
        allowed = self.tolerance if tolerance is None else tolerance
        load = force_at(force, held)

        def objective(positions: Floats) -> tuple[float, Floats]:
            energy, elastic = self.skin.energy_and_force(positions, held)
            # The work counts from the anchors: a head far from the origin keeps its digits.
            return energy - float((load * (positions - held)).sum()), -(elastic + load)

        found = minimise(
            objective,
            held if start is None else start,
            self.factor,
            tolerance=allowed,
            max_iterations=self.max_iterations,
            rate=rate,
        )
        if not found.converged and not found.residual <= self.unseen:  # a residual may be NaN
            raise SolverError(
                f"no equilibrium within {allowed:g} m after {found.iterations} iterations; "
                "lower the forces or allow more iterations",
                residual=found.residual,
            )
        return found


def equilibrium(
    skin: Skin,
    force: Floats,
    *,
    anchors: Floats | None = None,
    start: Floats | None = None,
    tolerance: float = 1e-6,
    max_iterations: int = 1000,
) -> Floats:
    """Equilibrium positions (V, 3) m of a skin under one load; see `EquilibriumSolver`, which is for many."""
    solver = EquilibriumSolver(skin, tolerance=tolerance, max_iterations=max_iterations)
    return solver.solve(force, anchors=anchors, start=start).positions
