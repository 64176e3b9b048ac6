"""What the solver needs and this Blender may lack. Asking imports nothing and knows nothing of any scene."""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.util import find_spec

from ..errors import SceneError

MISSING = "SciPy is missing"

#: How to get it, line by line, short enough for a panel.
REMEDY = (
    "Risorius computes with SciPy, which",
    "this Blender's Python does not have.",
    "Install the Risorius zip made for your",
    "system and Blender: it brings SciPy.",
    "The Blender of a Linux distribution",
    "needs the package python3-scipy.",
)


def has_scipy() -> bool:
    """Whether SciPy can be found; looks for it anew until it is there."""
    if "scipy" in sys.modules:
        return sys.modules["scipy"] is not None
    try:
        return find_spec("scipy") is not None
    except (ImportError, ValueError):
        return False


def need_scipy() -> None:
    """Refuse to go on without SciPy.

    Raises
    ------
    SceneError : SciPy is missing, or cannot be loaded; says how to get it.
    """
    if not has_scipy():
        raise SceneError(MISSING, " ".join(REMEDY))
    try:
        import_module("scipy.sparse.linalg")
    except ImportError as problem:
        raise SceneError("SciPy cannot be loaded", f"{problem}. {' '.join(REMEDY[2:])}") from problem
