"""The list of objects that follow a face, kept with the face's object."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, EnumProperty, PointerProperty, StringProperty

from ...scene.blender_types import Object
from ...scene.following.kinds import Follows
from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Context
from ..changes import changed

#: How an object follows -> name, tooltip and icon.
WAYS = {
    Follows.EYES: ("Eyes", "Eyeballs: each turns by itself, and the lids lie on it", "HIDE_OFF"),
    Follows.EYE_L: ("Left Eye", "The subject's left eyeball", "HIDE_OFF"),
    Follows.EYE_R: ("Right Eye", "The subject's right eyeball", "HIDE_OFF"),
    Follows.TEETH: ("Teeth", "Teeth and gums: the lower row moves with the jaw", "MESH_CYLINDER"),
    Follows.TEETH_UPPER: ("Upper Teeth", "Teeth and gums of the upper jaw, which stay", "MESH_CYLINDER"),
    Follows.TEETH_LOWER: ("Lower Teeth", "Teeth and gums of the lower jaw, which move with it", "MESH_CYLINDER"),
    Follows.TONGUE: ("Tongue", "The tongue: it moves with the jaw, and by itself", "MESH_CAPSULE"),
    Follows.SEVERAL: ("Several Parts", "Eyes, teeth, tongue, lashes in one object: told apart by shape", "MESH_MONKEY"),
    Follows.SKIN: ("On the Skin", "Lashes, brows, a beard: follows the skin that it grows out of", "STRANDS"),
    Follows.SKULL: ("On the Skull", "Hair, glasses, a hat: follows the head, not the face", "MESH_UVSPHERE"),
    Follows.NONE: ("Does Not Follow", "Stays where it is. Messages of bakes name it", "X"),
}
HIDDEN = {"HIDDEN"}
ITEMS = [(way.name, *WAYS[way], number) for number, way in enumerate(Follows)]


def _corrected(row: RISORIUS_PG_follower, context: Context) -> None:
    """The user has said how an object follows."""
    row.by_hand = True
    changed(row)


class RISORIUS_PG_follower(PropertyGroup):
    """One object beside the face."""

    object: Annotated[
        Object | None, PointerProperty(type=bpy.types.Object, name="Object", description="Beside the face")
    ]
    follows: Annotated[
        str,
        EnumProperty(
            name="Follows",
            description="How the object follows the face",
            items=ITEMS,
            update=_corrected,
        ),
    ]
    by_hand: Annotated[bool, BoolProperty(description="Whether the user has said so", options=HIDDEN)]
    by_part: Annotated[bool, BoolProperty(description="Whether a single part's property has said so", options=HIDDEN)]
    why_not: Annotated[str, StringProperty(description="Why it cannot follow", options=HIDDEN)]
