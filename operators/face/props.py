"""What is stored of the face with its object, beside the feature points."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, PointerProperty

from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Object


def _is_mesh(owner: PropertyGroup, obj: Object) -> bool:
    """Only other meshes can be parts of a face."""
    return bool(obj.type == "MESH" and obj != owner.id_data)


def _part(name: str, what: str) -> object:
    """A pointer to the object of one part."""
    return PointerProperty(
        type=bpy.types.Object,
        name=name,
        description=f"Object of {what}, if it is not part of the head's mesh. It follows the face",
        poll=_is_mesh,
    )


class RISORIUS_PG_face(PropertyGroup):
    """The parts of a face that are objects of their own."""

    eyeball_l: Annotated[Object | None, _part("Left Eye", "the subject's left eyeball")]
    eyeball_r: Annotated[Object | None, _part("Right Eye", "the subject's right eyeball")]
    teeth_upper: Annotated[Object | None, _part("Upper Teeth", "the upper teeth and gums")]
    teeth_lower: Annotated[Object | None, _part("Lower Teeth", "the lower teeth and gums, which move with the jaw")]
    tongue: Annotated[Object | None, _part("Tongue", "the tongue, which moves with the jaw")]
    make_single_user: Annotated[
        bool,
        BoolProperty(
            name="Make Single User",
            description="If other objects share this mesh, give this object its own copy before baking",
            default=False,
        ),
    ]
