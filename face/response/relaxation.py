"""The skin's equilibrium under its muscles: what contractions show.

Amounts are found with the low-strain response (`sheet`); what the face then shows is the equilibrium of the spring skin
under the muscles' forces, whose springs stiffen where they are stretched beyond their threshold (Zhang, Sung, Prakash
2001, equations (1)-(5) and (23)).
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from ...arrays import Floats
from ...physics.elastic import Factor
from ...physics.equilibrium import EquilibriumSolver
from ...physics.mesh import Sparse
from ...physics.tissue import tissue
from ..mechanism import Mechanism
from ..skin.outer import OuterSkin
from .actuators import Actuators, Amounts
from .recollection import Recollection
from .sheet import ElasticSheet
from .spring_skin import spring_skin

#: The largest correction of a node that an equilibrium may leave, metres: what single precision makes of a mesh may
#: stop the search a step earlier, and should not be seen.
TOLERANCE = 1e-7

#: The same where rounding ends the search: slivers of a mesh are far stiffer than the skin round them, metres.
UNSEEN = 5e-6

#: The same for a face that is only sketched; and how far off what is foretold may be there, and in passing, metres.
SKETCHED, FORETOLD, IN_PASSING = 2e-5, 5e-5, 2e-4

#: The same for one of the balances that stand for a whole clip, metres; and by how much its corrections shrink from one
#: to the next, which they do faster as a rule.
SAMPLED, SHRINKING = 5e-6, 0.25

#: Matrices that differ by less than this share are one.
ROUNDING = 1e-12


class Relaxation:
    """Equilibria of one face's skin under its muscles."""

    def __init__(self, skin: OuterSkin, sheet: ElasticSheet, actuators: Actuators) -> None:
        self.skin, self.sheet, self.actuators = skin, sheet, actuators

    @cached_property
    def _solver(self) -> EquilibriumSolver:
        springs = spring_skin(self.skin)
        return EquilibriumSolver(springs, tolerance=TOLERANCE, unseen=UNSEEN, factor=self._factor_of(springs.matrix()))

    def _factor_of(self, matrix: Sparse) -> Factor:
        """The factor of a skin's matrix: at low strain springs are as stiff as the sheet, whose factor is known."""
        off = abs(matrix - self._membrane * self.sheet.stiffness)
        if off.max() <= ROUNDING * matrix.max():
            return self.sheet.factor.times(self._membrane)
        return Factor(matrix)

    @property
    def factor(self) -> Factor:
        """The skin's stiffness at low strain, prefactored."""
        return self._solver.factor

    @cached_property
    def _membrane(self) -> float:
        return tissue().membrane

    def balance(self, amounts: Amounts) -> Floats:
        """(n, 3) positions of the sheet in balance with the muscles' forces, before sliding and bulging.

        Raises
        ------
        SolverError : contractions beyond what the skin can bear.
        """
        return self._balance(amounts, 0.0, TOLERANCE)[0]

    def added(self, amounts: Amounts, foretold: Floats | None = None) -> Floats:
        """(n, 3) metres, what the springs add to the sheet's displacement at low strain, before sliding and bulging.

        Where something is `foretold` of it, the search begins there and ends a little short of balance.

        Raises
        ------
        SolverError : as `balance`.
        """
        if not amounts.muscles.any() or not self.skin.has(Mechanism.BIPHASIC):
            return np.zeros_like(self.skin.positions)
        if foretold is None:
            return self._balance(amounts, 0.0, TOLERANCE)[1]
        return self._balance(amounts, foretold, SAMPLED, rate=SHRINKING)[1]

    def _balance(
        self, amounts: Amounts, added: Floats | float, tolerance: float, *, rate: float | None = None
    ) -> tuple[Floats, Floats]:
        """Positions of the sheet in balance, and what springs add there, where they add about so much; (n, 3) each."""
        pulling = amounts.muscles != 0.0
        low_strain = np.tensordot(amounts.muscles[pulling], self.actuators.sheets[pulling], axes=1)
        force = self._membrane * np.asarray(self.sheet.stiffness @ low_strain)
        start = self.skin.positions + low_strain
        balanced = self._solver.solve(force, start=start + added, tolerance=tolerance, rate=rate).positions
        return balanced, balanced - start

    def pulled(self, amounts: Amounts, *, teaching: Recollection | None = None) -> Floats:
        """(n, 3) displacement of the outer skin by muscles, metres: what `Actuators.low_strain` is at low strain.

        What is found is added to a recollection, where there is one that could not have foretold it.

        Raises
        ------
        SolverError : as `balance`.
        """
        if not self._stiffens(amounts):
            return self.actuators.low_strain(amounts)
        balanced, on_sheet = self._balance(amounts, 0.0, TOLERANCE)
        found = self._shown(balanced)
        if teaching is not None and teaching.doubt(amounts.muscles) > FORETOLD:
            teaching.learn(amounts.muscles, found - self.actuators.low_strain(amounts), on_sheet)
        return found

    def recalled(self, amounts: Amounts, known: Recollection, *, trusted: float = FORETOLD) -> Floats:
        """(n, 3) as `pulled`, a little short of balance: what others foretell, where its doubt is no more than trusted.

        Else the search begins there, and what is found is added to what is known.

        Raises
        ------
        SolverError : as `balance`.
        """
        linear = self.actuators.low_strain(amounts)
        if not self._stiffens(amounts):
            return linear
        foretold, doubt = known.foretold(amounts.muscles)
        if doubt <= trusted:
            return linear + foretold
        balanced, on_sheet = self._balance(amounts, known.on_sheet(amounts.muscles), SKETCHED)
        found = self._shown(balanced)
        known.learn(amounts.muscles, found - linear, on_sheet)
        return found

    def _stiffens(self, amounts: Amounts) -> bool:
        """Whether muscles pull on springs that stiffen: else the skin answers as it does at low strain."""
        return bool(amounts.muscles.any()) and self.skin.has(Mechanism.BIPHASIC)

    def _shown(self, balanced: Floats) -> Floats:
        """(n, 3) what the face shows where its sheet is in balance at positions (n, 3)."""
        shown: Floats = self.sheet.show((balanced - self.skin.positions)[None])[0]
        return shown
