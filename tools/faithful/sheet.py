"""A sheet of pictures in a grid, each cell with its title and several pictures side by side."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from risorius.arrays import Floats
from risorius.scene.pictures.lettering import Text, write_picture, write_text

MARGIN, LETTER = 14, 22.0


@dataclass(frozen=True)
class Cell:
    """A title, a smaller caption to its right, and pictures (height, width, 3) of one size, side by side."""

    title: str
    caption: str
    pictures: Sequence[Floats]


def write_grid(cells: Sequence[Cell], path: Path, *, columns: int, heading: str) -> Path:
    """Write cells of equal size row by row as a PNG under one heading."""
    high, wide, _ = cells[0].pictures[0].shape
    cell_width, cell_height = len(cells[0].pictures) * wide + MARGIN, int(high + 1.5 * LETTER) + MARGIN
    rows = -(-len(cells) // columns)
    top = int(2.2 * LETTER)
    width, height = columns * cell_width + MARGIN, rows * cell_height + top + MARGIN
    places = [(MARGIN + (i % columns) * cell_width, top + (i // columns) * cell_height) for i in range(len(cells))]
    texts = [Text((heading,), MARGIN, 1.4 * LETTER, 1.1 * LETTER)]
    for cell, (left, upper) in zip(cells, places, strict=True):
        texts.append(Text((cell.title,), left, upper + LETTER, LETTER))
        right = left + cell_width - MARGIN
        texts.append(Text((cell.caption,), right, upper + LETTER, 0.8 * LETTER, right=True))
    with tempfile.TemporaryDirectory(prefix="risorius-") as folder:
        sheet = write_text(texts, width, height, Path(folder))
    for cell, (left, upper) in zip(cells, places, strict=True):
        row = upper + int(1.5 * LETTER)
        sheet[row : row + high, left : left + len(cell.pictures) * wide] = np.concatenate(cell.pictures, axis=1)
    path.parent.mkdir(parents=True, exist_ok=True)
    return write_picture(np.clip(sheet, 0.0, 1.0), path)
