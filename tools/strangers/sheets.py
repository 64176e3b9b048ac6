"""Contact sheets of what was pictured, as small JPEGs. Needs Blender's `bpy`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import bpy
from faithful.sheet import Cell, write_grid
from risorius.arrays import Floats
from risorius.scene.pictures.lettering import read_picture

from .page import Sheet
from .sittings import EMOTIONS, OWN, SCAN, SCANNED_HEAD, Sitting
from .verdicts import NO_FACE, Judged, likeliest, named

QUALITY = 82


#: Of so many heads growth is shown.
GROWN_HEADS = 3

#: Pictures in a row of the sheet of all words.
WORDS_A_ROW = 6

SIX = f"The six from left to right: {', '.join(EMOTIONS)}. Above each row: what its pictures are named."
GROWN = "Activation 1 to 7 from left to right. Above each row: what its pictures are named."
WORDS = "Each word at its own activation. Above each picture: what the judges take it for, of seven classes."


def write_sheets(judged: Judged, files: Mapping[Sitting, Path], heads: Sequence[str], folder: Path) -> list[Sheet]:
    """Sheets in a folder: the six on all heads, how they grow on some, and all words where they were pictured."""
    found = []
    own = [[Sitting(head, emotion, OWN) for emotion in EMOTIONS] for head in heads]
    control = [Sitting(SCANNED_HEAD, emotion, SCAN) for emotion in EMOTIONS]
    rows = {row[0].head: row for row in own if row[0] in files} | ({"scans": control} if control[0] in files else {})
    if rows:
        found.append(_write(rows, judged, files, folder / "strangers-six.jpg", "The six at their own activation", SIX))
    for head in heads[:GROWN_HEADS]:
        grown = {emotion: [Sitting(head, emotion, str(how)) for how in range(1, 8)] for emotion in EMOTIONS}
        if all(sitting in files for row in grown.values() for sitting in row):
            path = folder / f"strangers-growth-{head}.jpg"
            found.append(_write(grown, judged, files, path, f"Activation 1 to 7: {head}", GROWN))
    for head in heads:
        words = [s for s in files if (s.head, s.how, s.turned) == (head, OWN, 0)]
        if len(words) > len(EMOTIONS):
            path = folder / f"strangers-words-{head}.jpg"
            found.append(_write_words(words, judged, files, path, f"All words: {head}"))
    return found


def _write(
    rows: Mapping[str, Sequence[Sitting]],
    judged: Judged,
    files: Mapping[Sitting, Path],
    path: Path,
    title: str,
    told: str,
) -> Sheet:
    """One sheet, a row of pictures per line."""
    cells = [Cell(name, _caption(row, judged), [_small(files[s]) for s in row]) for name, row in rows.items()]
    write_jpeg(cells, path, title, columns=1)
    return Sheet(title, path.name, told)


def _write_words(
    words: Sequence[Sitting], judged: Judged, files: Mapping[Sitting, Path], path: Path, title: str
) -> Sheet:
    """A sheet of words, a picture each."""
    cells = []
    for sitting in words:
        taken = likeliest(judged[sitting], 1)
        cells.append(Cell(sitting.word, taken[0][0] if taken else NO_FACE, [read_picture(files[sitting])]))
    write_jpeg(cells, path, title, columns=WORDS_A_ROW)
    return Sheet(title, path.name, WORDS)


def write_jpeg(cells: Sequence[Cell], path: Path, heading: str, *, columns: int) -> None:
    """Cells in a grid."""
    grid = write_grid(cells, path.with_suffix(".png"), columns=columns, heading=heading)
    image = bpy.data.images.load(str(grid))
    try:
        len(image.pixels)  # loads it
        image.filepath_raw, image.file_format = str(path), "JPEG"
        image.save(quality=QUALITY)
    finally:
        bpy.data.images.remove(image)
        grid.unlink()


def _small(file: Path) -> Floats:
    """A picture at half its size."""
    pixels = read_picture(file)
    half: Floats = 0.25 * (pixels[::2, ::2] + pixels[1::2, ::2] + pixels[::2, 1::2] + pixels[1::2, 1::2])
    return half


def _caption(row: Sequence[Sitting], judged: Judged) -> str:
    """What each picture of a row is named."""
    return ", ".join(named(judged[sitting]) for sitting in row)
