"""The outer skin as the paper has it: biphasic springs with mass and damping, here with bending and ties to the bone.

Contractions are found with the springs' low-strain response (`tissue.py`); what the face then shows is the equilibrium
of this skin under the muscles' forces, whose springs stiffen where they are stretched beyond their threshold
(Zhang, Sung, Prakash 2001, equations (1)-(5) and (23)).
"""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from ..arrays import Floats
from ..physics.equilibrium import EquilibriumSolver
from ..physics.skin import Skin
from ..physics.tissue import tissue as tissue_of
from . import regions
from .actuators import Actuators, Amounts
from .mechanisms import Mechanism
from .outer_skin import OuterSkin
from .tissue import Tissue

#: The largest correction of a node that an equilibrium may leave, metres.
TOLERANCE = 2e-5


def living_skin(sheet: OuterSkin, tissue: str = "default") -> Skin:
    """The skin of a face, of a tissue named in presets/tissue.toml, held as its regions are.

    Raises
    ------
    ParameterError : an unknown tissue.
    """
    figures = tissue_of(tissue)
    return Skin.from_mesh(
        sheet.positions,
        sheet.polygons,
        figures if sheet.has(Mechanism.BIPHASIC) else replace(figures, stiffening=1.0),
        anchor=regions.anchor(sheet),
        bending=regions.bending(sheet),
    )


class Relaxation:
    """Equilibria of one face's skin under its muscles."""

    def __init__(self, sheet: OuterSkin, tissue: Tissue, actuators: Actuators) -> None:
        self.sheet, self.tissue, self.actuators = sheet, tissue, actuators

    @cached_property
    def _solver(self) -> EquilibriumSolver:
        return EquilibriumSolver(living_skin(self.sheet), tolerance=TOLERANCE)

    @cached_property
    def _membrane(self) -> float:
        return tissue_of().membrane

    def settle(self, amounts: Amounts) -> Floats:
        """(n, 3) positions of the sheet in balance with the muscles' forces, before sliding and bulging.

        Raises
        ------
        SolverError : contractions beyond what the skin can bear.
        """
        low_strain = np.tensordot(amounts.muscles, self.actuators.sheets, axes=1)
        force = self._membrane * np.asarray(self.tissue.stiffness @ low_strain)
        return self._solver.solve(force, start=self.sheet.positions + low_strain).positions

    def muscular(self, amounts: Amounts) -> Floats:
        """(n, 3) displacement of the outer skin by muscles, metres: what `Actuators.muscular` is at low strain.

        Raises
        ------
        SolverError : as `settle`.
        """
        if not amounts.muscles.any():
            return np.zeros_like(self.sheet.positions)
        if not self.sheet.has(Mechanism.BIPHASIC):
            return self.actuators.muscular(amounts)
        shown: Floats = self.tissue.show((self.settle(amounts) - self.sheet.positions)[None])[0]
        return shown
