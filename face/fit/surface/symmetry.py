"""Planes about which a surface is most nearly its own mirror image."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ....arrays import Floats
from .cloud import nearest

#: Directions tried on the half sphere, and points reflected for each.
DIRECTIONS, PROBES = 220, 400
#: The best of them are refined, in this many rounds.
REFINED, ROUNDS = 10, 14
#: Share of the reflected points that counts: the rest may have no counterpart.
KEPT = 0.8
#: Planes this much worse than the best are no candidates; and at most so many are.
WORSE, PLANES = 1.35, 3
#: Planes closer than this are one: cosine between the normals.
SAME_COSINE = 0.97


@dataclass(frozen=True, eq=False)
class SymmetryPlane:
    """The plane normal . x = offset; `misfit` is the mean mirrored distance over the radius of the surface."""

    normal: Floats
    offset: float
    misfit: float

    def mirrored(self, positions: Floats) -> Floats:
        """Positions (N, 3) on the other side."""
        return np.asarray(positions - 2.0 * np.outer(positions @ self.normal - self.offset, self.normal))


def symmetry_planes(positions: Floats, *, refined: int = REFINED) -> list[SymmetryPlane]:
    """The best planes of symmetry of points (N, 3) spread over a surface, best first, at most `PLANES`.

    Parameters
    ----------
    refined : how many of the best directions are looked at closely.
    """
    centre = positions.mean(axis=0)
    radius = float(np.sqrt(((positions - centre) ** 2).sum(axis=1).mean()))
    tree = cKDTree(positions)
    probes = positions[:: max(1, len(positions) // PROBES)]
    axes = np.linalg.svd(positions - centre, full_matrices=False)[2]
    tried = [
        SymmetryPlane(normal, float(centre @ normal), 0.0) for normal in np.vstack([_half_sphere(DIRECTIONS), axes])
    ]
    found = sorted((_judged(plane, probes, tree, radius) for plane in tried), key=lambda plane: plane.misfit)
    closer = [_refined(plane, positions, tree, radius) for plane in _distinct(found, refined)]
    closer = _distinct(sorted(closer, key=lambda plane: plane.misfit), PLANES)
    return [plane for plane in closer if plane.misfit <= WORSE * closer[0].misfit]


def _half_sphere(count: int) -> Floats:
    """(count, 3) unit vectors spread over a half sphere (Fibonacci's spiral)."""
    z = (np.arange(count) + 0.5) / count
    angle = np.arange(count) * np.pi * (3.0 - np.sqrt(5.0))
    across = np.sqrt(1.0 - z * z)
    return np.column_stack([across * np.cos(angle), across * np.sin(angle), z])


def _judged(plane: SymmetryPlane, probes: Floats, tree: cKDTree, radius: float) -> SymmetryPlane:
    """The plane with its misfit over some points."""
    distance = np.sort(tree.query(plane.mirrored(probes))[0])
    return SymmetryPlane(plane.normal, plane.offset, float(distance[: int(KEPT * len(probes))].mean()) / radius)


def _refined(plane: SymmetryPlane, positions: Floats, tree: cKDTree, radius: float) -> SymmetryPlane:
    """The plane moved to where each point best meets the one nearest to its mirror image."""
    for _ in range(ROUNDS):
        distance, match = nearest(tree, plane.mirrored(positions))
        kept = distance <= np.quantile(distance, KEPT)
        a, b = positions[kept], positions[match[kept]]
        cross = (a - a.mean(axis=0)).T @ (b - b.mean(axis=0))
        normal = np.linalg.eigh(cross + cross.T)[1][:, 0]
        plane = SymmetryPlane(normal, float((a.mean(axis=0) + b.mean(axis=0)) @ normal / 2.0), 0.0)
    return _judged(plane, positions, tree, radius)


def _distinct(planes: list[SymmetryPlane], count: int) -> list[SymmetryPlane]:
    """The first `count` planes that point in different directions."""
    kept: list[SymmetryPlane] = []
    for plane in planes:
        if all(abs(plane.normal @ other.normal) < SAME_COSINE for other in kept):
            kept.append(plane)
    return kept[:count]
