"""The outer skin as the paper has it: biphasic springs with mass and damping, here with bending and ties to the bone.

Contractions are found with the springs' low-strain response (`tissue.py`); what the face then shows is the equilibrium
of this skin under the muscles' forces, whose springs stiffen where they are stretched beyond their threshold
(Zhang, Sung, Prakash 2001, equations (1)-(5) and (23)).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...arrays import Floats
from ...physics.equilibrium import EquilibriumSolver
from ...physics.oscillator import Oscillator
from ...physics.skin import Skin
from ...physics.tissue import Tissue as Figures
from ...physics.tissue import as_tissue
from ...physics.tissue import tissue as tissue_of
from ..figures import Length, Place, read_figures
from ..mechanism import Mechanism
from ..skin.outer import OuterSkin, gaussian
from . import regions
from .actuators import Actuators, Amounts
from .sheet import Tissue

#: The largest correction of a node that an equilibrium may leave, metres: what single precision makes of a mesh may
#: stop the search a step earlier, and should not be seen.
TOLERANCE = 1e-7

#: The same for a face that is only sketched, metres.
SKETCHED = 5e-5


@dataclass(frozen=True)
class LooseFigures:
    """Where deep soft tissue hangs loose (presets/anatomy/skin.toml)."""

    radius: Length
    jowl_from_corner: Place


LOOSE = read_figures("skin.loose", LooseFigures)


def looseness(sheet: OuterSkin) -> Floats:
    """(n,) 1 where deep soft tissue hangs loose, over cheek and jowl; 0 where skin lies close on bone.

    Between the cheekbone and the mandible's edge, before the ear: about feature points 5.1 and 5.2, and down to the
    edge of the jaw beside the chin.
    """
    points, loose = sheet.points, np.zeros(sheet.vertex_count)
    for cheek, corner in (("5.1", "8.3"), ("5.2", "8.4")):
        jowl = points[corner] + LOOSE.jowl_from_corner * np.array([np.sign(points[corner][0]), 1.0, 1.0])
        for centre in (points[cheek], jowl):
            loose = np.maximum(loose, gaussian(sheet.positions, centre, LOOSE.radius))
    return loose


def living_skin(sheet: OuterSkin, tissue: str | Figures = "default") -> Skin:
    """The skin of a face, of a tissue of its own or one named in presets/tissue.toml, held as its regions are.

    Where it hangs loose more tissue moves with it and is less damped.

    Raises
    ------
    ParameterError : an unknown tissue.
    """
    figures, loose, anchor = as_tissue(tissue), looseness(sheet), regions.anchor(sheet)
    depth = figures.depth + (figures.loose_depth - figures.depth) * loose
    ratio = figures.damping_ratio + (figures.loose_damping_ratio - figures.damping_ratio) * loose
    return Skin.from_mesh(
        sheet.positions,
        sheet.polygons,
        figures if sheet.has(Mechanism.BIPHASIC) else replace(figures, stiffening=1.0),
        anchor=anchor,
        bending=regions.bending(sheet),
        depth=depth,
        damping=2.0 * ratio * np.sqrt(figures.membrane * anchor / (figures.density * depth)),
    )


def mandible(tissue: str | Figures = "default") -> Oscillator:
    """How the mandible of a face follows what is asked of it.

    Raises
    ------
    ParameterError : an unknown tissue.
    """
    figures = as_tissue(tissue)
    return Oscillator(figures.jaw_frequency, figures.jaw_damping_ratio)


@dataclass
class Memory:
    """The balance found last: what its springs' stiffening added to the low-strain response, (n, 3) metres."""

    beyond: Floats | float = 0.0


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

    def settle(self, amounts: Amounts, *, memory: Memory | None = None) -> Floats:
        """(n, 3) positions of the sheet in balance with the muscles' forces, before sliding and bulging.

        With a memory, it begins at the balance found last and stops a little short of the new one.

        Raises
        ------
        SolverError : contractions beyond what the skin can bear.
        """
        low_strain = np.tensordot(amounts.muscles, self.actuators.sheets, axes=1)
        force = self._membrane * np.asarray(self.tissue.stiffness @ low_strain)
        start = self.sheet.positions + low_strain
        if memory is None:
            return self._solver.solve(force, start=start).positions
        settled = self._solver.solve(force, start=start + memory.beyond, tolerance=SKETCHED).positions
        memory.beyond = settled - start
        return settled

    def muscular(self, amounts: Amounts, *, memory: Memory | None = None) -> Floats:
        """(n, 3) displacement of the outer skin by muscles, metres: what `Actuators.muscular` is at low strain.

        Raises
        ------
        SolverError : as `settle`.
        """
        if not amounts.muscles.any():
            return np.zeros_like(self.sheet.positions)
        if not self.sheet.has(Mechanism.BIPHASIC):
            return self.actuators.muscular(amounts)
        shown: Floats = self.tissue.show((self.settle(amounts, memory=memory) - self.sheet.positions)[None])[0]
        return shown
