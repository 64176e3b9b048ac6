"""Muscles of the table placed on one face: their lines and centres carried over from the template."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...errors import ModelError
from ..mesh.template import TemplateWarp
from .table import MuscleRow

MIRROR = np.array([-1.0, 1.0, 1.0])


@dataclass(frozen=True)
class PlacedMuscle:
    """One muscle, or half of a midline one, on one face.

    Attributes
    ----------
    name : row name with "_l" or "_r" for the subject's left and right.
    row : its row in the table.
    side : +1 left, -1 right.
    attachment, insertion : (3,) or (2, 3) in head space, or None; `centre` (3,) for the kinds that have one.
    amplitude : largest skin displacement at contraction 1, metres of head space.
    """

    name: str
    row: MuscleRow
    side: int
    attachment: Floats | None
    insertion: Floats | None
    centre: Floats | None
    amplitude: float

    @property
    def line(self) -> tuple[Floats, Floats]:
        """Attachment and insertion of a linear or a sheet muscle."""
        return self._given(self.attachment, "attachment"), self._given(self.insertion, "insertion")

    @property
    def middle(self) -> Floats:
        """(3,) centre of a kind that has one."""
        return self._given(self.centre, "centre")

    @property
    def pull(self) -> Floats:
        """(3,) fixed line of pull on the muscle's own side."""
        direction = self._given(self.row.direction, "direction")
        return direction if self.side > 0 else direction * MIRROR

    def elliptic_radius(self, positions: Floats) -> tuple[Floats, Floats]:
        """Of positions (n, 3): elliptic radius (n,) in the frontal plane, and depth from the centre.

        Both in units of the muscle's radii; depth in 1.2 times the larger of them.
        """
        away = positions - self.middle
        wide, high = self.row.radii
        radius = np.hypot(away[:, 0] / wide, away[:, 1] / high)
        depth = away[:, 2] / (1.2 * max(wide, high))
        return radius, depth

    def _given(self, value: Floats | None, what: str) -> Floats:
        """A figure that the muscle's kind needs."""
        if value is None:
            raise ModelError(f"muscle {self.name} is of the kind {self.row.kind} and has no {what}: add it to its row")
        return value


def place_muscles(rows: dict[str, MuscleRow], warp: TemplateWarp) -> list[PlacedMuscle]:
    """Every muscle of the table on both sides of one face."""
    placed = []
    for row in rows.values():
        for side, suffix in ((1, "l"), (-1, "r")):
            turn = MIRROR if side < 0 else np.ones(3)

            def carry(place: Floats | None, turn: Floats = turn) -> Floats | None:
                return None if place is None else warp(place * turn)

            placed.append(
                PlacedMuscle(
                    name=f"{row.name}_{suffix}",
                    row=row,
                    side=side,
                    attachment=carry(row.attachment),
                    insertion=carry(row.insertion),
                    centre=carry(row.centre),
                    amplitude=row.amplitude,
                )
            )
    return placed
