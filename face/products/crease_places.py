"""Where the vertices of a face lie across a crease: figures that a renderer interpolates over polygons."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats
from ..mesh.template import TemplateWarp
from ..skin.lines import Beside, line_on
from ..skin.outer import OuterSkin, smoothstep
from .crease_table import CREASES, CreaseRow

_MIRROR = np.array([-1.0, 1.0, 1.0])


def place_crease(skin: OuterSkin, warp: TemplateWarp, row: CreaseRow) -> Floats:
    """Places of the outer skin on a crease; of a pair, each vertex on its own side's.

    Returns
    -------
    (n, 2) place across in spacings, the first line at 0, the second at 1; presence from 0 to 1.
    """
    left = _places(_beside_all(skin, warp, row, mirrored=False), row.spacing)
    if not row.paired:
        return left
    right = _places(_beside_all(skin, warp, row, mirrored=True), row.spacing)
    return np.where((skin.positions[:, 0] > 0.0)[:, None], left, right)


def _beside_all(skin: OuterSkin, warp: TemplateWarp, row: CreaseRow, *, mirrored: bool) -> list[Beside]:
    """All lines of a crease; where there are several, the positive side of each is toward the last."""
    lines = [line_on(skin, warp, line * _MIRROR if mirrored else line).beside(skin.positions) for line in row.lines]
    signs = [1.0] * len(lines)
    for number, line in enumerate(lines if len(lines) > 1 else []):
        other = lines[number - 1] if number else lines[1]
        there = line.across[int(np.argmin(other.off))]
        signs[number] = float(np.copysign(1.0, there if number == 0 else -there))
    return [Beside(sign * line.across, line.share, line.off) for sign, line in zip(signs, lines, strict=True)]


def _places(lines: list[Beside], spacing: float) -> Floats:
    """(n, 2) place across and presence, from all lines of one side."""
    across = np.stack([line.across for line in lines])
    shares = np.stack([line.share for line in lines])
    ends = smoothstep(shares / CREASES.ends) * smoothstep((1.0 - shares) / CREASES.ends)
    last, every = len(lines) - 1, np.arange(across.shape[1])
    before = np.clip((across > 0.0).sum(axis=0) - 1, 0, last)
    after = np.minimum(before + 1, last)
    gone, left = across[before, every], -across[after, every]
    between = (gone > 0.0) & (left > 0.0)
    part = np.where(between, gone / np.where(between, gone + left, 1.0), gone / spacing)
    place = before + part
    mixed = (1.0 - part) * ends[before, every] + part * ends[after, every]
    nearest = np.argmin(np.abs(across), axis=0)
    ending = np.where(between, mixed, ends[nearest, every])
    beyond = np.maximum(np.maximum(-place, place - last), 0.0)
    near = np.min([line.off for line in lines], axis=0) < CREASES.far * spacing
    lasts, gone = CREASES.fades
    presence = ending * smoothstep((gone - beyond) / (gone - lasts)) * near
    return np.column_stack([place, presence])
