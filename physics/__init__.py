"""Skin, muscles and dynamics: Zhang, Sung and Prakash 2001, and what production needs beyond it.

It knows nothing of faces or of MPEG-4; lengths are metres, forces newtons. From small to large:

mesh, split                      topology and areas of polygons, and how to make them finer
elastic, springs, tissue         the linear skin, factored once; biphasic springs; the figures of skin
muscles                          the paper's three muscles
skin                             all of it as one mechanical system
equilibrium, implicit, rk2       three ways to solve it
reduced                          small motions about a moving balance, in a few fields
quasi_newton                     what the first two of them minimise with
oscillator                       how a rigid thing on springs, such as the mandible, follows
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
