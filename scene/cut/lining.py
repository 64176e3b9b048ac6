"""A mouth bag behind lips that end in an open border, through which what lies behind the head shows.

All that the mesh has stays, as where lips are cut open; all is worked out on a copy and written last.
"""

from __future__ import annotations

import bmesh
import numpy as np

from ...errors import SceneError
from .. import mesh as meshes
from ..blender_types import EditMesh, Object
from ..faces import face_of, read_face
from ..points.bound import followed, table_of
from ..points.kept import read_kept
from ..refusals import refuse_unwritable
from .bag import add_bag, bag_shape
from .lips import add_dark, at_rest, dark_slot, keep
from .seam import Cut


def line_mouth(obj: Object) -> int:
    """Hang a dark mouth bag on the open border of the mouth of `obj`; returns how many vertices the border has.

    Raises
    ------
    SceneError : see `refusals`; a mouth without an open border, or with doubled vertices on it.
    ModelError : what the face lacks. Nothing has been changed then.
    """
    from ...face.products.mouth_room import mouth_border, mouth_room

    refuse_unwritable(obj)
    source = read_face(obj)
    face = face_of(source)
    border = mouth_border(face)
    if border is None or max(border.upper.max(), border.lower.max()) >= len(obj.data.vertices):
        raise SceneError(
            obj.name,
            "its mouth ends in no open border: it has an inside already, or its lips are sewn together, which "
            "Cut Lips Open parts",
        )
    if border.doubled:
        raise SceneError(
            obj.name,
            f"has {border.doubled} doubled vertices at the mouth: merge them first "
            "(Edit Mode, Mesh > Merge > By Distance)",
        )
    ends = np.asarray(face.vertices[[border.upper[-1], border.upper[0]]])
    shape, _ = bag_shape(mouth_room(face, ends), source.pieces[0].to_metres)
    before = followed(read_kept(obj), obj.data).kept
    table = table_of(before, meshes.rest_vertices(obj.data))
    edit: EditMesh = bmesh.new()
    try:
        edit.from_mesh(obj.data)
        vertices = list(edit.verts)
        upper, lower = (tuple(vertices[number] for number in arc.tolist()) for arc in (border.upper, border.lower))
        add_bag(edit, Cut(upper, lower), shape, at_rest(edit, obj.data), dark_slot(obj.data))
        edit.to_mesh(obj.data)
    finally:
        edit.free()
    add_dark(obj.data)
    obj.data.update()
    keep(obj, before, table, {})
    return len(border.upper) + len(border.lower) - 2
