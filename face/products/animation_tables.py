"""Face Animation Tables (FAT): what every FAP does to every vertex, piecewise linear, for players without muscles.

A table gives, between two neighbouring borders of a FAP, how far each vertex goes per unit of it. A frame is played by
adding up its FAPs. Source: ISO/IEC 14496-1 (FaceDefTables, FaceDefMesh); Raouzaiou et al. 2002, section 3.3.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Floats, Ints
from ...errors import ParameterError
from ...mpeg4 import FAP_COUNT, FAPS


@dataclass(frozen=True)
class TableError:
    """How far played vertices lie from solved ones, in the mesh's unit (metres)."""

    rms: float
    largest: float


@dataclass(frozen=True, eq=False)
class AnimationTable:
    """One FAP's table.

    Attributes
    ----------
    fap : FAP number, 3..68.
    unit : metres per unit of the FAP (FAPU / 1024), or rad (1e-5) for angles.
    borders : (b,) int64, FAP units, ascending, one of them 0.
    vertices : (n,) int64, indices of the vertices that move.
    slopes : (b - 1, n, 3) float64, metres per metre (or per rad) of the FAP in each interval.
    error : against the full solution half way between the borders, over the vertices that move; None where unknown.

    Raises
    ------
    ParameterError : shapes, borders or figures break their rule.
    """

    fap: int
    unit: float
    borders: Ints
    vertices: Ints
    slopes: Floats
    error: TableError | None = None

    def __post_init__(self) -> None:
        """Check the arrays against one another."""
        if self.fap not in FAPS or FAPS[self.fap].high_level:
            raise ParameterError("fap", f"must be a low-level FAP, 3..{FAP_COUNT}", self.fap)
        if not (np.isfinite(self.unit) and self.unit > 0.0):
            raise ParameterError("unit", "must be positive", self.unit)
        if self.borders.ndim != 1 or len(self.borders) < 2 or (np.diff(self.borders) <= 0).any():
            raise ParameterError("borders", "must be two or more numbers in ascending order", self.borders.tolist())
        if 0 not in self.borders:
            raise ParameterError("borders", "must contain 0", self.borders.tolist())
        if self.vertices.ndim != 1 or (self.vertices < 0).any() or len(np.unique(self.vertices)) != len(self.vertices):
            raise ParameterError("vertices", "must be different indices", self.vertices.shape)
        expected = (len(self.borders) - 1, len(self.vertices), 3)
        if self.slopes.shape != expected or not np.isfinite(self.slopes).all():
            raise ParameterError("slopes", f"must be finite, of the shape {expected}", self.slopes.shape)

    def displacement(self, value: float) -> Floats:
        """(n, 3) metres that the vertices move at a value of the FAP; beyond the borders the last slope goes on.

        Examples
        --------
        >>> jaw = api.face_animation_tables(api.default_face(), faps=[3], steps=1).tables[3]
        >>> jaw.displacement(200.0).shape == (len(jaw.vertices), 3)
        True
        """
        low, high = self.borders[:-1].astype(np.float64), self.borders[1:].astype(np.float64)
        low[0], high[-1] = -np.inf, np.inf
        covered = np.clip(value, low, high) - np.clip(0.0, low, high)
        return np.asarray(self.unit * np.tensordot(covered, self.slopes, axes=1), dtype=np.float64)


@dataclass(frozen=True, eq=False)
class AnimationTables:
    """The tables of one face.

    Attributes
    ----------
    vertices : (V, 3) float64, the neutral mesh.
    tables : FAP number -> its table; FAPs that move nothing on this face have none.

    Raises
    ------
    ParameterError : a table moves a vertex that the mesh lacks.
    """

    vertices: Floats
    tables: Mapping[int, AnimationTable]

    def __post_init__(self) -> None:
        """Check that the tables are of this mesh."""
        if self.vertices.ndim != 2 or self.vertices.shape[1] != 3 or not np.isfinite(self.vertices).all():
            raise ParameterError("vertices", "must be finite, of the shape (V, 3)", self.vertices.shape)
        for number, table in self.tables.items():
            if number != table.fap or table.vertices.max(initial=-1) >= len(self.vertices):
                raise ParameterError(
                    f"table of FAP {number}", f"must move some of {len(self.vertices)} vertices", number
                )

    def play(self, frame: ArrayLike) -> Floats:
        """Vertices (V, 3) at a frame (68,) of FAPs; NaN is 0, FAPs without a table do nothing.

        Raises
        ------
        ParameterError : a frame of another shape, or infinite.

        Examples
        --------
        >>> tables = api.face_animation_tables(api.default_face(), faps=[3], steps=1)
        >>> frame = np.full(68, np.nan)
        >>> frame[3 - 1] = 200.0  # open_jaw
        >>> tables.play(frame).shape == tables.vertices.shape
        True
        """
        values = np.asarray(frame, dtype=np.float64)
        if values.shape != (FAP_COUNT,) or np.isinf(values).any():
            raise ParameterError("frame", f"must be finite or NaN, of the shape ({FAP_COUNT},)", values.shape)
        positions = self.vertices.copy()
        for number, table in self.tables.items():
            value = float(values[number - 1])
            if value and not np.isnan(value):
                positions[table.vertices] += table.displacement(value)
        return positions


def slopes_of(borders: Sequence[int] | Ints, shifts: Floats, unit: float) -> Floats:
    """Slopes (b - 1, n, 3) of displacements (b, n, 3) in metres at the borders (b,)."""
    widths = np.diff(np.asarray(borders, dtype=np.float64)) * unit
    return np.asarray(np.diff(shifts, axis=0) / widths[:, None, None], dtype=np.float64)
