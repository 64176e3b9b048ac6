"""Objects beside a face, as one set of triangles: brows may be objects of their own."""

from __future__ import annotations

import bpy
import numpy as np

from ...arrays import Floats, Ints
from .. import mesh as meshes
from ..blender_types import Object, Scene

#: Objects with more vertices are whole characters or their clothes.
MOST = 100_000


def pieces_beside(obj: Object, stretch: Floats, scene: Scene | None = None) -> tuple[Floats, Ints] | None:
    """Vertices (B, 3) and triangles (T, 3) of the meshes of a scene that show beside `obj`; None where there are none.

    Parameters
    ----------
    stretch : (3, 3) from the mesh's own coordinates to those that its face is sought in.
    """
    scene = scene if scene is not None else bpy.context.scene
    vertices, triangles, start = [], [], 0
    for other in scene.objects:
        is_mesh = other.type == "MESH" and other != obj and other.data != obj.data
        if not is_mesh or (other.hide_render and other.hide_viewport) or not 0 < len(other.data.vertices) < MOST:
            continue
        if len(other.data.polygons) == 0 or not np.linalg.det(meshes.world_matrix(other)[:3, :3]):
            continue
        matrix = meshes.relative_matrix(obj, other)
        places = meshes.rest_vertices(other.data) @ matrix[:3, :3].T + matrix[:3, 3]
        vertices.append(places @ stretch.T)
        triangles.append(meshes.triangle_corners(other.data) + start)
        start += len(places)
    return (np.concatenate(vertices), np.concatenate(triangles)) if vertices else None
