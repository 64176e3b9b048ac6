"""Contractions set by hand, kept with the object; and the list that shows and sets them, kept with the window."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, CollectionProperty, FloatProperty, IntProperty

from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Entries, Object
from ..changes import changed
from ..names import fill, fill_soon, shown_lists
from ..session import session


class RISORIUS_PG_by_hand(PropertyGroup):
    """One contraction set by hand; its name is the muscle's."""

    contraction: Annotated[
        float,
        FloatProperty(name="Contraction", description="Contraction from 0 (relaxed) to 1 (full)", min=0.0, max=1.0),
    ]


class RISORIUS_PG_muscles(PropertyGroup):
    """What is set by hand on one face."""

    by_hand: Annotated[
        Entries[RISORIUS_PG_by_hand],
        CollectionProperty(
            type=RISORIUS_PG_by_hand,
            name="Set by Hand",
            description="Contractions set by hand. They stay when the emotion changes",
        ),
    ]
    linked: Annotated[
        bool, BoolProperty(name="Link Sides", description="Contract both sides of the face alike", default=True)
    ]


def by_hand_of(obj: Object) -> dict[str, float]:
    """Muscle name -> contraction that is set by hand on `obj`."""
    return {str(entry.name): float(entry.contraction) for entry in obj.risorius.muscles.by_hand}


def set_by_hand(obj: Object, name: str, value: float | None) -> None:
    """Set the contraction of a muscle, or leave it to the emotion again (None); with its twin where sides are linked.

    Raises
    ------
    ParameterError : there is no such muscle.
    """
    from ...errors import ParameterError
    from ...face.contractible import contractibles

    muscles, known = obj.risorius.muscles, contractibles()
    if name not in known:
        raise ParameterError("muscle", f"must be one of {', '.join(known)}", name)
    for each in dict.fromkeys((name, known[name].mirror) if muscles.linked else (name,)):
        index = muscles.by_hand.find(each)
        if value is None:
            if index >= 0:
                muscles.by_hand.remove(index)
            continue
        entry = muscles.by_hand[index] if index >= 0 else muscles.by_hand.add()
        entry.name, entry.contraction = each, value


def _get(item: RISORIUS_PG_muscle_name) -> float:
    """What the active face does with this muscle."""
    obj: Object | None = bpy.context.object
    if obj is None:
        return 0.0
    index = obj.risorius.muscles.by_hand.find(item.name)
    if index >= 0:
        return float(obj.risorius.muscles.by_hand[index].contraction)
    shown = session().previews.shown.get(obj.session_uid)
    return 0.0 if shown is None else float(shown.contractions.get(item.name, 0.0))


def _set(item: RISORIUS_PG_muscle_name, value: float) -> None:
    """A slider was moved: from now on the contraction is the user's."""
    obj: Object | None = bpy.context.object
    if obj is not None:
        set_by_hand(obj, item.name, value)
        changed(obj.risorius.muscles, bpy.context)


class RISORIUS_PG_muscle_name(PropertyGroup):
    """A muscle in the list, and its slider on the active face; nothing is stored in it."""

    contraction: Annotated[
        float,
        FloatProperty(
            name="Contraction",
            description="Contraction of this muscle, 0 to 1. Move the slider to set it by hand: it then stays "
            "when the emotion changes, until you reset it",
            min=0.0,
            max=1.0,
            get=_get,
            set=_set,
        ),
    ]


class RISORIUS_PG_muscle_list(PropertyGroup):
    """How the list of muscles is shown."""

    names: Annotated[
        Entries[RISORIUS_PG_muscle_name],
        CollectionProperty(type=RISORIUS_PG_muscle_name, name="Muscles", description="All muscles, lids and the jaw"),
    ]
    active: Annotated[int, IntProperty(name="Muscle", description="Selected muscle", default=0, min=0)]
    busy_only: Annotated[
        bool,
        BoolProperty(name="Contracted Only", description="List only muscles that are contracted or set by hand"),
    ]


def list_muscles() -> None:
    """Fill the list with all that can be contracted."""
    from ...face.contractible import contractibles

    for shown in shown_lists():
        fill(shown.muscles.names, contractibles())


def list_muscles_soon() -> None:
    """Fill the list after drawing."""
    fill_soon(list_muscles)
