"""FAP rows: which point of the face each FAP reads, along which direction, in which unit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse

from ...arrays import Bools, Floats, Ints
from ...mpeg4 import FAPS
from ...physics.mesh import Sparse
from .fap_units import Fapu, unit_length
from .head_frame import HeadFrame
from .points import FeaturePoints

#: Middles of the inner and outer lips; FAPs move them up, down and forward only.
LIP_MIDDLES = ("2.2", "2.3", "8.1", "8.2")


@dataclass(frozen=True, eq=False)
class FapRows:
    """The displacement FAPs that a face's points can show.

    Attributes
    ----------
    numbers : (m,) FAP numbers, ascending; last, as 0, the sideways motion of the lips' middles, which no FAP names.
    names : the feature point of each.
    directions : (m, 3) unit vectors in head space, along which a positive value moves the point.
    units : (m,) metres of head space per FAP unit.
    """

    numbers: Ints
    names: Sequence[str]
    directions: Floats
    units: Floats

    def __len__(self) -> int:
        return len(self.numbers)

    @cached_property
    def row_of(self) -> dict[int, int]:
        """FAP number -> row."""
        return {int(number): row for row, number in enumerate(self.numbers) if number}

    @cached_property
    def unnamed(self) -> Bools:
        """(m,) rows that no FAP names."""
        return np.asarray(self.numbers == 0)

    def select(self, faps: Floats) -> Floats:
        """(m,) the rows' displacements in metres asked for by FAPs (68,) in FAP units; NaN where silent."""
        return np.where(self.numbers > 0, faps[self.numbers - 1], np.nan) * self.units

    def with_lip_middles(self) -> FapRows:
        """These rows and a sideways row for every lip middle among their points."""
        names = [name for name in LIP_MIDDLES if name in self.names]
        return FapRows(
            numbers=np.concatenate([self.numbers, np.zeros(len(names), dtype=np.int64)]),
            names=(*self.names, *names),
            directions=np.concatenate([self.directions, np.tile([1.0, 0.0, 0.0], (len(names), 1))]),
            units=np.concatenate([self.units, np.ones(len(names))]),
        )

    def matrix(self, reader: Sparse) -> Sparse:
        """(m, 3n) matrix reading the rows off flattened displacements, from a (m, n) point reader."""
        read = sparse.coo_array(reader)
        values = read.data[:, None] * self.directions[read.row]
        columns = 3 * read.col[:, None] + np.arange(3)
        entries = (values.ravel(), (np.repeat(read.row, 3), columns.ravel()))
        return sparse.csr_array(entries, shape=(len(self), 3 * reader.shape[1]))


def displacement_rows(points: FeaturePoints, units: Fapu, head_frame: HeadFrame) -> FapRows:
    """The rows of every displacement FAP whose feature point is bound to the mesh; eyeballs and head have none."""
    numbers, names, directions, lengths = [], [], [], []
    for number, fap in FAPS.items():
        direction = fap.motion.direction if fap.motion is not None else None
        name = fap.feature_point
        if direction is None or fap.angular or name is None or name in ("3.5", "3.6"):
            continue
        if name not in points or not points[name].is_bound:
            continue
        numbers.append(number)
        names.append(name)
        directions.append((direction[0], direction[2], -direction[1]))
        lengths.append(unit_length(fap.unit, units) / head_frame.scale)
    return FapRows(
        numbers=np.array(numbers, dtype=np.int64),
        names=tuple(names),
        directions=np.array(directions, dtype=np.float64).reshape(-1, 3),
        units=np.array(lengths, dtype=np.float64),
    )
