"""What shows of a mesh whose modifiers make other polygons of it, and the resting place of each of its vertices.

Blender can carry every vertex's resting place through shape keys and modifiers (`Object.add_rest_position_attribute`):
so a place of the resting surface is found again on what a Subdivision Surface makes of it, however it is posed.
"""

from __future__ import annotations

import hashlib
from collections import OrderedDict
from dataclasses import dataclass

import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

from ...arrays import Floats
from ..attributes import read_vectors
from ..blender_types import Mesh, Object, SearchTree
from ..mesh import basis_vertices, rest_vertices, triangle_corners
from .bound import Held, shares

#: The name that Blender gives it.
REST = "rest_position"
#: Building one takes a moment, and every redraw asks: so many are kept.
KEPT = 2
#: A place between vertices is moved by shape keys as so many of the nearest ones are.
NEAR = 4
_kept: OrderedDict[bytes, Carried] = OrderedDict()


@dataclass(frozen=True, eq=False)
class Carried:
    """The resting places of the vertices that show: (V', 3), the triangles between them, and a tree to look them up."""

    rest: Floats
    triangles: list[tuple[int, int, int]]
    tree: SearchTree

    @classmethod
    def of(cls, shown: Mesh, of: Mesh) -> Carried | None:
        """Of an evaluated mesh and the mesh that it is `of`; None where Blender carries none along."""
        rest = read_vectors(shown, REST)
        if rest is None:
            return None
        rest = _mixed(rest, of)
        corners = triangle_corners(shown)
        name = hashlib.blake2b(rest.tobytes() + corners.tobytes(), digest_size=16).digest()
        carried = _kept.pop(name, None)
        if carried is None:
            triangles = [(int(a), int(b), int(c)) for a, b, c in corners]
            carried = cls(rest, triangles, BVHTree.FromPolygons(rest.tolist(), triangles, all_triangles=True))
        _kept[name] = carried
        while len(_kept) > KEPT:
            _kept.popitem(last=False)
        return carried

    def held(self, rest: Floats) -> Held | None:
        """Vertices of what shows, and their shares, for the resting place nearest to `rest` (3,)."""
        found, _, triangle, _ = self.tree.find_nearest(Vector(rest))
        return None if found is None else shares(self.triangles[triangle], self.rest, np.array(found))


def _mixed(places: Floats, mesh: Mesh) -> Floats:
    """Places (V', 3) of the Basis, which Blender carries, as those of the resting face that shape keys make of it."""
    basis, rest = basis_vertices(mesh), rest_vertices(mesh)
    if np.array_equal(basis, rest):
        return places
    from scipy.spatial import cKDTree

    found, near = cKDTree(basis).query(places, k=min(NEAR, len(basis)))
    distance: Floats = np.asarray(found, dtype=np.float64)
    weights = 1.0 / (distance + distance.mean() * 1e-6 + 1e-30)
    moved = ((rest - basis)[near] * (weights / weights.sum(axis=1, keepdims=True))[..., None]).sum(axis=1)
    return np.asarray(places + moved)


def carry_rest(obj: Object) -> None:
    """Let Blender carry the resting places through the modifiers of `obj`, where it may be written to."""
    if obj.library is None and not obj.add_rest_position_attribute:
        obj.add_rest_position_attribute = True
