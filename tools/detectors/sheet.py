"""Some of the pictures with what MediaPipe makes of them. Needs Blender's `bpy`."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
from faithful.sheet import Cell, write_grid
from risorius.arrays import Floats
from risorius.scene.pictures.lettering import read_picture

from .figures import Scores, risen
from .stills import HEADS, Still, actions

#: What is shown, each head in turn from the front; half of the pictures' size, of every second pixel.
SHOWN, STEP, QUALITY = ("AU12", "AU1", "AU4", "AU9", "AU10", "AU15", "AU24", "AU27", "AU43"), 2, 82

COLUMNS = 3


def write_sheet(scores: Scores, folder: Path, path: Path) -> Path:
    """A cell per action unit: rest and full strength on one head, and how the shape that means the same rises."""
    cells = []
    for number, unit in enumerate(SHOWN):
        still = Still(HEADS[number % len(HEADS)], unit)
        rises = risen(scores, still)
        shape = actions()[unit].shape
        caption = f"{shape} {rises[shape]:+.2f}" if rises else "no face"
        cells.append(
            Cell(f"{unit} {still.head}", caption, [_small(folder / each.file) for each in (still.at_rest, still)])
        )
    sheet = write_grid(cells, path.with_suffix(".png"), columns=COLUMNS, heading="at rest and at full strength")
    return _as_jpeg(sheet, path)


def _small(path: Path) -> Floats:
    """A picture at half its size."""
    picture: Floats = read_picture(path)
    high, wide = (side // STEP * STEP for side in picture.shape[:2])
    blocks = picture[:high, :wide].reshape(high // STEP, STEP, wide // STEP, STEP, -1)
    return np.asarray(blocks.mean(axis=(1, 3)))


def _as_jpeg(sheet: Path, path: Path) -> Path:
    """The same as a small JPEG; the PNG goes."""
    image = bpy.data.images.load(str(sheet))
    len(image.pixels)  # loads it
    image.filepath_raw, image.file_format = str(path), "JPEG"
    image.save(quality=QUALITY)
    sheet.unlink()
    return path
