"""`Annotated`, read by mypy and by Blender alike.

    activation: Annotated[float, FloatProperty(name="Activation", default=4.0)]

says what a property holds, and what it is. mypy takes the first as the attribute's type. Blender wants an annotation
that is a property and nothing else; so at run time the second is all there is. (typing's own `Annotated` would also
keep every property for ever, and the bpy module with it, which then hangs when Python ends.)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing import Annotated as Annotated
else:

    class Annotated:
        """Stands for the property."""

        def __class_getitem__(cls, parts: tuple[object, object]) -> object:
            return parts[1]
