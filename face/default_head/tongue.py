"""The tongue: a flattened ellipsoid with a middle furrow, its back end dropping towards the throat."""

from __future__ import annotations

import numpy as np

from ..mesh.parts import Part
from .figures import TongueFigures
from .piece import Piece, fan_quads, tube_quads

SEGMENTS, RINGS = 24, 15
TIP_VERTEX = 0


def build_tongue(figures: TongueFigures) -> Piece:
    """Tongue at rest; vertex 0 is its tip."""
    polar = np.pi * np.arange(1, RINGS + 1) / (RINGS + 1)
    around = 2.0 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    x = np.sin(polar)[:, None] * np.cos(around)
    z = np.sin(polar)[:, None] * np.sin(around)
    y = np.broadcast_to(-np.cos(polar)[:, None], x.shape)
    ball = np.concatenate([[[0.0, -1.0, 0.0]], np.stack([x, y, z], axis=-1).reshape(-1, 3), [[0.0, 1.0, 0.0]]])
    furrow = np.exp(-((ball[:, 0] / figures.furrow) ** 2)) * np.clip(ball[:, 2], 0.0, None)
    rise = np.exp(-(((ball[:, 1] - figures.dorsum_at) / figures.dorsum_length) ** 2)) * np.clip(ball[:, 2], 0.0, None)
    vertices = figures.centre + ball * figures.semi_axes
    vertices[:, 2] += figures.dorsum * rise
    vertices[:, 2] -= figures.groove * furrow + figures.back_drop * np.clip(ball[:, 1], 0.0, None) ** 2
    first, last = np.arange(SEGMENTS) + 1, np.arange(SEGMENTS) + 1 + SEGMENTS * (RINGS - 1)
    quads = np.concatenate(
        [fan_quads(0, first), tube_quads(RINGS, SEGMENTS) + 1, fan_quads(len(ball) - 1, last)[:, ::-1]]
    )
    place = np.arange(SEGMENTS)
    turned = (SEGMENTS // 2 - place) % SEGMENTS
    rows = np.arange(RINGS)[:, None] * SEGMENTS + 1
    mirror = np.concatenate([[0], (rows + turned).ravel(), [len(ball) - 1]])
    vertices = 0.5 * (vertices + vertices[mirror] * np.array([-1.0, 1.0, 1.0]))
    return Piece(vertices, quads, Part.TONGUE, ("tongue",) * len(quads), mirror.astype(np.int64))


def tongue_vertex(ring_share: float, side: int) -> int:
    """Vertex on the left border (side 1), the top (0) or the right border (-1); `ring_share` 0 tip .. 1 back."""
    ring = round(ring_share * (RINGS + 1)) - 1
    place = {1: 0, 0: SEGMENTS // 4, -1: SEGMENTS // 2}[side]
    return 1 + ring * SEGMENTS + place
