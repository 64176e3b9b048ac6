"""Feature points bound to a mesh, so that they follow its deformation at any mesh density."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree

from ...arrays import Bools, Floats, Ints
from ...errors import ModelError
from ...mpeg4 import FEATURE_POINTS
from ...physics.mesh import Sparse
from ...progress import Progress, Work
from .own_lip import LIP_POINTS, own_lips

#: What a caller may give for a feature point: a vertex index, or a position (3,) on the surface.
PointSource: TypeAlias = int | np.integer | Sequence[float] | Floats

#: Without these no face can be measured or moved.
REQUIRED = (
    "2.1", "2.2", "2.3", "2.4", "2.5", "2.10", "3.1", "3.2", "3.3", "3.4", "3.7", "3.8", "3.11", "3.12",
    "4.1", "4.2", "4.3", "4.4", "4.5", "4.6", "8.1", "8.2", "8.3", "8.4", "9.3", "9.15",
)  # fmt: skip

#: A position farther from every polygon than this share of the face's diagonal is kept but follows nothing.
FREE_DISTANCE = 0.02

#: Polygons round this many nearest vertices are tried when a position is bound.
NEAR_VERTICES = 24

#: Triangles whose distances differ by less than this share of that are equally near: a position on a flat quad belongs
#: to both of its splits, and is bound to their mean.
SAME_DISTANCE = 1e-9


@dataclass(frozen=True, eq=False)
class BoundPoint:
    """One feature point: weights (k,) over vertices (k,), or a free position that follows nothing."""

    name: str
    position: Floats
    vertices: Ints
    weights: Floats

    @property
    def is_bound(self) -> bool:
        """Whether the point moves with the mesh."""
        return len(self.vertices) > 0


class FeaturePoints(Mapping[str, BoundPoint]):
    """All feature points of one face: name -> BoundPoint."""

    def __init__(self, bound: Mapping[str, BoundPoint], vertex_count: int) -> None:
        self._bound = dict(bound)
        self._vertex_count = vertex_count

    def __getitem__(self, name: str) -> BoundPoint:
        return self._bound[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._bound)

    def __len__(self) -> int:
        return len(self._bound)

    def positions(self) -> dict[str, Floats]:
        """Name -> (3,) position on the neutral face, in the face's coordinates."""
        return {name: point.position for name, point in self._bound.items()}

    @property
    def nearest(self) -> dict[str, int]:
        """Feature point -> the vertex nearest to it on its polygon."""
        return {name: int(p.vertices[np.argmax(p.weights)]) for name, p in self._bound.items() if p.is_bound}

    def matrix(self, names: Sequence[str]) -> Sparse:
        """(len(names), V) matrix that reads the named points off vertex positions or displacements."""
        rows, columns, values = [], [], []
        for row, name in enumerate(names):
            point = self._bound[name]
            rows += [row] * len(point.vertices)
            columns += list(point.vertices)
            values += list(point.weights)
        return sparse.csr_array((values, (rows, columns)), shape=(len(names), self._vertex_count))


def closest_on_triangles(position: Floats, corners: Floats) -> tuple[Floats, Floats]:
    """Barycentric weights (n, 3) and distances (n,) of the points of triangles (n, 3, 3) closest to a position (3,)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, ac, ap = b - a, c - a, position - a
    d00, d01, d11 = (ab * ab).sum(1), (ab * ac).sum(1), (ac * ac).sum(1)
    d20, d21 = (ap * ab).sum(1), (ap * ac).sum(1)
    denominator = np.maximum(d00 * d11 - d01 * d01, 1e-30)
    v = (d11 * d20 - d01 * d21) / denominator
    w = (d00 * d21 - d01 * d20) / denominator
    inside = (v >= 0) & (w >= 0) & (v + w <= 1)
    best = np.column_stack([1 - v - w, v, w])
    distance = np.where(inside, np.linalg.norm((best[:, :, None] * corners).sum(1) - position, axis=1), np.inf)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        edge = corners[:, j] - corners[:, i]
        length = np.maximum((edge * edge).sum(1), 1e-30)
        t = np.clip(((position - corners[:, i]) * edge).sum(1) / length, 0.0, 1.0)
        there = np.linalg.norm(corners[:, i] + t[:, None] * edge - position, axis=1)
        weights = np.zeros((len(corners), 3))
        weights[:, i], weights[:, j] = 1 - t, t
        closer = there < distance
        best[closer], distance[closer] = weights[closer], there[closer]
    return best, distance


class _Surface:
    """Triangles that positions are bound to."""

    def __init__(self, vertices: Floats, triangles: Ints, *, reach: float = FREE_DISTANCE) -> None:
        """`reach`: how far away a position may lie, as a share of the diagonal of all vertices."""
        self._vertices, self.triangles = vertices, triangles
        self._size, self._reach = float(np.linalg.norm(np.ptp(vertices, axis=0))), reach

    def bind(self, positions: Mapping[str, Floats]) -> dict[str, BoundPoint]:
        """Bind named positions to the closest triangles; those with none within reach stay free."""
        used = np.zeros(len(self._vertices), dtype=bool)
        used[self.triangles] = True
        own = np.flatnonzero(used)
        if len(own) == 0 or len(positions) == 0:
            return {name: _free(name, position) for name, position in positions.items()}
        count = min(NEAR_VERTICES, len(own))
        _, nearest = cKDTree(self._vertices[own]).query(np.array(list(positions.values())), k=count)
        near = own[np.reshape(nearest, (len(positions), count))]
        tried = np.zeros(len(self._vertices), dtype=bool)
        tried[near] = True
        about = self.triangles[tried[self.triangles].any(axis=1)]
        bound = {}
        for (name, position), those in zip(positions.items(), near, strict=True):
            tried[:] = False
            tried[those] = True
            bound[name] = self._bound(name, position, about[tried[about].any(axis=1)])
        return bound

    def _bound(self, name: str, position: Floats, corners: Ints) -> BoundPoint:
        """A position bound to the closest of some triangles (t, 3), or free where that is beyond reach."""
        weights, distance = closest_on_triangles(position, self._vertices[corners])
        if distance.min() > self._reach * self._size:
            return _free(name, position)
        closest = distance <= distance.min() + SAME_DISTANCE * FREE_DISTANCE * self._size
        shares = np.bincount(corners[closest].ravel(), weights[closest].ravel()) / closest.sum()
        held = np.flatnonzero(shares > SAME_DISTANCE)
        return BoundPoint(name, position, held, shares[held] / shares[held].sum())


def _free(name: str, position: Floats) -> BoundPoint:
    """A position that follows nothing."""
    return BoundPoint(name, position, np.zeros(0, dtype=np.int64), np.zeros(0))


def lies_on_skin(name: str) -> bool:
    """Whether a feature point is one of skin, rather than of eyeball, tongue, teeth or spine."""
    group = name.split(".")[0]
    return group not in ("6", "7") and name not in ("3.5", "3.6", "9.8", "9.9", "9.10", "9.11", "11.5")


def bind_points(
    points: Mapping[str, PointSource], vertices: Floats, triangles: Ints, skin: Bools | None = None
) -> Work[FeaturePoints]:
    """Bind feature points to a mesh, bit by bit.

    Parameters
    ----------
    points : name ("8.4") -> vertex index, or position (3,) in the mesh's coordinates.
    vertices : (V, 3) the neutral mesh, metres.
    triangles : (T, 3) vertex indices of the triangulated mesh.
    skin : (V,) which vertices are skin; points of the skin are bound to it alone, however near a brow or tooth is.

    Raises
    ------
    ModelError : unknown names, indices outside the mesh, positions that are not finite, or required points missing.
    """
    unknown = sorted(set(points) - set(FEATURE_POINTS))
    if unknown:
        raise ModelError(f"no such feature point: {', '.join(unknown)}; the standard uses 2.1 to 11.6")
    missing = [name for name in REQUIRED if name not in points]
    if missing:
        raise ModelError(f"the face lacks the feature points {', '.join(missing)}: add them")
    anywhere = _Surface(vertices, triangles)
    on_skin = anywhere if skin is None or skin.all() else _Surface(vertices, triangles[skin[triangles].all(axis=1)])
    bound: dict[str, BoundPoint] = {}
    places: dict[str, Floats] = {}
    for name, source in points.items():
        if isinstance(source, int | np.integer):
            index = int(source)
            if not 0 <= index < len(vertices):
                raise ModelError(f"feature point {name} uses vertex {index}, but the mesh has {len(vertices)} vertices")
            bound[name] = BoundPoint(name, vertices[index].copy(), np.array([index]), np.ones(1))
            continue
        position = np.asarray(source, dtype=np.float64)
        if position.shape != (3,) or not np.isfinite(position).all():
            raise ModelError(f"feature point {name} must be a vertex index or three finite coordinates, not {source!r}")
        places[name] = position
    bound |= on_skin.bind({name: place for name, place in places.items() if lies_on_skin(name)})
    yield Progress(0.5, "Placing the feature points")
    bound |= anywhere.bind({name: place for name, place in places.items() if not lies_on_skin(name)})
    bound = {name: bound[name] for name in points}
    yield Progress(1.0, "Placing the feature points")
    return FeaturePoints(bound | _on_their_lips(bound, points, vertices, on_skin.triangles), len(vertices))


def bound_places(places: Mapping[int, Floats], vertices: Floats, triangles: Ints) -> dict[int, BoundPoint]:
    """Numbered places (3,) bound to the closest of some triangles (T, 3) between vertices (V, 3), however far it is."""
    surface = _Surface(vertices, triangles, reach=np.inf)
    bound = surface.bind({str(number): np.asarray(place) for number, place in places.items()})
    return {int(name): point for name, point in bound.items()}


def rebound(points: FeaturePoints, vertices: Floats, triangles: Ints, names: Sequence[str]) -> FeaturePoints:
    """Feature points, some of them bound to the nearest place of a part of the mesh instead.

    Parameters
    ----------
    vertices : (V, 3) the neutral mesh, in the coordinates of the points.
    triangles : (T, 3) of that part.
    names : of the points that are bound again; one that has no place within reach stays as it is.
    """
    surface = _Surface(vertices, triangles)
    given = {name: points[name].position for name in names}
    now = {**points, **{name: point for name, point in surface.bind(given).items() if point.is_bound}}
    return FeaturePoints(now | _on_their_lips(now, given, vertices, triangles), len(vertices))


def _on_their_lips(
    bound: Mapping[str, BoundPoint], points: Mapping[str, PointSource], vertices: Floats, triangles: Ints
) -> dict[str, BoundPoint]:
    """The lip points given as positions that were bound to the other lip, bound to their own."""
    middles = [bound[name] for name in ("8.1", "8.2")]
    given = [name for names in LIP_POINTS for name in names if np.ndim(points.get(name, 0)) > 0]
    if not given or not all(point.is_bound for point in middles):
        return {}
    upper, lower = (int(point.vertices[np.argmax(point.weights)]) for point in middles)
    off = [bound[name].position - (middles[0].position + middles[1].position) / 2.0 for name in given]
    size = float(np.linalg.norm(off, axis=1).max())
    sides = own_lips(vertices, triangles, upper, lower, size)
    again: dict[str, BoundPoint] = {}
    for own, other, names in zip(sides, sides[::-1], LIP_POINTS, strict=True):
        wrong = [name for name in names if name in given and bound[name].weights @ other[bound[name].vertices] > 0.5]
        if wrong:
            surface = _Surface(vertices, triangles[own[triangles].all(axis=1)])
            again |= surface.bind({name: bound[name].position for name in wrong})
    return again


def check_sides(points: Mapping[str, Floats]) -> None:
    """Refuse feature points whose left and right, upper and lower, or all left and all right ones, are swapped.

    Parameters
    ----------
    points : name -> (3,) position in head space.

    Raises
    ------
    ModelError : names the first wrong pair and the remedy.
    """
    if points["9.3"][2] <= (points["8.3"][2] + points["8.4"][2]) / 2.0:
        raise ModelError(
            "all left and right feature points are swapped, or the nose tip 9.3 is wrong (behind the mouth); "
            "8.3, 3.7 and 4.1 must be on the subject's left (the viewer's right)"
        )
    for left, right in (
        ("8.3", "8.4"),
        ("3.7", "3.12"),
        ("3.11", "3.8"),
        ("2.4", "2.5"),
        ("4.1", "4.2"),
        ("4.5", "4.6"),
    ):
        if points[left][0] <= points[right][0]:
            raise ModelError(
                f"feature points {left} and {right} are swapped: {left} must be on the subject's left "
                "(the viewer's right)"
            )
    for upper, lower in (
        ("3.1", "3.3"),
        ("3.2", "3.4"),
        ("8.1", "8.2"),
        ("9.3", "8.1"),
        ("8.2", "2.1"),
        ("4.3", "3.1"),
    ):
        if points[upper][1] <= points[lower][1]:
            raise ModelError(f"feature points {upper} and {lower} are swapped: {upper} must be above {lower}")
