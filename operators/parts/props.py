"""What is shown and set of the parts of a face's mesh. Kept with the window: the parts are the mesh's own."""

from __future__ import annotations

from bpy.props import BoolProperty, EnumProperty, StringProperty

from ...face.mesh.parts import Part
from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..screen import redraw_viewports

#: Part -> identifier, name and tooltip of the menu.
PARTS = {
    Part.SKIN: ("SKIN", "Skin", "Moved by muscles; includes mouth cavity and eye sockets"),
    Part.EYEBALL_L: ("EYEBALL_L", "Left Eye", "The subject's left eyeball"),
    Part.EYEBALL_R: ("EYEBALL_R", "Right Eye", "The subject's right eyeball"),
    Part.TEETH_UPPER: ("TEETH_UPPER", "Upper Teeth", "Upper teeth and gums"),
    Part.TEETH_LOWER: ("TEETH_LOWER", "Lower Teeth", "Lower teeth and gums, which move with the jaw"),
    Part.TONGUE: ("TONGUE", "Tongue", "The tongue, which moves with the jaw"),
    Part.OTHER: ("OTHER", "On the Skin", "Lashes, brows, a beard: follows the skin that it grows out of"),
    Part.SKULL: ("SKULL", "On the Skull", "Hair, glasses, a hat: follows the head, not the face"),
}


class RISORIUS_PG_parts(PropertyGroup):
    """How parts are shown, and which one a vertex group is to become."""

    show: Annotated[
        bool,
        BoolProperty(
            name="Show Parts",
            description="Draw the parts of the mesh as colours",
            default=False,
            update=redraw_viewports,
        ),
    ]
    part: Annotated[
        str,
        EnumProperty(
            name="Part", description="Part to assign the vertices to", items=tuple(PARTS.values()), default="OTHER"
        ),
    ]
    group: Annotated[
        str, StringProperty(name="Vertex Group", description="Vertex group whose vertices are assigned to the part")
    ]
