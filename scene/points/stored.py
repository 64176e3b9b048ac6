"""Feature points stored with an object's mesh, and read back where they are on it now."""

from __future__ import annotations

from ...arrays import Floats
from ...errors import SceneError
from ...face.mesh.point_files import PointTable
from .. import mesh as meshes
from ..blender_types import Object
from .bound import bind, followed, table_of
from .kept import Origin, read_kept, write_kept


def store_points(obj: Object, points: PointTable, *, origin: Origin = Origin.FILE) -> None:
    """Keep feature points with the mesh of `obj`: name -> vertex index, or position (3,) in the mesh's own coordinates.

    Raises
    ------
    SceneError : an index beyond the mesh's vertices; a mesh of another file.
    """
    count = len(obj.data.vertices)
    for name, point in points.items():
        if isinstance(point, int) and point >= count:
            raise SceneError(
                obj.name,
                f"has {count} vertices, but feature point {name} uses vertex {point}: wrong file for the mesh?",
            )
    write_kept(obj, bind(obj.data, points, origins=origin), as_given=True)


def stored_points(obj: Object, vertices: Floats | None = None) -> dict[str, int | tuple[float, float, float]]:
    """Feature points kept with the mesh of `obj`, where they are on it now.

    Parameters
    ----------
    vertices : (V, 3) of the mesh; by default as it rests.

    Raises
    ------
    SceneError : none there, unreadable, or the mesh was edited so that points that every face needs are lost.
    """
    from ...face.mesh.points import REQUIRED

    now = followed(read_kept(obj), obj.data)
    needed = sorted(set(now.lost) & set(REQUIRED))
    if needed:
        raise SceneError(
            obj.name, f"was edited, and its feature points {', '.join(needed)} were lost: find or import them again"
        )
    return table_of(now.kept, meshes.rest_vertices(obj.data) if vertices is None else vertices)


def moved_points(obj: Object, points: PointTable, vertices: Floats) -> dict[str, int | tuple[float, float, float]]:
    """Feature points of a table on the resting mesh of `obj`, where they are when its vertices (V, 3) have moved."""
    return table_of(bind(obj.data, points), vertices)
