"""Feature points of a face that was joined into another object (Ctrl J).

Blender keeps the other object's mesh, and with it the other's points. The face's own mesh stays in the file, used by
nothing, until the file is saved and opened again: as long as it is there, its points can be put where its polygons are
now.
"""

from __future__ import annotations

import bpy
import numpy as np

from ...arrays import Floats, Ints
from ...errors import SceneError
from .. import mesh as meshes
from ..blender_types import Mesh, Object
from .bound import bind, followed, places
from .kept import POINTS, Origin, has_points, read_kept_with, triple, write_kept

#: Vertices that do not lie where an affine motion puts them, as a share of the mesh's size, are another mesh's.
SAME = 1e-4
#: So many corners are compared before all are.
FIRST = 64


def may_be_joined(obj: Object) -> list[Mesh]:
    """Meshes with points that nothing uses any more and that `obj`, without points, has room for. Cheap to ask."""
    if has_points(obj):
        return []
    return [m for m in bpy.data.meshes if m.users == 0 and POINTS in m and len(m.polygons) <= len(obj.data.polygons)]


def take_over_points(obj: Object) -> str:
    """Give `obj` the points of the face that was joined into it; returns the name of that face's mesh.

    Raises
    ------
    SceneError : no such face is left, or not in this mesh.
    """
    for mesh in may_be_joined(obj):
        block = _block_of(mesh, obj.data)
        if block is None:
            continue
        was, now = meshes.rest_vertices(mesh), meshes.rest_vertices(obj.data)[block]
        motion = _motion(was, now)
        if motion is None:
            continue
        kept = followed(read_kept_with(mesh, mesh.name), mesh).kept
        table = {n: triple(np.append(place, 1.0) @ motion) for n, place in places(kept, was).items()}
        origins: dict[str, Origin] = {name: point.origin for name, point in kept.points.items()}
        sure = {name: point.confidence for name, point in kept.points.items()}
        write_kept(obj, bind(obj.data, table, origins=origins, confidence=sure), as_given=True)
        return str(mesh.name)
    raise SceneError(obj.name, "contains no face whose points can be restored: press Find Face")


def _block_of(part: Mesh, whole: Mesh) -> Ints | None:
    """(V,) the vertices of `whole` that those of `part` have become: a join appends polygons in their order."""
    part_corners, part_sizes = meshes.polygon_arrays(part)
    corners, sizes = meshes.polygon_arrays(whole)
    starts = np.concatenate([[0], np.cumsum(sizes)])
    begins, ends = starts[: len(starts) - len(part_sizes)], starts[len(part_sizes) :]
    second = part_corners[1] - part_corners[0]
    for start in begins[(ends - begins == len(part_corners)) & (corners[begins + 1] - corners[begins] == second)]:
        offset = int(corners[start] - part_corners[0])
        is_there = 0 <= offset <= len(whole.vertices) - len(part.vertices)
        is_same = (
            np.array_equal(corners[start : start + count] - offset, part_corners[:count])
            for count in (FIRST, len(part_corners))
        )
        if is_there and all(is_same):
            return np.arange(offset, offset + len(part.vertices))
    return None


def _motion(was: Floats, now: Floats) -> Floats | None:
    """(4, 3) the affine motion from one place of some vertices to another; None where there is none."""
    given = np.column_stack([was, np.ones(len(was))])
    motion: Floats = np.asarray(np.linalg.lstsq(given, now, rcond=None)[0], dtype=np.float64)
    far = float(np.abs(given @ motion - now).max())
    return motion if far <= SAME * float(np.linalg.norm(np.ptp(now, axis=0))) else None
