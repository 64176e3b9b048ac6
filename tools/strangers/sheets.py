"""Contact sheets of what was pictured, as small JPEGs. Needs Blender's `bpy`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import bpy
from faithful.sheet import Cell, write_grid
from risorius.arrays import Floats
from risorius.scene.pictures.lettering import read_picture

from .sittings import EMOTIONS, OWN, SCAN, SCANNED_HEAD, Sitting
from .verdicts import Judged, named

QUALITY = 82


def write_sheets(judged: Judged, files: Mapping[Sitting, Path], heads: Sequence[str], folder: Path) -> dict[str, str]:
    """Title -> name of the sheet in a folder: the six on all heads, and how they grow."""
    found = {}
    own = [[Sitting(head, emotion, OWN) for emotion in EMOTIONS] for head in heads]
    control = [Sitting(SCANNED_HEAD, emotion, SCAN) for emotion in EMOTIONS]
    rows = {row[0].head: row for row in own if row[0] in files} | ({"scans": control} if control[0] in files else {})
    if rows:
        title = "The six at their own activation"
        found[title] = _write(rows, judged, files, folder / "strangers-six.jpg", title)
    for head in heads:
        grown = {emotion: [Sitting(head, emotion, str(how)) for how in range(1, 8)] for emotion in EMOTIONS}
        if all(sitting in files for row in grown.values() for sitting in row):
            title = f"Activation 1 to 7: {head}"
            found[title] = _write(grown, judged, files, folder / f"strangers-growth-{head}.jpg", title)
    return found


def _write(
    rows: Mapping[str, Sequence[Sitting]], judged: Judged, files: Mapping[Sitting, Path], path: Path, heading: str
) -> str:
    """One sheet, a row of pictures per line; returns its file's name."""
    cells = [Cell(name, _caption(row, judged), [_small(files[s]) for s in row]) for name, row in rows.items()]
    grid = write_grid(cells, path.with_suffix(".png"), columns=1, heading=heading)
    image = bpy.data.images.load(str(grid))
    try:
        len(image.pixels)  # loads it
        image.filepath_raw, image.file_format = str(path), "JPEG"
        image.save(quality=QUALITY)
    finally:
        bpy.data.images.remove(image)
        grid.unlink()
    return path.name


def _small(file: Path) -> Floats:
    """A picture at half its size."""
    pixels = read_picture(file)
    half: Floats = 0.25 * (pixels[::2, ::2] + pixels[1::2, ::2] + pixels[::2, 1::2] + pixels[1::2, 1::2])
    return half


def _caption(row: Sequence[Sitting], judged: Judged) -> str:
    """What each picture of a row is named."""
    return ", ".join(named(judged[sitting]) for sitting in row)
