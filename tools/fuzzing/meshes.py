"""Meshes that nobody would model and somebody will import: the default head with one damage after another."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import risorius.api as api
from risorius.face.mesh.parts import Part
from scipy.spatial.transform import Rotation


@dataclass(frozen=True)
class Damaged:
    """A mesh with its feature points as vertices or places, and parts."""

    vertices: np.ndarray
    polygons: list[tuple[int, ...]]
    points: dict[str, object]
    parts: np.ndarray | None


def sound() -> Damaged:
    """The default head as it is; points as places, so that any mesh may stand below them."""
    head, face = api.build_default_head(), api.default_face()
    points: dict[str, object] = {name: np.array(point.position) for name, point in face.points.items()}
    return Damaged(np.array(head.vertices), [tuple(map(int, p)) for p in head.polygons], points, np.array(head.parts))


def mask(mesh: Damaged) -> Damaged:
    """The front half of a head, with a border behind the ears: a face takes two thirds of the time with it."""
    kept = (mesh.parts != Part.SKIN) | (mesh.vertices[:, 1] < 0.0)
    polygons = [polygon for polygon in mesh.polygons if kept[list(polygon)].all()]
    used = np.unique(np.concatenate(polygons))
    number = np.zeros(len(mesh.vertices), dtype=np.int64)
    number[used] = np.arange(len(used))
    parts = None if mesh.parts is None else mesh.parts[used]
    return Damaged(mesh.vertices[used], [tuple(number[list(p)].tolist()) for p in polygons], mesh.points, parts)


def _moved(mesh: Damaged, change: Callable[[np.ndarray], np.ndarray]) -> Damaged:
    points = {name: change(np.asarray(place)[None])[0] for name, place in mesh.points.items()}
    return replace(mesh, vertices=change(mesh.vertices), points=points)


def scaled(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """In another unit: from a ten-thousandth to ten thousand times the size."""
    factor = 10.0 ** draw.uniform(-4.0, 4.0)
    return _moved(mesh, lambda places: places * factor)


def far(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Far from the origin, by up to ten thousand times its size."""
    size = np.ptp(mesh.vertices[np.isfinite(mesh.vertices).all(axis=1)], axis=0).max()
    shift = size * 10.0 ** draw.uniform(0.0, 4.0) * draw.normal(size=3)
    return _moved(mesh, lambda places: places + shift)


def turned(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Whichever way it looks."""
    rotation = Rotation.random(rng=draw) if "rng" in Rotation.random.__doc__ else Rotation.random(random_state=draw)
    return _moved(mesh, rotation.apply)


def mirrored(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """By a negative scale: inside out, with left and right changed, or on its head."""
    factors = np.ones(3)
    factors[draw.integers(3)] = -1.0
    return _moved(mesh, lambda places: places * factors)


def shuffled(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Vertices, polygons and the corners of each in another order."""
    order = draw.permutation(len(mesh.vertices))
    number = np.empty_like(order)
    number[order] = np.arange(len(order))
    turned = []
    for place in draw.permutation(len(mesh.polygons)):
        corners = number[list(mesh.polygons[place])].tolist()
        first = int(draw.integers(len(corners)))
        turned.append((*corners[first:], *corners[:first]))
    parts = None if mesh.parts is None else mesh.parts[order]
    return replace(mesh, vertices=mesh.vertices[order], polygons=turned, parts=parts)


def degenerate(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Polygons that name a vertex twice, or lie in a line."""
    polygons = list(mesh.polygons)
    for n in draw.integers(len(polygons), size=40):
        polygons[n] = (*polygons[n][:2], polygons[n][draw.integers(2)], *polygons[n][3:])
    vertices = mesh.vertices.copy()
    for n in draw.integers(len(polygons), size=40):
        a, b, c = polygons[n][:3]
        vertices[c] = 0.5 * (vertices[a] + vertices[b])
    return replace(mesh, vertices=vertices, polygons=polygons)


def collapsed(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Vertices where their neighbours are."""
    vertices = mesh.vertices.copy()
    for n in draw.integers(len(mesh.polygons), size=int(draw.choice([5, 200, 2000]))):
        vertices[list(mesh.polygons[n])] = vertices[mesh.polygons[n][0]]
    return replace(mesh, vertices=vertices)


def doubled(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Polygons that have vertices of their own where their neighbours' are: some of them, or all."""
    chosen = draw.random(len(mesh.polygons)) < draw.choice([0.01, 0.3, 1.0])
    vertices, parts, polygons = [mesh.vertices], [mesh.parts], []
    count = len(mesh.vertices)
    for polygon, own in zip(mesh.polygons, chosen, strict=True):
        if own:
            vertices.append(mesh.vertices[list(polygon)])
            parts.append(None if mesh.parts is None else mesh.parts[list(polygon)])
            polygons.append(tuple(range(count, count + len(polygon))))
            count += len(polygon)
        else:
            polygons.append(polygon)
    return replace(
        mesh,
        vertices=np.concatenate(vertices),
        polygons=polygons,
        parts=None if mesh.parts is None else np.concatenate(parts),  # type: ignore[arg-type]
    )


def loose(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Vertices without a polygon, and pieces that touch nothing."""
    reach = np.abs(mesh.vertices).max() if len(mesh.vertices) else 1.0
    more = draw.normal(scale=reach * 10.0 ** draw.uniform(-3.0, 2.0), size=(60, 3))
    first = len(mesh.vertices)
    pieces = [tuple(first + 3 * n + np.arange(3)) for n in range(10)]
    parts = None if mesh.parts is None else np.concatenate([mesh.parts, draw.integers(0, 7, size=60)])
    return replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, more]),
        polygons=[*mesh.polygons, *(tuple(map(int, piece)) for piece in pieces)],
        parts=parts,
    )


def holed(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Polygons are missing: a few, or most."""
    kept = draw.random(len(mesh.polygons)) > draw.choice([0.002, 0.05, 0.7])
    return replace(mesh, polygons=[polygon for polygon, there in zip(mesh.polygons, kept, strict=True) if there])


def many_cornered(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Neighbours merged to polygons of more corners, and others cut to triangles."""
    polygons = []
    for polygon in mesh.polygons:
        how = draw.random()
        if how < 0.3 and len(polygon) == 4:
            polygons += [polygon[:3], (polygon[0], polygon[2], polygon[3])]
        elif how < 0.31 and polygons:
            polygons[-1] = (*polygons[-1], *(corner for corner in polygon if corner not in polygons[-1]))
        else:
            polygons.append(polygon)
    return replace(mesh, polygons=polygons)


def non_manifold(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Polygons that are there twice, turned over, or the third at an edge."""
    polygons = list(mesh.polygons)
    for n in draw.integers(len(polygons), size=60):
        how = draw.integers(3)
        if how == 0:
            polygons.append(polygons[n])
        elif how == 1:
            polygons[n] = polygons[n][::-1]
        else:
            polygons.append((*polygons[n][:2], int(draw.integers(len(mesh.vertices)))))
    return replace(mesh, polygons=polygons)


def squashed(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Flat, or nearly so."""
    factors = np.ones(3)
    factors[draw.integers(3)] = draw.choice([0.0, 1e-9, 1e-3, 0.2])
    return _moved(mesh, lambda places: places * factors)


def poisoned(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Coordinates that are no numbers, or no coordinates."""
    vertices = mesh.vertices.copy()
    vertices[draw.integers(len(vertices)), draw.integers(3)] = draw.choice([np.nan, np.inf, -np.inf, 1e308, -1e200])
    return replace(mesh, vertices=vertices)


def partless(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Nobody says what is skin."""
    return replace(mesh, parts=None)


def misplaced(mesh: Damaged, draw: np.random.Generator) -> Damaged:
    """Feature points beside their places, at one place, changed for one another, or missing."""
    names, points = list(mesh.points), dict(mesh.points)
    size = np.ptp(np.array([*mesh.points.values()], dtype=float), axis=0).max()
    for name in draw.choice(names, size=4, replace=False):
        how = draw.integers(4)
        other = str(draw.choice(names))
        if how == 0:
            points[name] = np.asarray(points[name]) + draw.normal(scale=0.05 * size, size=3)
        elif how == 1 and other in points:
            points[name] = points[other]
        elif how == 2 and other in points:
            points[name], points[other] = points[other], points[name]
        elif how == 3:
            points.pop(name, None)
    return replace(mesh, points=points)


DAMAGES = (
    scaled, far, turned, mirrored, shuffled, degenerate, collapsed, doubled, loose, holed, many_cornered, non_manifold,
    squashed, poisoned, partless, misplaced,
)  # fmt: skip
