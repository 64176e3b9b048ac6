"""The paper's three muscle models: each is a force field on skin nodes at contraction 1.

linear, sphincter, sheet    the three models
windows                     how force falls off across them

They know nothing of faces: which skin a muscle may act on (upper or lower lip, one side) is for whoever places it.
"""

from __future__ import annotations

from typing import Protocol

from ...arrays import Floats
from .linear import LinearMuscle
from .sheet import SheetMuscle
from .sphincter import SphincterMuscle


class Muscle(Protocol):
    """Anything that pulls skin nodes."""

    def force(self, positions: Floats) -> Floats:
        """Force at contraction 1 on nodes at `positions` (V, 3) m: (V, 3) N."""
        ...


__all__ = ["LinearMuscle", "Muscle", "SheetMuscle", "SphincterMuscle"]
