"""What belongs to the skin when feature points are sought: neither lashes stitched onto lids nor loose pieces."""

from __future__ import annotations

import numpy as np
from risorius.face.fit.surface.cloud import Surface
from risorius.face.fit.surface.pieces import joined, skin_pieces


def strip(width: int, start: int = 0) -> np.ndarray:
    """(2 * width, 3) triangles between a row of vertices from `start` and the next row, each of width + 1."""
    left = start + np.arange(width)
    above = left + width + 1
    return np.concatenate([np.column_stack([left, left + 1, above + 1]), np.column_stack([left, above + 1, above])])


def sheet_with(hair: np.ndarray, width: int = 20) -> Surface:
    """A sheet of two strips, each 1 high, with further triangles that may use vertices (x, y, 1) of `hair`."""
    x = np.arange(width + 1.0)
    rows = [np.column_stack([x, 0.0 * x, 0.0 * x + y]) for y in (0.0, 1.0, 2.0)]
    lashes = np.column_stack([x, 0.0 * x - 0.1, 0.0 * x + 1.0])
    triangles = np.concatenate([strip(width), strip(width, width + 1), hair])
    return Surface.from_polygons(np.concatenate([*rows, lashes]), triangles)


def stitched(first: int, last: int, width: int = 20) -> np.ndarray:
    """Triangles between the sheet's middle row and the lashes' row."""
    low, up = width + 1 + np.arange(first, last), 3 * (width + 1) + np.arange(first, last)
    return np.concatenate([np.column_stack([low, low + 1, up + 1]), np.column_stack([low, up + 1, up])])


def test_lashes_stitched_onto_skin_are_no_skin() -> None:
    surface = sheet_with(stitched(5, 15))
    assert len(np.unique(joined(surface.triangles))) == 1
    skin = skin_pieces(surface)
    assert len(skin.triangles) == 4 * 20
    assert skin.triangles.max() < 3 * 21


def test_a_loose_small_piece_is_no_skin() -> None:
    loose = 3 * 21 + np.array([[0, 1, 2]])
    surface = sheet_with(loose)
    surface = Surface.from_polygons(surface.vertices + np.array([0.0, 0.0, 1e-3]), surface.triangles)
    assert len(skin_pieces(surface).triangles) == 4 * 20


def test_a_small_piece_that_closes_the_skin_stays() -> None:
    low, up = 21, 42  # one square of the sheet's upper strip, on every side of which flaps hang
    square = [low + 10, low + 11, up + 11, up + 10]
    tips = 63 + np.arange(8, 13)
    flaps = np.array([[square[k % 4], square[(k + 1) % 4], tips[k]] for k in (0, 1, 2, 3, 2)])
    flaps[4, 2] = tips[4]
    skin = skin_pieces(sheet_with(flaps))
    held = {tuple(sorted(triangle)) for triangle in skin.triangles.tolist()}
    assert tuple(sorted([low + 10, low + 11, up + 11])) in held
    assert not any(set(triangle) & set(tips.tolist()) for triangle in held)
