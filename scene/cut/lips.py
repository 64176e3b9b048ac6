"""Cutting sewn lips open: along the seam, with a dark mouth bag behind, and the feature points on the new lips.

Materials, UV maps, vertex groups, shape keys and attributes of what was there stay; what is new takes them from the
skin beside it. All is worked out on a copy and written last.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import bmesh
import bpy
import numpy as np

from ...arrays import Floats
from ...errors import SceneError
from ...face.mesh.point_files import PointTable
from .. import mesh as meshes
from ..blender_types import EditMesh, EditVertex, Material, Mesh, Object
from ..faces import face_of, read_face
from ..materials import new_material
from ..points.bound import bind, followed, places, table_of
from ..points.kept import KeptPoints, read_kept, write_kept
from ..refusals import refuse_unwritable
from ..shape_mix import resting_values
from .bag import BagShape, Places, add_bag, bag_shape
from .seam import Cut, Line, cut_open

#: The dark behind cut lips: its name, colour and roughness.
DARK, DARK_COLOUR, DARK_ROUGHNESS = "Risorius Mouth", (0.02, 0.004, 0.004), 0.9

#: A seam that is found over less than this share of the mouth is none.
FOUND = 0.6

#: Points of the inner lips, by side of the cut; right and left corner.
UPPER, LOWER, CORNERS = ("2.2", "2.6", "2.7"), ("2.3", "2.8", "2.9"), ("2.5", "2.4")


def cut_lips(obj: Object) -> int:
    """Cut the sewn lips of `obj` open and hang a dark mouth bag behind them; returns how many vertices were parted.

    Raises
    ------
    SceneError : see `refusals`; lips that are not sewn, doubled vertices at the mouth, a seam that is not found.
    ModelError : what the face lacks. Nothing has been changed then.
    """
    refuse_unwritable(obj)
    above, shape = _seam_of(obj)
    before = followed(read_kept(obj), obj.data).kept
    table = table_of(before, meshes.rest_vertices(obj.data))
    edit: EditMesh = bmesh.new()
    try:
        edit.from_mesh(obj.data)
        at = at_rest(edit, obj.data)
        cut = _cut(obj, edit, above, shape, at)
        add_bag(edit, cut, shape, at, dark_slot(obj.data))
        edit.verts.index_update()
        held = _held(cut, shape, at, places(before, meshes.rest_vertices(obj.data)))
        edit.to_mesh(obj.data)
    finally:
        edit.free()
    add_dark(obj.data)
    obj.data.update()
    keep(obj, before, table, held)
    return len(cut.upper) - 2


def _seam_of(obj: Object) -> tuple[Floats, BagShape]:
    """(V,) how far vertices lie above the seam, NaN away from it, and the bag's shape; in the mesh's coordinates."""
    from ...face.products.lip_seam import lip_seam

    source = read_face(obj)
    face = face_of(source)
    if "mouth" not in face.sewn:
        raise SceneError(obj.name, "its lips are not sewn together: there is nothing to cut")
    seam = lip_seam(face)
    if seam.doubled:
        raise SceneError(
            obj.name,
            f"has {seam.doubled} doubled vertices at the mouth: merge them first "
            "(Edit Mode, Mesh > Merge > By Distance)",
        )
    shape, size = bag_shape(seam.room, source.pieces[0].to_metres)
    return seam.above * size, shape


def at_rest(edit: EditMesh, mesh: Mesh) -> Places:
    """Where vertices lie at rest, as the user's shape keys make them."""
    keys, layers = mesh.shape_keys, edit.verts.layers.shape
    if keys is None:
        return lambda vertex: np.asarray(vertex.co, dtype=np.float64)
    mixed = [
        (layers[name], layers[keys.key_blocks[name].relative_key.name], value)
        for name, value in resting_values(mesh).items()
    ]

    def at(vertex: EditVertex) -> Floats:
        place = np.asarray(vertex[layers[keys.reference_key.name]], dtype=np.float64)
        for layer, relative, value in mixed:
            place = place + value * (np.asarray(vertex[layer]) - np.asarray(vertex[relative]))
        return place

    return at


def _cut(obj: Object, edit: EditMesh, above: Floats, shape: BagShape, at: Places) -> Cut:
    """Cut the mesh along the seam."""
    known = np.isfinite(above)
    figures = {vertex: float(above[vertex.index]) for vertex in edit.verts if known[vertex.index]}
    line = Line(edit, figures, lambda vertex: shape.along(at(vertex)))
    path = line.path(edit)
    if len(path) < 3 or shape.along(at(path[-1])) - shape.along(at(path[0])) < FOUND:
        raise SceneError(obj.name, "no seam was found between its lips: check the feature points 2.2 to 2.9")
    return cut_open(edit, line, path)


def _held(cut: Cut, shape: BagShape, at: Places, points: Mapping[str, Floats]) -> dict[str, int]:
    """Points of the inner lips -> the vertices of the cut that are to hold them."""
    held = {name: cut.upper[end].index for name, end in zip(CORNERS, (0, -1), strict=True)}
    for names, chain in ((UPPER, cut.upper[1:-1]), (LOWER, cut.lower[1:-1])):
        along = np.array([shape.along(at(vertex)) for vertex in chain])
        for name in (name for name in names if name in points):
            held[name] = chain[int(np.abs(along - shape.along(points[name])).argmin())].index
    return held


def dark_slot(mesh: Mesh) -> int:
    """The slot that the dark has, or is to have; skin without a material keeps an empty first one."""
    names = [material.name if material is not None else "" for material in mesh.materials]
    return names.index(DARK) if DARK in names else max(len(names), 1)


def add_dark(mesh: Mesh) -> None:
    """Give a mesh the dark material, where it has not got it."""
    slot = dark_slot(mesh)
    if slot < len(mesh.materials):
        return
    if len(mesh.materials) == 0:
        mesh.materials.append(None)
    dark: Material | None = bpy.data.materials.get(DARK)
    mesh.materials.append(dark or new_material(DARK, DARK_COLOUR, roughness=DARK_ROUGHNESS))


def keep(obj: Object, before: KeptPoints, table: PointTable, held: Mapping[str, int]) -> None:
    """Keep the feature points with the mesh as it is now; those of the inner lips on its new edges."""
    origins = {name: point.origin for name, point in before.points.items()}
    confidence = {name: point.confidence for name, point in before.points.items()}
    known: PointTable = {name: held.get(name, place) for name, place in table.items()}
    now = bind(obj.data, known, origins=origins, confidence=confidence)
    write_kept(obj, replace(now, score=before.score, sewn=read_kept(obj).sewn - {"mouth"}))
