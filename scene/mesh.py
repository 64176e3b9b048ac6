"""Mesh data to arrays and back, in the mesh's own coordinates or in metres.

The resting face is the mesh's Basis (its reference shape key), or the bare mesh where it has no shape keys:
modifiers, other shape keys, drivers and the pose of a rig are not part of it. They go on working on top of what is
baked. Only a rotation and a shift of the object leave a face what it is, so *metres* means the mesh's own axes
times the object's stretch in the world times the scene's unit scale.
"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from ..arrays import Floats, Ints
from ..errors import SceneError

PART_ATTRIBUTE = "risorius_part"


def rest_vertices(mesh: Any) -> Floats:
    """(V, 3) resting vertices of `mesh` in its own coordinates: the Basis, or the bare mesh."""
    keys = mesh.shape_keys
    source = keys.reference_key.data if keys is not None else mesh.vertices
    flat = np.empty(3 * len(source), dtype=np.float32)
    source.foreach_get("co", flat)
    return flat.astype(np.float64).reshape(-1, 3)


def key_vertices(key_block: Any) -> Floats:
    """(V, 3) vertices of one shape key in the mesh's own coordinates."""
    flat = np.empty(3 * len(key_block.data), dtype=np.float32)
    key_block.data.foreach_get("co", flat)
    return flat.astype(np.float64).reshape(-1, 3)


def evaluated_vertices(obj: Any, depsgraph: Any | None = None) -> Floats:
    """(V', 3) vertices as Blender shows them: shape keys and modifiers applied; the object's own coordinates.

    V' differs from the original count where a modifier changes the topology.
    """
    graph = depsgraph if depsgraph is not None else bpy.context.evaluated_depsgraph_get()
    evaluated = obj.evaluated_get(graph)
    mesh = evaluated.to_mesh()
    flat = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", flat)
    evaluated.to_mesh_clear()
    return flat.astype(np.float64).reshape(-1, 3)


def polygon_arrays(mesh: Any) -> tuple[Ints, Ints]:
    """Corner vertices of all polygons one after another (L,), and corners of each polygon (F,)."""
    corners = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    sizes = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("loop_total", sizes)
    return corners.astype(np.int64), sizes.astype(np.int64)


def polygon_sequence(corners: Ints, sizes: Ints, *, first_vertex: int = 0) -> list[tuple[int, ...]]:
    """Polygons as index tuples, each index shifted by `first_vertex`."""
    ends = np.cumsum(sizes)
    flat = (corners + first_vertex).tolist()
    return [tuple(flat[end - size : end]) for size, end in zip(sizes.tolist(), ends.tolist(), strict=True)]


def read_parts(mesh: Any) -> Ints | None:
    """(V,) stored parts of `mesh` (`face.parts.Part`), or None where none are stored."""
    attribute = mesh.attributes.get(PART_ATTRIBUTE)
    if attribute is None or attribute.domain != "POINT" or attribute.data_type != "INT":
        return None
    parts = np.empty(len(attribute.data), dtype=np.int32)
    attribute.data.foreach_get("value", parts)
    return parts.astype(np.int64)


def write_parts(mesh: Any, parts: Ints) -> None:
    """Store (V,) parts with the mesh as an integer attribute, so that they survive editing."""
    attribute = mesh.attributes.get(PART_ATTRIBUTE) or mesh.attributes.new(PART_ATTRIBUTE, "INT", "POINT")
    attribute.data.foreach_set("value", np.ascontiguousarray(parts, dtype=np.int32))


def metres_matrix(obj: Any, scene: Any | None = None) -> Floats:
    """(3, 3) symmetric matrix from the object's own coordinates to metres: its stretch in the world.

    Raises
    ------
    SceneError : the object is scaled to nothing, or mirrored (its left would be its right).
    """
    world = np.array(obj.matrix_world, dtype=np.float64)[:3, :3]
    if not np.isfinite(world).all():
        raise SceneError(obj.name, "its transform is not finite: clear its location, rotation and scale (Alt G, R, S)")
    _, stretch, axes = np.linalg.svd(world)
    if stretch[-1] < 1e-9 * max(1.0, stretch[0]) or stretch[0] == 0.0:
        raise SceneError(obj.name, "has a scale of zero along an axis: set a scale above zero")
    if np.linalg.det(world) < 0.0:
        raise SceneError(
            obj.name,
            "is mirrored by a negative scale, which swaps its left and right: "
            "apply the scale (Object > Apply > Scale), then import its feature points again",
        )
    unit = (scene if scene is not None else bpy.context.scene).unit_settings.scale_length
    matrix: Floats = (axes.T * (stretch * unit)) @ axes
    return matrix


def relative_matrix(obj: Any, other: Any) -> Floats:
    """(4, 4) matrix from the coordinates of `other` to those of `obj`."""
    ours = np.array(obj.matrix_world, dtype=np.float64)
    theirs = np.array(other.matrix_world, dtype=np.float64)
    if abs(np.linalg.det(theirs[:3, :3])) < 1e-30:
        raise SceneError(other.name, "has a scale of zero along an axis: set a scale above zero")
    matrix: Floats = np.linalg.inv(ours) @ theirs
    return matrix


def new_mesh(name: str, vertices: Floats, corners: Ints, sizes: Ints) -> Any:
    """A new mesh datablock from vertices (V, 3), corners (L,) and polygon sizes (F,); smooth shaded."""
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(vertices))
    mesh.vertices.foreach_set("co", np.ascontiguousarray(vertices, dtype=np.float32).ravel())
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", np.ascontiguousarray(corners, dtype=np.int32))
    mesh.polygons.add(len(sizes))
    starts = np.concatenate([[0], np.cumsum(sizes)[:-1]]) if len(sizes) else np.zeros(0)
    mesh.polygons.foreach_set("loop_start", np.ascontiguousarray(starts, dtype=np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(sizes), dtype=bool))
    mesh.update(calc_edges=True)
    mesh.validate()
    return mesh


def flatten_polygons(polygons: Any) -> tuple[Ints, Ints]:
    """Polygons as an (F, n) array or a sequence of index sequences -> corners (L,) and sizes (F,)."""
    sizes = np.fromiter((len(polygon) for polygon in polygons), dtype=np.int64, count=len(polygons))
    corners = np.fromiter((index for polygon in polygons for index in polygon), dtype=np.int64, count=int(sizes.sum()))
    return corners, sizes
