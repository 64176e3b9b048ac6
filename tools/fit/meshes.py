"""The same head as another mesh: coarser, finer, torn into triangles, cut, or posed on its body."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from risorius.arrays import Bools, Floats, Ints

from .heads import TrueHead

#: Shares of the polygons that get a fin, a twin, or are turned inside out; length of the fins, metres.
FINS, TWINS, TURNED, FIN = 0.01, 0.01, 0.03, 6e-3
#: Noise of a scan, metres.
SCAN_NOISE = 0.2e-3


def triangles_of(head: TrueHead) -> Ints:
    """(T, 3) fans of the polygons."""
    fans = [(polygon[0], polygon[k], polygon[k + 1]) for polygon in head.polygons for k in range(1, len(polygon) - 1)]
    return np.array(fans, dtype=np.int64)


def coarse(head: TrueHead, cell: float) -> TrueHead:
    """A head whose vertices within each cell of a grid, metres wide, are one."""
    cells = np.floor(head.vertices / cell).astype(np.int64)
    _, same = np.unique(cells, axis=0, return_inverse=True)
    same = same.ravel()
    count = np.bincount(same)
    vertices = np.column_stack([np.bincount(same, head.vertices[:, k]) / count for k in range(3)])
    kept = [triangle for triangle in same[triangles_of(head)].tolist() if len(set(triangle)) == 3]
    return replace(head, name=f"{head.name}, {len(vertices)} vertices", vertices=vertices, polygons=kept)


def subdivided(head: TrueHead) -> TrueHead:
    """A head with every polygon cut into four from its middle and those of its sides."""
    sizes = np.array([len(polygon) for polygon in head.polygons])
    corners = np.concatenate([np.asarray(polygon, dtype=np.int64) for polygon in head.polygons])
    starts = np.cumsum(sizes) - sizes
    places = np.arange(len(corners)) - np.repeat(starts, sizes)
    after = corners[np.repeat(starts, sizes) + (places + 1) % np.repeat(sizes, sizes)]
    sides, side = np.unique(np.sort(np.column_stack([corners, after]), axis=1), axis=0, return_inverse=True)
    side = len(head.vertices) + side.ravel()
    before = side[np.repeat(starts, sizes) + (places - 1) % np.repeat(sizes, sizes)]
    centres = np.add.reduceat(head.vertices[corners], starts) / sizes[:, None]
    vertices = np.concatenate([head.vertices, head.vertices[sides].mean(axis=1), centres])
    centre = len(head.vertices) + len(sides) + np.repeat(np.arange(len(sizes)), sizes)
    name = f"{head.name.split(',')[0]}, {len(vertices):,} vertices"
    return replace(head, name=name, vertices=vertices, polygons=list(np.column_stack([corners, side, centre, before])))


def soup(head: TrueHead, seed: int = 1) -> TrueHead:
    """A head of triangles that share no vertex, with the noise of a scanner."""
    noise = np.random.default_rng(seed).normal(scale=SCAN_NOISE, size=head.vertices.shape)
    triangles = triangles_of(head)
    vertices = (head.vertices + noise)[triangles.ravel()]
    name = f"{head.name.split(',')[0]}, {len(vertices):,} unwelded vertices"
    return replace(head, name=name, vertices=vertices, polygons=list(np.arange(len(vertices)).reshape(-1, 3)))


def not_manifold(head: TrueHead, seed: int = 1) -> TrueHead:
    """A head with fins on its edges, doubled polygons, some turned inside out, and vertices that belong to none."""
    random = np.random.default_rng(seed)
    polygons = [tuple(int(corner) for corner in polygon) for polygon in head.polygons]
    count = len(polygons)
    for index in random.choice(count, int(TURNED * count), replace=False):
        polygons[index] = polygons[index][::-1]
    polygons += [polygons[index] for index in random.choice(count, int(TWINS * count), replace=False)]
    finned = [polygons[index] for index in random.choice(count, int(FINS * count), replace=False)]
    tips = np.array([head.vertices[polygon[0]] for polygon in finned])
    tips += random.normal(scale=FIN, size=tips.shape)
    polygons += [(*polygon[:2], len(head.vertices) + k) for k, polygon in enumerate(finned)]
    loose = head.vertices.mean(axis=0) + random.normal(scale=0.1, size=(50, 3))
    vertices = np.concatenate([head.vertices, tips, loose])
    return replace(head, name=f"{head.name}, not manifold", vertices=vertices, polygons=polygons)


def cut(head: TrueHead, name: str, keep: Callable[[Floats], Bools]) -> TrueHead:
    """The polygons whose vertices (V, 3) a rule keeps, and the points that it keeps."""
    kept = keep(head.vertices)
    polygons = [polygon for polygon in head.polygons if kept[np.asarray(polygon)].all()]
    used = np.unique(np.concatenate([np.asarray(polygon) for polygon in polygons]))
    number = np.full(len(head.vertices), -1)
    number[used] = np.arange(len(used))
    points = {key: place for key, place in head.points.items() if keep(place[None])[0]}
    return TrueHead(name, head.vertices[used], [number[np.asarray(polygon)] for polygon in polygons], points)


def bust(body: TrueHead) -> TrueHead:
    """Head, neck and shoulders of a body that stands along +Z."""
    chin = body.points["2.1"][2]
    return cut(body, "bust", lambda places: places[:, 2] > chin - 0.22)


def face_mask(head: TrueHead) -> TrueHead:
    """The front of a face, without ears and the back of the head."""
    nose = head.points["9.3"]
    return cut(head, f"{head.name}, face mask", lambda places: places[:, 1] < nose[1] + 0.075)


def turned_head(body: TrueHead, yaw: float, pitch: float = 0.0) -> TrueHead:
    """A body whose head is turned to its left and down, degrees; the neck twists along."""
    chin, ear = body.points["2.1"], body.points["10.7"]
    pivot = np.array([0.0, ear[1] + 0.02, chin[2] - 0.045])

    def posed(places: Floats) -> Floats:
        share = np.clip((places[:, 2] - pivot[2] + 0.05) / 0.09, 0.0, 1.0)
        turned = _turn(places - pivot, np.radians(pitch) * share, axis=0)
        return pivot + _turn(turned, np.radians(yaw) * share, axis=2)

    points = {key: posed(place[None])[0] for key, place in body.points.items()}
    said = f"body, head turned {yaw:.0f}°" + (f", lowered {pitch:.0f}°" if pitch else "")
    return TrueHead(said, posed(body.vertices), body.polygons, points)


def t_pose(body: TrueHead, *, shoulder: float = 0.17, height: float = 0.49, angle: float = 50.0) -> TrueHead:
    """A body with its arms stretched out: shoulders at half their distance and their height, metres; degrees."""
    places = body.vertices.copy()
    for side in (-1.0, 1.0):
        away = side * places[:, 0] - shoulder
        share = np.where(places[:, 2] > 0.0, np.clip(away / 0.06 + 0.5, 0.0, 1.0), 0.0)
        pivot = np.array([side * shoulder, 0.0, height])
        places = pivot + _turn(places - pivot, -side * np.radians(angle) * share, axis=1)
    return replace(body, name="body, T-pose", vertices=places)


def _turn(places: Floats, angles: Floats, *, axis: int) -> Floats:
    """Places (V, 3) turned about an axis by angles (V,), radians."""
    a, b = (axis + 1) % 3, (axis + 2) % 3
    turned = places.copy()
    turned[:, a] = np.cos(angles) * places[:, a] - np.sin(angles) * places[:, b]
    turned[:, b] = np.sin(angles) * places[:, a] + np.cos(angles) * places[:, b]
    return turned
