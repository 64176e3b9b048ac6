"""A contact sheet: pictures of a face side by side, each with the FAPs it was asked for and those it shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...arrays import Floats
from ...files import scratch_folder
from .lettering import LINE, Text, read_picture, write_picture, write_text

COLUMNS = 3
MARGIN, TITLE, LETTER = 24, 32.0, 18.0


@dataclass(frozen=True)
class Exhibit:
    """One face of the sheet.

    Attributes
    ----------
    title : such as "joy", with a smaller `caption`.
    picture : a PNG file; all of a sheet have one size.
    values : FAP label -> (asked, shown), FAPU.
    """

    title: str
    caption: str
    picture: Path
    values: Mapping[str, tuple[float, float]]


def write_sheet(exhibits: Sequence[Exhibit], path: Path) -> Path:
    """Compose the sheet and write it as a PNG."""
    pictures = [read_picture(exhibit.picture) for exhibit in exhibits]
    high, wide, _ = pictures[0].shape
    columns = min(COLUMNS, len(exhibits))
    rows = -(-len(exhibits) // columns)
    tops = [MARGIN]
    for row in range(rows):
        lines = max(-(-len(exhibit.values) // 2) for exhibit in exhibits[row * columns : (row + 1) * columns]) + 1
        tops.append(tops[-1] + int(1.6 * TITLE + high + LINE * LETTER * (lines + 0.8)) + MARGIN)
    cell_width = wide + MARGIN
    width = columns * cell_width + MARGIN
    height = tops.pop()
    texts: list[Text] = []
    corners = []
    for index, exhibit in enumerate(exhibits):
        left = MARGIN + (index % columns) * cell_width
        top = tops[index // columns]
        texts += _texts(exhibit, left, top, wide, high)
        corners.append((left, top + int(1.6 * TITLE)))
    with scratch_folder() as folder:
        sheet = write_text(texts, width, height, folder)
    for picture, (left, top) in zip(pictures, corners, strict=True):
        sheet[top : top + high, left : left + wide] = picture
    return write_picture(np.clip(sheet, 0.0, 1.0), path)


def _texts(exhibit: Exhibit, left: float, top: float, wide: int, high: int) -> list[Text]:
    """Title above the picture, two blocks of values below it."""
    texts = [
        Text((exhibit.title.capitalize(),), left, top + TITLE, TITLE),
        Text((exhibit.caption,), left + wide, top + TITLE, 0.6 * TITLE, right=True),
    ]
    names = list(exhibit.values)
    half = -(-len(names) // 2)
    first = top + 1.6 * TITLE + high + LINE * LETTER
    for block, chosen in enumerate((names[:half], names[half:])):
        if not chosen:
            continue
        x = left + block * (wide + MARGIN) / 2
        right = x + (wide - MARGIN) / 2
        asked = ("asked", *(_figure(exhibit.values[name][0]) for name in chosen))
        shown = ("shown", *(_figure(exhibit.values[name][1]) for name in chosen))
        texts.append(Text(("", *chosen), x, first, LETTER))
        texts.append(Text(asked, right - 3.6 * LETTER, first, LETTER, right=True))
        texts.append(Text(shown, right, first, LETTER, right=True))
    return texts


def _figure(value: float) -> str:
    """A FAP value without decimals; a dash where the face has no such point."""
    return "–" if np.isnan(value) else f"{value:.0f}"


def exhibit_values(labels: Sequence[str], asked: Floats, shown: Floats) -> dict[str, tuple[float, float]]:
    """Label -> (asked, shown) for the FAPs that were asked for; arrays (68,)."""
    silent = np.isnan(asked)
    return {
        label: (float(a), float(s))
        for label, a, s, quiet in zip(labels, asked, shown, silent, strict=True)
        if not quiet
    }
