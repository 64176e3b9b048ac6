"""The teeth: a gum and crown section swept along each dental arch, narrowed between the crowns."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...arrays import Floats
from ..mesh.parts import Part
from .figures import TeethFigures
from .piece import Piece, ladder_quads, tube_quads

ARCH_ANGLE = 1.42  # half of the arch, in the parameter of its ellipse
CROWN_SAMPLES = (0.0, 0.08, 0.25, 0.5, 0.75, 0.92)  # sections per crown, as shares of its width
SECTION = 12  # points per section; 0-2 and 9-11 are gum, 2-9 the crown
FRONT_GUM, FRONT_EDGE = 2, 5  # section points on the gum line and on the biting edge, both in front


@dataclass(frozen=True)
class DentalArch:
    """A row of teeth with the vertices that carry feature points, all on the midline in front."""

    piece: Piece
    gum_line: int
    edge: int


def build_teeth(figures: TeethFigures, part: Part) -> DentalArch:
    """Upper or lower row, from the right end of the arch over the midline to the left end."""
    shares = _crown_places(figures.widths)
    gap = _groove(shares)
    t = _arch_parameter(figures, shares[:, 0])
    across, along = np.sin(t), np.cos(t)
    foot = np.stack([figures.half_width * across, figures.back - figures.depth * along], axis=-1)
    inward = -np.stack([figures.depth * across, -figures.half_width * along], axis=-1)
    inward /= np.linalg.norm(inward, axis=1)[:, None]
    depth, height = _sections(np.abs(t) / ARCH_ANGLE, gap, figures.groove)
    xy = foot[:, None, :] + inward[:, None, :] * depth[..., None]
    z = figures.gum + (figures.edge - figures.gum) * height
    vertices = np.concatenate([xy, z[..., None]], axis=-1).reshape(-1, 3)

    count = len(shares)
    ends = ladder_quads(np.arange(SECTION)), ladder_quads(np.arange(SECTION) + SECTION * (count - 1))[:, ::-1]
    quads = np.concatenate([tube_quads(count, SECTION), *ends])
    downward = figures.edge < figures.gum
    if downward:
        quads = quads[:, ::-1].copy()
    crown = tuple("tooth" if FRONT_GUM <= k < SECTION - 3 else "gum" for k in range(SECTION))
    materials = crown * (count - 1) + ("gum",) * (len(ends[0]) * 2)
    section = np.arange(count)[::-1, None] * SECTION
    mirror = (section + np.arange(SECTION)).ravel().astype(np.int64)
    vertices = 0.5 * (vertices + vertices[mirror] * np.array([-1.0, 1.0, 1.0]))
    middle = (count // 2) * SECTION
    piece = Piece(vertices, quads, part, materials, mirror)
    return DentalArch(piece, middle + FRONT_GUM, middle + FRONT_EDGE)


def _crown_places(widths: Floats) -> Floats:
    """(N, 2): place along the arch, -1 right end .. 1 left end, and place within the crown, 0..1."""
    side = np.concatenate([[0.0], np.cumsum(widths)]) / np.sum(widths)
    left = [(start + share * (end - start), share) for start, end in pairwise(side) for share in CROWN_SAMPLES]
    left.append((1.0, 0.0))
    right = [(-place, (1.0 - share) % 1.0) for place, share in left[:0:-1]]
    return np.array(right + left)


def _groove(shares: Floats) -> Floats:
    """1 between two crowns, falling to 0 on the crown."""
    distance = np.minimum(shares[:, 1], 1.0 - shares[:, 1])
    return np.asarray(np.clip(1.0 - distance / 0.3, 0.0, 1.0) ** 1.5, dtype=np.float64)


def _arch_parameter(figures: TeethFigures, places: Floats) -> Floats:
    """Ellipse parameter at a share of the arch's length."""
    t = np.linspace(0.0, ARCH_ANGLE, 400)
    speed = np.hypot(figures.half_width * np.cos(t), figures.depth * np.sin(t))
    length = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(t))])
    return np.asarray(np.sign(places) * np.interp(np.abs(places), length / length[-1], t), dtype=np.float64)


def _sections(back: Floats, gap: Floats, groove: float) -> tuple[Floats, Floats]:
    """Depth behind the front face (metres) and height (0 gum line, 1 edge) of the section points, (N, 12) each.

    `back` runs from 0 at the incisors to 1 at the last molar, `gap` is 1 between crowns, `groove` the depth there.
    """
    thick = (6.0 + 3.5 * np.clip((back - 0.35) / 0.3, 0.0, 1.0)) * 1e-3
    edge = (1.2e-3) + 0.62 * (thick - 6e-3) / 3.5e-3 * 9e-3
    one, inset = np.ones_like(back), groove * gap
    corner = 0.10 * gap
    depth = [
        0.6e-3 * one, -0.35e-3 * one, 0.15e-3 + 0.4 * inset, inset, 0.15e-3 + inset, 0.5e-3 + inset,
        0.5e-3 + edge - inset, np.maximum(0.5 * thick, 0.7e-3 + edge) - inset, 0.85 * thick - inset,
        thick - 0.4 * inset, thick + 0.4e-3, thick - 0.6e-3,
    ]  # fmt: skip
    height = [
        -0.7 * one, -0.3 * one, 0.16 * gap, 0.4 * one, 0.8 * one, 1.0 - corner,
        1.0 - corner, 0.75 * one, 0.35 * one, 0.16 * gap, -0.3 * one, -0.7 * one,
    ]  # fmt: skip
    return np.stack(depth, axis=-1), np.stack(height, axis=-1)
