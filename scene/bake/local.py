"""Shapes that each move a part of the face where that is possible, and are exactly zero elsewhere.

Few shapes span the same motions in many ways. Turned among one another until each is large at few vertices (varimax;
Kaiser 1958), more of them is so small that it may as well be nothing. What is exactly zero costs nothing in a glTF
file, which lists the vertices that move, nor in a compressed .blend.
"""

from __future__ import annotations

import numpy as np

from ...arrays import Bools, Floats, Singles
from ...progress import Progress, Work
from .gathered import NEAR, TEXT, squares

#: Vertices that tell how shapes are turned, rounds of turning, and how little a round may still turn.
VERTICES, ROUNDS, STILL = 3000, 100, 1e-4


def turning(parts: Floats, fields: Singles) -> Floats:
    """(k, k) rotation that makes shapes ``parts @ fields``, (k, r) of (r, 3 V), large at few vertices each."""
    count = fields.shape[1] // 3
    vertices = np.unique(np.linspace(0, count - 1, VERTICES).astype(np.int64))
    columns = (3 * vertices[:, None] + np.arange(3)).ravel()
    flat = parts.astype(np.float32) @ fields[:, columns]
    rotation = np.eye(len(parts))
    for _ in range(ROUNDS if len(parts) else 0):
        turned = (rotation.astype(np.float32) @ flat).reshape(len(parts), -1, 3)
        lengths = squares(turned)[:, :, None]
        pull = (lengths - lengths.mean(axis=1, keepdims=True)) * turned
        left, _, right = np.linalg.svd(pull.reshape(len(parts), -1) @ flat.T)
        before, rotation = rotation, left @ right
        if np.abs(rotation - before).max() < STILL:
            break
    return np.asarray(rotation)


def with_zeros(parts: Floats, fields: Singles, room: Floats) -> Work[tuple[Singles, Floats]]:
    """Shapes (k, V, 3) with zeros where they are small, and how far (V,) these take a vertex at most, metres.

    Parameters
    ----------
    parts, fields : of the shapes, with weights of at most 1.
    room : (V,) metres that each vertex may be moved by what is left out.
    """
    shapes: Singles = np.empty((len(parts), len(room), 3), dtype=np.float32)
    moved = np.empty(len(room))
    parts32, size = parts.astype(np.float32), max(NEAR // (3 * max(len(parts), 1)), 1)
    for first in range(0, len(room), size):
        yield Progress(0.9, TEXT)
        some = slice(first, first + size)
        block = (parts32 @ fields[:, 3 * first : 3 * (first + size)]).reshape(len(parts), -1, 3)
        lengths = np.sqrt(squares(block))
        small = _small(lengths, room[some])
        shapes[:, some] = np.where(small[:, :, None], 0.0, block)
        moved[some] = np.where(small, lengths, 0.0).sum(axis=0)
    return shapes, moved


def _small(lengths: Floats, room: Floats) -> Bools:
    """Which of (k, v) lengths are the smallest of a vertex that are within its room together."""
    order = np.argsort(lengths, axis=0)
    sums = np.cumsum(np.take_along_axis(lengths, order, axis=0), axis=0)
    small = np.zeros(lengths.shape, dtype=np.bool_)
    np.put_along_axis(small, order, sums <= room, axis=0)
    return small
