"""Places on the visible surface of an object: what a ray hits, where feature points show, and which are hidden."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from mathutils import Vector

from ..arrays import Bools, Floats
from . import mesh as meshes
from .points_bound import Surface, places, shares
from .points_kept import KeptPoints

#: How far before the surface a point is looked at from, as a share of the diagonal of all points.
BEFORE = 1.2e-2


@dataclass(frozen=True)
class Visible:
    """An object as it shows now: shape keys, modifiers and pose applied. Make a new one whenever that may have changed.

    Attributes
    ----------
    obj : the object.
    shown : the same, evaluated.
    """

    obj: Any
    shown: Any

    @classmethod
    def of(cls, obj: Any, depsgraph: Any) -> Visible:
        """As it shows in `depsgraph`."""
        return cls(obj, obj.evaluated_get(depsgraph))

    @property
    def same_polygons(self) -> bool:
        """Whether what shows has the polygons of the mesh itself."""
        mesh = self.shown.data
        return len(mesh.polygons) == len(self.obj.data.polygons) and len(mesh.vertices) == len(self.obj.data.vertices)

    @cached_property
    def vertices(self) -> Floats:
        """(V, 3) vertices of the mesh as they show; at rest where modifiers make other polygons of them."""
        if not self.same_polygons:
            return meshes.rest_vertices(self.obj.data)
        flat = np.empty(3 * len(self.shown.data.vertices), dtype=np.float32)
        self.shown.data.vertices.foreach_get("co", flat)
        return flat.astype(np.float64).reshape(-1, 3)

    def hit(self, origin: Floats, direction: Floats, surface: Surface) -> Floats | None:
        """(3,) place on the resting surface under a ray of the world, in the mesh's own coordinates; None beside it."""
        inverse = np.linalg.inv(np.array(self.obj.matrix_world))
        start, way = inverse[:3, :3] @ origin + inverse[:3, 3], inverse[:3, :3] @ direction
        found, place, _, polygon = self.shown.ray_cast(Vector(start), Vector(way))
        if not found:
            return None
        if not self.same_polygons:
            near = surface.nearest(np.array(place))
            return None if near is None else near[0]
        held, weights = shares(surface.polygons[polygon], self.vertices, np.array(place))
        rest: Floats = np.array(weights) @ surface.vertices[list(held)]
        return rest

    def shown_place(self, rest: Floats, surface: Surface) -> Floats:
        """(3,) where a place of the resting surface shows, in the mesh's own coordinates."""
        held = surface.bound(rest, np.inf)
        if held is None or not self.same_polygons:
            return rest
        shown: Floats = np.array(held[1]) @ self.vertices[list(held[0])]
        return shown

    def places(self, kept: KeptPoints) -> dict[str, Floats]:
        """Name -> (3,) where points show, in the world."""
        world = np.array(self.obj.matrix_world)
        return {n: world[:3, :3] @ p + world[:3, 3] for n, p in places(kept, self.vertices).items()}

    def hidden(self, world_places: dict[str, Floats], eye: Floats | None, towards: Floats) -> Bools:
        """(n,) which places lie behind the surface.

        Parameters
        ----------
        eye : (3,) where it is looked at from; None for a view without perspective.
        towards : (3,) direction from the surface to the viewer, for such a view.
        """
        if not world_places:
            return np.zeros(0, dtype=bool)
        all_places = np.array(list(world_places.values()))
        before = BEFORE * float(np.linalg.norm(np.ptp(all_places, axis=0)))
        inverse = np.linalg.inv(np.array(self.obj.matrix_world))
        behind = []
        for place in all_places:
            way = (eye - place) if eye is not None else towards
            way = way / np.linalg.norm(way)
            start = inverse[:3, :3] @ (place + before * way) + inverse[:3, 3]
            behind.append(bool(self.shown.ray_cast(Vector(start), Vector(inverse[:3, :3] @ way))[0]))
        return np.array(behind, dtype=bool)
