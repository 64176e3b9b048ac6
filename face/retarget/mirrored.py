"""Which controls are each other's mirror image, measured on the face."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial import cKDTree

from ...arrays import Floats

#: Controls are mirror images where the cosine between one and the other mirrored is at least this.
ALIKE = 0.9
#: A vertex has a mirror image where one lies within this of it, mirrored, on a life-size face, metres.
NEAR = 3e-3


def mirrored_pairs(positions: Floats, effects: Floats) -> Sequence[tuple[int, int]]:
    """Pairs (left, right) of controls that do the same on the two sides.

    Parameters
    ----------
    positions : (n, 3) of the outer skin at rest, head space: +X is the subject's left.
    effects : (K, 3n) what each control does to it.
    """
    flip = np.array([-1.0, 1.0, 1.0])
    distance, image = cKDTree(positions).query(positions * flip)
    there = np.asarray(distance) < NEAR
    moved = effects.reshape(len(effects), -1, 3)
    flipped = (moved[:, image] * flip * there[:, None]).reshape(len(effects), -1)
    length, other = np.linalg.norm(effects, axis=1), np.linalg.norm(flipped, axis=1)
    alike = effects @ flipped.T / np.maximum(np.outer(length, other), 1e-300)
    np.fill_diagonal(alike, -1.0)
    middle = (moved**2).sum(axis=2) @ positions[:, 0]
    pairs = []
    for left in range(len(effects)):
        right = int(np.argmax(alike[left])) if len(effects) > 1 else left
        if middle[left] > middle[right] and alike[left, right] >= ALIKE and int(np.argmax(alike[right])) == left:
            pairs.append((left, right))
    return pairs
