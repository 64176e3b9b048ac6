"""The skin's equilibrium under its muscles: what contractions show.

Amounts are found with the low-strain response (`sheet`); what the face then shows is the equilibrium of the spring skin
under the muscles' forces, whose springs stiffen where they are stretched beyond their threshold (Zhang, Sung, Prakash
2001, equations (1)-(5) and (23)).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import Floats
from ...physics.equilibrium import EquilibriumSolver
from ...physics.tissue import tissue
from ..mechanism import Mechanism
from ..skin.outer import OuterSkin
from .actuators import Actuators, Amounts
from .sheet import ElasticSheet
from .spring_skin import spring_skin

#: The largest correction of a node that an equilibrium may leave, metres: what single precision makes of a mesh may
#: stop the search a step earlier, and should not be seen.
TOLERANCE = 1e-7

#: The same where rounding ends the search: slivers of a mesh are far stiffer than the skin round them, metres.
UNSEEN = 5e-6

#: The same for a face that is only sketched, metres.
SKETCHED = 5e-5


@dataclass(eq=False)
class Memory:
    """The balance found last: what its springs' stiffening added to the low-strain response, (n, 3) metres."""

    beyond: Floats | float = 0.0


class Relaxation:
    """Equilibria of one face's skin under its muscles."""

    def __init__(self, skin: OuterSkin, sheet: ElasticSheet, actuators: Actuators) -> None:
        self.skin, self.sheet, self.actuators = skin, sheet, actuators

    @cached_property
    def _solver(self) -> EquilibriumSolver:
        return EquilibriumSolver(spring_skin(self.skin), tolerance=TOLERANCE, unseen=UNSEEN)

    @cached_property
    def _membrane(self) -> float:
        return tissue().membrane

    def balance(self, amounts: Amounts, *, memory: Memory | None = None) -> Floats:
        """(n, 3) positions of the sheet in balance with the muscles' forces, before sliding and bulging.

        With a memory, it begins at the balance found last and stops a little short of the new one.

        Raises
        ------
        SolverError : contractions beyond what the skin can bear.
        """
        low_strain = np.tensordot(amounts.muscles, self.actuators.sheets, axes=1)
        force = self._membrane * np.asarray(self.sheet.stiffness @ low_strain)
        start = self.skin.positions + low_strain
        if memory is None:
            return self._solver.solve(force, start=start).positions
        balanced = self._solver.solve(force, start=start + memory.beyond, tolerance=SKETCHED).positions
        memory.beyond = balanced - start
        return balanced

    def pulled(self, amounts: Amounts, *, memory: Memory | None = None) -> Floats:
        """(n, 3) displacement of the outer skin by muscles, metres: what `Actuators.low_strain` is at low strain.

        Raises
        ------
        SolverError : as `balance`.
        """
        if not amounts.muscles.any():
            return np.zeros_like(self.skin.positions)
        if not self.skin.has(Mechanism.BIPHASIC):
            return self.actuators.low_strain(amounts)
        shown: Floats = self.sheet.show((self.balance(amounts, memory=memory) - self.skin.positions)[None])[0]
        return shown
