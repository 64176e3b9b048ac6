"""Muscles of the table placed on one face: their places carried over from the template."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..mesh.template import TemplateWarp
from .row import MuscleRow


@dataclass(frozen=True, eq=False)
class PlacedMuscle:
    """One muscle, or half of a midline one, on one face.

    Attributes
    ----------
    name : row name with "_l" or "_r" for the subject's left and right.
    row : its row in the table, with its places and directions on this side of this face (head space).
    """

    name: str
    row: MuscleRow

    @property
    def side(self) -> int:
        """+1 left, -1 right."""
        return self.row.side

    @property
    def amplitude(self) -> float:
        """Largest skin displacement at contraction 1, metres of head space."""
        return self.row.amplitude


def place_muscles(rows: Mapping[str, MuscleRow], warp: TemplateWarp) -> list[PlacedMuscle]:
    """Every muscle of the table on both sides of one face."""
    sides = ((1, "l"), (-1, "r"))
    return [
        PlacedMuscle(f"{row.name}_{letter}", row.placed(side, warp)) for row in rows.values() for side, letter in sides
    ]
