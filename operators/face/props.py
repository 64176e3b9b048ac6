"""What is stored of the face with its object, beside the feature points."""

from typing import Any

import bpy


def _is_mesh(owner: Any, obj: Any) -> bool:
    """Only other meshes can be parts of a face."""
    return bool(obj.type == "MESH" and obj != owner.id_data)


def _part(name: str, what: str) -> Any:
    """A pointer to the object of one part."""
    return bpy.props.PointerProperty(
        type=bpy.types.Object,
        name=name,
        description=f"The object of {what}, where it is not part of the head's mesh. It follows the face",
        poll=_is_mesh,
    )


class RISORIUS_PG_face(bpy.types.PropertyGroup):
    """The parts of a face that are objects of their own."""

    eyeball_l: _part("Left Eye", "the subject's left eyeball")  # type: ignore[valid-type]
    eyeball_r: _part("Right Eye", "the subject's right eyeball")  # type: ignore[valid-type]
    teeth_upper: _part("Upper Teeth", "the upper teeth and gums")  # type: ignore[valid-type]
    teeth_lower: _part("Lower Teeth", "the lower teeth and gums, which move with the jaw")  # type: ignore[valid-type]
    tongue: _part("Tongue", "the tongue, which moves with the jaw")  # type: ignore[valid-type]
    make_single_user: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Make Single User",
        description="Where other objects share this mesh, give this one a copy of its own to bake onto",
        default=False,
    )
