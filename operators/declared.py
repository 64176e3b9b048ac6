"""Properties of Blender's, written so that mypy reads them, too.

    activation: Annotated[float, FloatProperty(name="Activation", default=4.0)]

says what a property holds, and what it is. Blender looks for properties among the bare annotations of a class, and
passes over all others without a word: before a class is registered, `declare` leaves it the properties alone.
"""

from __future__ import annotations

from inspect import get_annotations
from typing import Annotated, get_origin, get_type_hints


def declare(cls: type) -> None:
    """Annotate a class with the properties that it and its mix-ins have. May be done again."""
    hints = get_type_hints(cls, include_extras=True)
    properties = {name: hint.__metadata__[0] for name, hint in hints.items() if get_origin(hint) is Annotated}
    cls.__annotations__ = {**get_annotations(cls), **properties}
