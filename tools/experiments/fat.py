"""Fat between dermis and fascia: a prism under every triangle of skin, small strains, almost incompressible.

Shear is integrated at six points of a prism; volume is kept by one mean dilatation per prism, so that fat that keeps
its volume does not lock (B-bar: T. J. R. Hughes, Int. J. Numer. Methods Eng. 15:1413-1418, 1980).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from risorius.arrays import Floats, Ints
from risorius.errors import ModelError
from risorius.face.mesh.template import MM
from risorius.face.skin.outer import OuterSkin, smoothstep
from risorius.physics.mesh import Sparse, triangulate
from risorius.tables import read_csv
from scipy import sparse

DEPTHS = Path(__file__).with_name("soft_tissue_depth.csv")

#: Least depth of fat, and depth of a lid over the eyeball, metres.
THINNEST = 0.5 * MM
LID_DEPTH = 1.5 * MM

#: A prism keeps at least this share of the volume that it would have on a flat face; else the fascia lies less deep.
LEAST_VOLUME = 0.1

#: Triangles turned further than this (cosine) from the lie of the bone have no fat: nostrils, folds of the ear.
STEEPEST = 0.25

#: Steps in which fat is made shallower until no prism folds over, and what a step leaves of its depth.
SHALLOWER_STEPS, SHALLOWER = 25, 0.75


def near_lids(skin: OuterSkin) -> Floats:
    """(n,) 1 within 6 mm of a lid's edge, 0 beyond 16 mm."""
    return 1.0 - smoothstep((skin.lid_edge_distance - 6 * MM) / (10 * MM))


def soft_tissue_depth(skin: OuterSkin) -> Floats:
    """(n,) depth of soft tissue, metres: the table's places weighed by inverse squared distance; lids are thin.

    Raises
    ------
    ModelError : a face without any of the table's feature points.
    """
    rows = read_csv(DEPTHS, "feature_points", "depth")
    known = [row for row in rows if all(name in skin.points for name in row.texts("feature_points"))]
    if not known:
        raise ModelError("the face has none of the feature points of soft_tissue_depth.csv: give some")
    places = np.array([np.mean([skin.points[n] for n in row.texts("feature_points")], axis=0) for row in known])
    depths = np.array([row.number("depth") * MM for row in known])
    away = ((skin.positions[:, None] - places) ** 2).sum(axis=2)
    weight = 1.0 / (away + (4 * MM) ** 2) ** 1.5
    lid = near_lids(skin)
    return np.asarray((weight @ depths) / weight.sum(axis=1) * (1.0 - lid) + LID_DEPTH * lid)


def _prism_corners(skin: OuterSkin, triangles: Ints, depth: Floats) -> Floats:
    """(t, 6, 3) corners of the prism under every triangle: its outer corners, then its inner ones."""
    inner = skin.positions - depth[:, None] * skin.normals
    return np.concatenate([skin.positions[triangles], inner[triangles]], axis=1)


#: Places in the triangle and through the depth that a prism is integrated at, each with a twelfth of the reference
#: volume (edge middles are exact for quadratics).
_PLANE = ((0.5, 0.0), (0.0, 0.5), (0.5, 0.5))
_THROUGH = (-1 / np.sqrt(3.0), 1 / np.sqrt(3.0))


def _slopes(corners: Floats) -> tuple[Floats, Floats]:
    """At each integration point gradients (6, t, 6, 3) of the corners' shape functions, and its volumes (6, t)."""
    gradients, volumes = [], []
    for r, s in _PLANE:
        area = np.array([1 - r - s, r, s])
        for z in _THROUGH:
            upper, lower = (1 + z) / 2, (1 - z) / 2
            flat = np.array([[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]])
            local = np.concatenate(
                [np.column_stack([flat * upper, area / 2]), np.column_stack([flat * lower, -area / 2])]
            )
            jacobian = np.einsum("tia,ib->tba", corners, local)
            gradients.append(np.einsum("tab,ib->tia", np.linalg.inv(jacobian), local))
            volumes.append(np.linalg.det(jacobian) / 6.0)
    return np.array(gradients), np.array(volumes)


def filled(skin: OuterSkin) -> Ints:
    """(t, 3) triangles with fat under them."""
    triangles = triangulate(skin.polygons)
    corners = skin.positions[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-18)
    upright = (normal[:, None] * skin.normals[triangles]).sum(axis=2).min(axis=1)
    return np.asarray(triangles[upright > STEEPEST])


def fat_depth(skin: OuterSkin, wanted: Floats) -> Floats:
    """(n,) wanted depths made shallower where the skin curves too much for them, metres."""
    depth = np.maximum(wanted, THINNEST)
    triangles = filled(skin)
    edges = skin.positions[triangles]
    areas = np.linalg.norm(np.cross(edges[:, 1] - edges[:, 0], edges[:, 2] - edges[:, 0]), axis=1) / 2.0
    for _ in range(SHALLOWER_STEPS):
        volumes = _slopes(_prism_corners(skin, triangles, depth))[1]
        flat = areas * depth[triangles].mean(axis=1) / len(volumes)
        bad = (volumes < LEAST_VOLUME * flat).any(axis=0)
        if not bad.any():
            break
        depth[np.unique(triangles[bad])] *= SHALLOWER
    return np.asarray(depth)


def fat_matrix(skin: OuterSkin, depth: Floats, shear: float, poisson: float) -> Sparse:
    """(6n, 6n) stiffness of the fat, N/m; unknowns by node (dermis, then fascia) and axis."""
    triangles = filled(skin)
    gradients, volumes = _slopes(_prism_corners(skin, triangles, depth))
    bulk = 2.0 * shear * (1.0 + poisson) / (3.0 * (1.0 - 2.0 * poisson))
    total = volumes.sum(axis=0)
    stiffness = np.zeros((len(triangles), 6, 3, 6, 3))
    for slope, volume in zip(gradients, volumes, strict=True):
        weighed = slope * (shear * volume)[:, None, None]
        same = np.einsum("tia,tja->tij", weighed, slope)
        for axis in range(3):
            stiffness[:, :, axis, :, axis] += same
        stiffness += np.einsum("tib,tja->tiajb", weighed, slope)
        stiffness -= 2.0 / 3.0 * np.einsum("tia,tjb->tiajb", weighed, slope)
    mean = np.einsum("gtia,gt->tia", gradients, volumes) / total[:, None, None]
    stiffness += np.einsum("tia,tjb->tiajb", mean * (bulk * total)[:, None, None], mean)
    nodes = np.concatenate([triangles, triangles + skin.vertex_count], axis=1)
    unknowns = (3 * nodes[:, :, None] + np.arange(3)).reshape(len(triangles), 18).astype(np.int32)
    rows = np.repeat(unknowns, 18, axis=1).ravel()
    columns = np.tile(unknowns, (1, 18)).ravel()
    size = 6 * skin.vertex_count
    return sparse.coo_array((stiffness.ravel(), (rows, columns)), shape=(size, size)).tocsr()
