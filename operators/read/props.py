"""How faces are read, and what is written of it. Kept with the scene."""

from typing import Any

import bpy

from ..film.props import _RELATIVE


def _changed(owner: Any, context: Any) -> None:
    """Read again."""
    from . import live

    live.ask()


def _file(name: str, what: str) -> Any:
    """A file that may be written."""
    about = f"{what}. Empty: none. A name that begins with // lies beside the .blend file"
    return bpy.props.StringProperty(name=name, description=about, subtype="FILE_PATH", options=_RELATIVE)


class RISORIUS_PG_read(bpy.types.PropertyGroup):
    """The rule, what is listed, and files."""

    rule: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Rule",
        description="How FAPs become beliefs in emotions",
        items=(
            ("paper", "Paper", "The product of all FAPs, as the paper has it: strict, one FAP that fails decides"),
            ("robust", "Robust", "Their geometric mean, FAPs that were not seen left out: forgiving"),
        ),
        default="paper",
        update=_changed,
    )
    all_faps: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="All FAPs",
        description="List every FAP that the face shows, not only those that the most believed profile asks for",
        default=False,
    )
    stream: _file("FAP File", "A .fap file of the measured FAPs to write")  # type: ignore[valid-type]
    table: _file("Table", "A .csv table of beliefs and FAPs to write, a row per frame")  # type: ignore[valid-type]
    plot: _file("Plot", "A .png picture of the plot to write")  # type: ignore[valid-type]
