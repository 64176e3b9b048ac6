"""Colours of contraction, strain and time, as figures."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats, Ints

#: Linear RGB from rest to the apex, evenly spaced, as figure 8 of Zhang, Sung, Prakash 2001 has them.
TIME = np.array(
    [[0.02, 0.10, 0.90], [0.0, 0.55, 0.95], [0.05, 0.75, 0.15], [1.0, 0.75, 0.0], [1.0, 0.10, 0.0], [0.85, 0.0, 0.02]]
)
SLACK, CONTRACTED = np.array([0.25, 0.45, 0.85, 0.35]), np.array([1.0, 0.12, 0.08, 1.0])
SQUEEZED, STRETCHED = np.array([0.10, 0.30, 1.0]), np.array([1.0, 0.12, 0.05])
#: Strain at which a colour is full, and how opaque it is then.
FULL_STRAIN, OPACITY = 0.3, 0.85


def of_contraction(contraction: float) -> Floats:
    """(4,) colour of a muscle contracted 0..1; what pulls a little shows already."""
    share = np.sqrt(min(max(contraction, 0.0), 1.0))
    mixed: Floats = SLACK + share * (CONTRACTED - SLACK)
    return mixed


def of_time(share: Floats) -> Floats:
    """(n, 4) colours of shares (n,) of the way, 0 at rest to 1 at the apex."""
    at = np.clip(share, 0.0, 1.0) * (len(TIME) - 1)
    colours = np.stack([np.interp(at, np.arange(len(TIME)), channel) for channel in TIME.T], axis=1)
    return np.concatenate([colours, np.ones((len(colours), 1))], axis=1)


def of_strain(strain: Floats) -> Floats:
    """(V, 4) colours of strain (V,): transparent where there is none."""
    share = np.clip(strain / FULL_STRAIN, -1.0, 1.0)
    colours = np.empty((len(strain), 4))
    colours[:, :3] = np.where(share[:, None] > 0.0, STRETCHED, SQUEEZED)
    colours[:, 3] = OPACITY * np.abs(share) ** 0.75
    return colours


def strain(rest: Floats, shown: Floats, edges: Ints) -> Floats:
    """(V,) mean relative lengthening of the edges (E, 2) at each vertex, between two shapes (V, 3)."""
    before, now = (np.linalg.norm(shape[edges[:, 0]] - shape[edges[:, 1]], axis=1) for shape in (rest, shown))
    longer = np.divide(now - before, before, out=np.zeros_like(before), where=before > 0.0)
    count = np.bincount(edges.ravel(), minlength=len(rest))
    total = np.bincount(edges.ravel(), weights=np.repeat(longer, 2), minlength=len(rest))
    return np.asarray(total / np.maximum(count, 1))
