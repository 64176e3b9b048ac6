"""Skin, muscles and dynamics: Zhang, Sung and Prakash 2001, and what production needs beyond it.

From small to large: `mesh` (topology and areas), `elastic` (the linear skin, factored once), `springs` and `tissue`,
`muscles`, `skin` (all of it as one mechanical system), and three ways to solve it: `equilibrium`, `implicit`, `rk2`.
It knows nothing of faces or of MPEG-4; lengths are metres, forces newtons.
"""

from .elastic import Factor, LaplacianForm, elastic_matrix, laplacian
from .equilibrium import EquilibriumSolver, equilibrium
from .implicit import ImplicitSolver
from .muscles import LinearMuscle, Muscle, SheetMuscle, SphincterMuscle
from .rk2 import Rk2Solver
from .skin import Skin, State
from .springs import SpringLaw, SpringNetwork, spring_tension
from .tissue import Tissue, load_tissues, tissue, tissues

__all__ = [
    "EquilibriumSolver",
    "Factor",
    "ImplicitSolver",
    "LaplacianForm",
    "LinearMuscle",
    "Muscle",
    "Rk2Solver",
    "SheetMuscle",
    "Skin",
    "SphincterMuscle",
    "SpringLaw",
    "SpringNetwork",
    "State",
    "Tissue",
    "elastic_matrix",
    "equilibrium",
    "laplacian",
    "load_tissues",
    "spring_tension",
    "tissue",
    "tissues",
]
