"""What is shown and set of the parts of a face's mesh. Kept with the window: the parts are the mesh's own."""

from __future__ import annotations

from typing import Annotated

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ...face.mesh.parts import Part
from ..points.props import redraw

#: Part -> identifier, name and tooltip of the menu.
PARTS = {
    Part.SKIN: ("SKIN", "Skin", "Moves by muscles; mouth bag and eye sockets belong to it"),
    Part.EYEBALL_L: ("EYEBALL_L", "Left Eye", "The subject's left eyeball"),
    Part.EYEBALL_R: ("EYEBALL_R", "Right Eye", "The subject's right eyeball"),
    Part.TEETH_UPPER: ("TEETH_UPPER", "Upper Teeth", "Upper teeth and gums"),
    Part.TEETH_LOWER: ("TEETH_LOWER", "Lower Teeth", "Lower teeth and gums, which move with the jaw"),
    Part.TONGUE: ("TONGUE", "Tongue", "The tongue, which moves with the jaw"),
    Part.OTHER: ("OTHER", "Other", "Brows, lashes, hair, clothes: what follows the skin that it lies on"),
}


class RISORIUS_PG_parts(bpy.types.PropertyGroup):
    """How parts are shown, and which one a vertex group is to become."""

    show: Annotated[
        bool,
        BoolProperty(
            name="Show Parts", description="Draw the parts of the face's mesh as colours", default=False, update=redraw
        ),
    ]
    part: Annotated[
        str,
        EnumProperty(
            name="Part", description="What the vertices of the group are", items=tuple(PARTS.values()), default="OTHER"
        ),
    ]
    group: Annotated[str, StringProperty(name="Vertex Group", description="Whose vertices are set to that part")]
