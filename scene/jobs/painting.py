"""Materials for meshes that bring none, so that eyes and teeth can be told from skin."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...arrays import Bools, Ints
from ...face.mesh.parts import Part
from .. import mesh as meshes
from ..blender_types import Object
from ..creases.marks import draw_in
from ..faces import face_of, read_face
from ..materials import new_material
from ..pictures.irises import iris_polygons, lay_irises

if TYPE_CHECKING:
    from ...face.face import Face

#: Colours (linear RGB) of meshes that bring no materials, by part; the iris is cut out of the eyeballs.
PLAIN_COLOURS = {
    "Skin": (0.55, 0.36, 0.28),
    "Sclera": (0.8, 0.78, 0.75),
    "Teeth": (0.75, 0.7, 0.6),
    "Tongue": (0.45, 0.14, 0.13),
    "Other": (0.16, 0.1, 0.08),
    "Iris": (0.1, 0.2, 0.25),
    "Pupil": (0.01, 0.01, 0.01),
    "Mouth": (0.13, 0.035, 0.035),
}
#: Where each lies among an object's materials.
_SLOTS = {name: number for number, name in enumerate(PLAIN_COLOURS)}
_COLOUR_OF_PART = {
    Part.SKIN: "Skin",
    Part.EYEBALL_L: "Sclera",
    Part.EYEBALL_R: "Sclera",
    Part.TEETH_UPPER: "Teeth",
    Part.TEETH_LOWER: "Teeth",
    Part.TONGUE: "Tongue",
    Part.OTHER: "Other",
    Part.SKULL: "Other",
}

#: From this many pieces on, teeth are modelled one by one.
MANY_TEETH = 8


def paint_parts(obj: Object, *, creases: bool = False) -> None:
    """Give a mesh without materials one per part of its face, so that eyes and teeth can be told from skin."""
    face = face_of(read_face(obj))
    parts = np.asarray(face.parts)
    corners, sizes = meshes.polygon_arrays(obj.data)
    first = corners[np.cumsum(sizes) - sizes]
    slots = np.zeros(len(first), dtype=np.int64)
    for part, name in _COLOUR_OF_PART.items():
        slots[parts[first] == part] = _SLOTS[name]
    for polygons, name in zip(iris_polygons(face, corners, sizes), ("Iris", "Pupil"), strict=True):
        slots[polygons] = _SLOTS[name]
    slots[_gums(face, parts, first)] = _SLOTS["Tongue"]
    slots[_lining(face, corners, sizes)] = _SLOTS["Mouth"]
    painted = {}
    for name, colour in PLAIN_COLOURS.items():
        material = new_material(f"Risorius plain {name.lower()}", colour)
        if creases and name == "Skin":
            draw_in(material)
        obj.data.materials.append(material)
        painted[name] = material
    eye = {name: np.array(PLAIN_COLOURS[name]) for name in ("Sclera", "Iris", "Pupil")}
    lay_irises(obj, face, [painted[name] for name in eye], sclera=eye["Sclera"], iris=eye["Iris"], pupil=eye["Pupil"])
    meshes.set_materials(obj.data, slots)
    obj.data.update()


def _lining(face: Face, corners: Ints, sizes: Ints) -> Bools:
    """(F,) polygons of skin behind the lips, by the corners of all polygons (L,) and their sizes (F,)."""
    starts = np.cumsum(sizes) - sizes
    inner = np.asarray(face.parts) == Part.SKIN
    inner[face.outer_skin] = False
    centres = np.add.reduceat(face.vertices[corners], starts) / sizes[:, None]
    lips, *eyes = (
        np.linalg.norm(centres - np.mean([face.points[name].position for name in names], axis=0), axis=1)
        for names in (("2.2", "2.3"), ("3.7", "3.11"), ("3.8", "3.12"))
    )
    behind: Bools = np.logical_or.reduceat(inner[corners], starts) & (lips < np.minimum(*eyes))
    return behind


def _gums(face: Face, parts: Ints, first: Ints) -> Bools:
    """(F,) polygons of gums, by their first corners (F,): where every tooth is a piece, the large pieces are gums."""
    from ...face.mesh.segmentation import pieces

    label = pieces(face.polygons, len(parts))
    teeth = np.isin(parts, (Part.TEETH_UPPER, Part.TEETH_LOWER))
    found, counts = np.unique(label[teeth], return_counts=True)
    if len(found) < MANY_TEETH:
        return np.zeros(len(first), dtype=bool)
    large = found[counts > 4 * np.median(counts)]
    return np.isin(label[first], large)
