"""Where the default head's face folds, and its skin, made denser there."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from .cage import EYE_RIM, MOUTH_RIM, grid_name, grid_nodes, ring_name
from .denser import Stripe, coloured, denser
from .figures import HeadFigures
from .skin import HeadSkin, build_skin, settle

#: Rows and columns (both inclusive) of the grid between which the skin is denser across the rows.
ROWS = (
    ((0, 3), (0, 7)),  # forehead
)
#: The same across the columns.
COLUMNS = (
    ((0, 3), (0, 2)),  # glabella
    ((3, 7), (7, 8)),  # crow's feet
    ((7, 13), (4, 6)),  # beside nose and mouth
)
#: Rings round eye and mouth between which it is denser across, outermost first; the rim is the grid's.
EYE_RINGS = (("rim", "E4"), ("E4", "E3"), ("E3", "E2"))
MOUTH_RINGS = (("B1", "B2"),)


def folding_skin(figures: HeadFigures) -> HeadSkin:
    """Skin through the figures, denser where faces fold: forehead, glabella, lids, beside nose and mouth.

    Raises
    ------
    SolverError : figures that no smooth surface reaches.
    """
    coarse = build_skin(figures)
    skin = denser(coarse, coloured(coarse, _stripes()))
    settle(skin, figures)
    return skin


def _stripes() -> list[Stripe]:
    """All stripes."""
    rows = [Stripe(_row(a, columns), _row(b, columns)) for rows, columns in ROWS for a, b in _pairs(rows)]
    columns = [Stripe(_column(a, rows), _column(b, rows)) for rows, columns in COLUMNS for a, b in _pairs(columns)]
    eyes = [Stripe(_ring("eye", a, EYE_RIM), _ring("eye", b, EYE_RIM)) for a, b in EYE_RINGS]
    mouth = [Stripe(_ring("mou", a, MOUTH_RIM), _ring("mou", b, MOUTH_RIM)) for a, b in MOUTH_RINGS]
    return rows + columns + eyes + mouth


def _pairs(bounds: tuple[int, int]) -> list[tuple[int, int]]:
    """Neighbours from the first to the last."""
    return list(pairwise(range(bounds[0], bounds[1] + 1)))


def _row(row: int, columns: tuple[int, int]) -> frozenset[str]:
    """Nodes of a row of the grid."""
    return frozenset(grid_name(row, c) for c in grid_nodes(row) if columns[0] <= c <= columns[1])


def _column(column: int, rows: tuple[int, int]) -> frozenset[str]:
    """Nodes of a column of the grid."""
    return frozenset(grid_name(r, column) for r in range(rows[0], rows[1] + 1) if column in grid_nodes(r))


def _ring(family: str, ring: str, rim: Sequence[tuple[int, int]]) -> frozenset[str]:
    """Nodes of a ring, or of the grid round all of them."""
    if ring == "rim":
        return frozenset(grid_name(row, column) for row, column in rim)
    return frozenset(ring_name(family + ring, k) for k in range(len(rim)))
