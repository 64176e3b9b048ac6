"""What each muscle does to one face's skin: how the sheet answers its force, and what of that shows."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...physics.elastic import diagonal_matrix
from ...progress import Progress, Work, part_of, run, worked_out
from ..muscles.insertion import force_density
from ..muscles.placement import PlacedMuscle
from ..skin.fine import SUMMED, fine_skin
from ..skin.outer import OuterSkin
from .sheet import ElasticSheet, blocks


@dataclass(frozen=True, eq=False)
class Pulls:
    """Muscles and their fields on the outer skin, per metre of amount.

    Attributes
    ----------
    muscles : those k that move the skin at all.
    sheets, fields : (k, n, 3) displacement of the elastic sheet, and of what the face shows, whose largest is 1.
    """

    muscles: Sequence[PlacedMuscle]
    sheets: Floats
    fields: Floats

    def of(self, names: Collection[str]) -> Pulls:
        """Those of some muscles alone."""
        kept = np.array([muscle.name in names for muscle in self.muscles], dtype=bool)
        muscles = [muscle for muscle, keep in zip(self.muscles, kept, strict=True) if keep]
        return Pulls(muscles, self.sheets[kept], self.fields[kept])


def pulls_of(skin: OuterSkin, sheet: ElasticSheet, muscles: Sequence[PlacedMuscle]) -> Pulls:
    """What muscles do to a skin."""
    return run(pulls_steps(skin, sheet, muscles))


def pulls_steps(skin: OuterSkin, sheet: ElasticSheet, muscles: Sequence[PlacedMuscle]) -> Work[Pulls]:
    """As `pulls_of`, bit by bit."""
    forces = yield from part_of(_forces(skin, muscles), 0.0, 0.5)
    yield Progress(0.5, "Computing what each muscle does")
    yield from worked_out(sheet, "hood")
    sheets, shown = np.empty_like(forces), np.empty_like(forces)
    for some in blocks(len(forces)):
        yield Progress(0.5 + 0.5 * some.start / len(forces), "Computing what each muscle does")
        sheets[some] = sheet.relax(forces[some])
        shown[some] = sheet.show(sheets[some])
    peak = np.linalg.norm(shown, axis=2).max(axis=1)
    alive = peak > 0.0
    scale = (1.0 / peak[alive])[:, None, None]
    return Pulls(
        muscles=[muscle for muscle, moves in zip(muscles, alive, strict=True) if moves],
        sheets=np.ascontiguousarray(sheets[alive] * scale),
        fields=np.ascontiguousarray(shown[alive] * scale),
    )


def _forces(skin: OuterSkin, muscles: Sequence[PlacedMuscle]) -> Work[Floats]:
    """(k, n, 3) force of each muscle on each vertex, summed over the skin between them."""
    fine, carry = fine_skin(skin, SUMMED)
    yield Progress(0.0, "Computing what each muscle does")
    yield from part_of(worked_out(fine, "normals"), 0.0, 0.5)
    yield Progress(0.5, "Computing what each muscle does")
    yield from worked_out(fine, "graph")
    spread = (diagonal_matrix(fine.areas) @ carry).T.tocsr()
    forces = []
    for number, muscle in enumerate(muscles):
        yield Progress(0.5 + 0.5 * number / len(muscles), "Computing what each muscle does")
        forces.append(np.asarray(spread @ force_density(fine, muscle)))
    return np.array(forces).reshape(-1, skin.vertex_count, 3)
