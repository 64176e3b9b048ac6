"""Places on the visible surface of an object: what a ray hits, where feature points show, and which are hidden."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from mathutils import Vector

from ...arrays import Bools, Floats
from .. import mesh as meshes
from ..blender_types import Depsgraph, Object
from .bound import Surface, places, shares
from .carried import Carried
from .kept import KeptPoints

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

    obj: Object
    shown: Object

    @classmethod
    def of(cls, obj: Object, depsgraph: Depsgraph) -> Visible:
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
        return self._shown_vertices

    def hit(self, origin: Floats, direction: Floats, surface: Surface) -> Floats | None:
        """(3,) place on the resting surface under a ray of the world, in the mesh's own coordinates; None beside it."""
        inverse = np.linalg.inv(meshes.world_matrix(self.obj))
        start, way = inverse[:3, :3] @ origin + inverse[:3, 3], inverse[:3, :3] @ direction
        found, place, _, polygon = self.shown.ray_cast(Vector(start), Vector(way))
        if not found:
            return None
        if self.same_polygons:
            corners = tuple(self.obj.data.polygons[polygon].vertices)
            held, weights = shares(corners, self.vertices, np.array(place))
            rest: Floats = np.array(weights) @ surface.vertices[list(held)]
            return rest
        if self._carried is not None:
            corners = tuple(self.shown.data.polygons[polygon].vertices)
            held, weights = shares(corners, self._shown_vertices, np.array(place))
            place = (np.array(weights) @ self._carried.rest[list(held)]).tolist()
        near = surface.nearest(np.array(place))
        return None if near is None else near[0]

    def shown_place(self, rest: Floats, surface: Surface) -> Floats:
        """(3,) where a place of the resting surface shows, in the mesh's own coordinates."""
        if not self.same_polygons:
            return self._on_shown(rest)
        held = surface.bound(rest, np.inf)
        if held is None:
            return rest
        shown: Floats = np.array(held[1]) @ self.vertices[list(held[0])]
        return shown

    def places(self, kept: KeptPoints) -> dict[str, Floats]:
        """Name -> (3,) where points show, in the world."""
        world = meshes.world_matrix(self.obj)
        there = places(kept, self.vertices)
        if not self.same_polygons:
            there = self._all_on_shown(kept, there)
        return {n: world[:3, :3] @ p + world[:3, 3] for n, p in there.items()}

    @cached_property
    def _carried(self) -> Carried | None:
        """The resting places of what shows, where Blender carries them along."""
        return Carried.of(self.shown.data, self.obj.data)

    @cached_property
    def _shown_vertices(self) -> Floats:
        """(V', 3) vertices of what shows."""
        return meshes.mesh_vertices(self.shown.data)

    def _all_on_shown(self, kept: KeptPoints, rest: dict[str, Floats]) -> dict[str, Floats]:
        """Where resting places show on other polygons; those off the surface move as the others on the whole."""
        bound = [name for name in rest if kept.points[name].is_bound]
        shown = {name: self._on_shown(rest[name]) for name in bound}
        if not bound:
            return rest
        was, now = np.array([rest[name] for name in bound]), np.array([shown[name] for name in bound])
        turn = np.linalg.lstsq(was - was.mean(axis=0), now - now.mean(axis=0), rcond=1e-6)[0]
        moved = {name: now.mean(axis=0) + (place - was.mean(axis=0)) @ turn for name, place in rest.items()}
        return {name: shown.get(name, moved[name]) for name in rest}

    def _on_shown(self, rest: Floats) -> Floats:
        """(3,) where a resting place shows on other polygons: carried along, or else the nearest place."""
        held = None if self._carried is None else self._carried.held(rest)
        if held is not None:
            shown: Floats = np.array(held[1]) @ self._shown_vertices[list(held[0])]
            return shown
        found, near, _, _ = self.shown.closest_point_on_mesh(Vector(rest))
        return np.array(near, dtype=np.float64) if found else rest

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
        inverse = np.linalg.inv(meshes.world_matrix(self.obj))
        behind = []
        for place in all_places:
            way = (eye - place) if eye is not None else towards
            way = way / np.linalg.norm(way)
            start = inverse[:3, :3] @ (place + before * way) + inverse[:3, 3]
            behind.append(bool(self.shown.ray_cast(Vector(start), Vector(inverse[:3, :3] @ way))[0]))
        return np.array(behind, dtype=bool)
