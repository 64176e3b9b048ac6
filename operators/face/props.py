"""What is stored of the face with its object, beside the feature points."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, CollectionProperty, IntProperty, PointerProperty

from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Context, Entries, Object
from ..changes import changed
from ..followers.props import RISORIUS_PG_follower


def _is_mesh(owner: PropertyGroup, obj: Object) -> bool:
    """Only other meshes can be parts of a face."""
    return bool(obj.type == "MESH" and obj != owner.id_data)


def _named(face: RISORIUS_PG_face, context: Context) -> None:
    """A script has named the object of a part: the list says so, too."""
    from ..followers.rows import take_slots

    take_slots(face.id_data)
    changed(face)


def _part(name: str, what: str) -> object:
    """A pointer to the object of one part, for scripts; the list of followers has it, too."""
    return PointerProperty(
        type=bpy.types.Object,
        name=name,
        description=f"Object of {what}, if it is not part of the head's mesh. It follows the face",
        poll=_is_mesh,
        update=_named,
    )


class RISORIUS_PG_face(PropertyGroup):
    """What is beside a face's own mesh: the list of objects that follow it."""

    followers: Annotated[
        Entries[RISORIUS_PG_follower],
        CollectionProperty(
            type=RISORIUS_PG_follower, name="Follows the Face", description="Objects that follow the face, and how"
        ),
    ]
    follower: Annotated[int, IntProperty(name="Active Object", description="The marked object of the list")]
    followers_listed: Annotated[
        bool, BoolProperty(description="Whether the list has been filled once", options={"HIDDEN"})
    ]
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
