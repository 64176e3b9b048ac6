"""Mesh data to arrays and back, in the mesh's own coordinates or in metres.

The resting face is what the user's shape keys make of the mesh at their present values (`shape_mix`). Only a rotation
and a shift of the object leave a face what it is, so *metres* means the mesh's own axes times the object's stretch in
the world times the scene's unit scale.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import bpy
import numpy as np

from ..arrays import Floats, Ints
from ..errors import SceneError
from .attributes import (
    read_floats,
    read_ints,
    read_numbers,
    remove_attribute,
    write_flags,
    write_floats,
    write_ints,
    write_numbers,
)
from .blender_types import Depsgraph, Key, Mesh, Object, Scene, ShapeKey
from .shape_mix import mixed_vertices, resting_values

PART_ATTRIBUTE = "risorius_part"


def rest_vertices(mesh: Mesh, values: Mapping[str, float] | None = None) -> Floats:
    """(V, 3) resting vertices of `mesh` in its own coordinates, before modifiers.

    Parameters
    ----------
    values : shape key -> value that makes it what it is; by default those of the user's keys at present.
    """
    if mesh.shape_keys is None:
        return mesh_vertices(mesh)
    return mixed_vertices(mesh, resting_values(mesh) if values is None else values)


def basis_vertices(mesh: Mesh) -> Floats:
    """(V, 3) vertices of `mesh` without any shape key: the Basis, or the bare mesh."""
    return rest_vertices(mesh, {})


def mesh_vertices(mesh: Mesh) -> Floats:
    """(V, 3) vertices of `mesh` itself, without its shape keys; of an evaluated one, as they show."""
    return read_floats(mesh.vertices, "co", 3)


def key_vertices(key: ShapeKey) -> Floats:
    """(V, 3) vertices of one shape key in the mesh's own coordinates."""
    return read_floats(key.data, "co", 3)


def write_key_vertices(key: ShapeKey, positions: Floats) -> None:
    """Set the vertices (V, 3) of one shape key, in the mesh's own coordinates."""
    write_floats(key.data, "co", positions)


def keys_of(obj: Object) -> Key:
    """The shape keys of the mesh of `obj`: where it has none, with a Basis now."""
    if obj.data.shape_keys is None:
        obj.shape_key_add(name="Basis", from_mix=False)
    keys = obj.data.shape_keys
    assert keys is not None
    return keys


def remove_all_keys(obj: Object) -> None:
    """Take all shape keys off an object that no scene has; Blender alone would leave them in the file."""
    keys = obj.data.shape_keys
    if keys is not None:
        obj.shape_key_clear()
        bpy.data.batch_remove([keys])


def evaluated_vertices(obj: Object, depsgraph: Depsgraph | None = None) -> Floats:
    """(V', 3) vertices as Blender shows them: shape keys and modifiers applied; the object's own coordinates.

    V' differs from the original count where a modifier changes the topology.
    """
    graph = depsgraph if depsgraph is not None else bpy.context.evaluated_depsgraph_get()
    evaluated = obj.evaluated_get(graph)
    vertices = mesh_vertices(evaluated.to_mesh())
    evaluated.to_mesh_clear()
    return vertices


def polygon_arrays(mesh: Mesh) -> tuple[Ints, Ints]:
    """Corner vertices of all polygons one after another (L,), and corners of each polygon (F,)."""
    # Blender's own attribute of the corners is read thirty times as fast as the corners themselves.
    attribute = mesh.attributes.get(".corner_vert")
    corners = read_ints(mesh.loops, "vertex_index") if attribute is None else read_ints(attribute.data, "value")
    return corners, np.diff(read_ints(mesh.polygons, "loop_start"), append=len(corners))


def triangle_corners(mesh: Mesh) -> Ints:
    """(T, 3) vertices of the triangles that Blender draws the polygons as."""
    return read_ints(mesh.loop_triangles, "vertices", 3)


def edge_vertices(mesh: Mesh) -> Ints:
    """(E, 2) vertices of all edges."""
    return read_ints(mesh.edges, "vertices", 2)


def set_materials(mesh: Mesh, slots: Ints) -> None:
    """Give each polygon the material of a slot (F,)."""
    write_ints(mesh.polygons, "material_index", slots)


def polygon_sequence(corners: Ints, sizes: Ints, *, first_vertex: int = 0) -> list[tuple[int, ...]]:
    """Polygons as index tuples, each index shifted by `first_vertex`."""
    ends = np.cumsum(sizes)
    flat = (corners + first_vertex).tolist()
    return [tuple(flat[end - size : end]) for size, end in zip(sizes.tolist(), ends.tolist(), strict=True)]


def read_parts(mesh: Mesh) -> Ints | None:
    """(V,) stored parts of `mesh` (`face.parts.Part`), or None where none are stored."""
    return read_numbers(mesh, PART_ATTRIBUTE)


def write_parts(mesh: Mesh, parts: Ints) -> None:
    """Store (V,) parts with the mesh as an integer attribute, so that they survive editing."""
    write_numbers(mesh, PART_ATTRIBUTE, parts)


def remove_parts(mesh: Mesh) -> None:
    """Take stored parts away."""
    remove_attribute(mesh, PART_ATTRIBUTE)


def world_matrix(obj: Object) -> Floats:
    """(4, 4) matrix from the object's own coordinates to the world's."""
    return np.array([tuple(row) for row in obj.matrix_world], dtype=np.float64)


def metres_matrix(obj: Object, scene: Scene | None = None) -> Floats:
    """(3, 3) symmetric matrix from the object's own coordinates to metres: its stretch in the world.

    Raises
    ------
    SceneError : the object is scaled to nothing, or mirrored (its left would be its right).
    """
    world = world_matrix(obj)[:3, :3]
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


def relative_matrix(obj: Object, other: Object) -> Floats:
    """(4, 4) matrix from the coordinates of `other` to those of `obj`."""
    ours, theirs = world_matrix(obj), world_matrix(other)
    if abs(np.linalg.det(theirs[:3, :3])) < 1e-30:
        raise SceneError(other.name, "has a scale of zero along an axis: set a scale above zero")
    matrix: Floats = np.linalg.inv(ours) @ theirs
    return matrix


def new_mesh(name: str, vertices: Floats, corners: Ints, sizes: Ints) -> Mesh:
    """A new mesh datablock from vertices (V, 3), corners (L,) and polygon sizes (F,); smooth shaded."""
    mesh: Mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(vertices))
    write_floats(mesh.vertices, "co", vertices)
    mesh.loops.add(len(corners))
    write_ints(mesh.loops, "vertex_index", corners)
    mesh.polygons.add(len(sizes))
    write_ints(mesh.polygons, "loop_start", np.cumsum(sizes) - sizes)
    write_flags(mesh.polygons, "use_smooth", np.ones(len(sizes), dtype=bool))
    mesh.update(calc_edges=True)
    mesh.validate()
    return mesh


def flatten_polygons(polygons: Sequence[Sequence[int]] | Sequence[Ints] | Ints) -> tuple[Ints, Ints]:
    """Polygons as an (F, n) array or a sequence of index sequences -> corners (L,) and sizes (F,)."""
    sizes = np.fromiter((len(polygon) for polygon in polygons), dtype=np.int64, count=len(polygons))
    corners = np.fromiter((index for polygon in polygons for index in polygon), dtype=np.int64, count=int(sizes.sum()))
    return corners, sizes
