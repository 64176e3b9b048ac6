"""How faces are read, and what is written of it. Kept with the scene."""

from __future__ import annotations

from typing import Annotated, Any

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ..film.props import _RELATIVE


def _changed(owner: Any, context: Any) -> None:
    """Read again."""
    from . import live

    live.ask()


def _file(name: str, what: str) -> Any:
    """A file that may be written."""
    about = f"{what}. Empty: none. A name that begins with // lies beside the .blend file"
    return StringProperty(name=name, description=about, subtype="FILE_PATH", options=_RELATIVE)


class RISORIUS_PG_read(bpy.types.PropertyGroup):
    """The rule, what is listed, and files."""

    rule: Annotated[
        str,
        EnumProperty(
            name="Rule",
            description="How FAPs become beliefs in emotions",
            items=(
                ("paper", "Paper", "The product of all FAPs, as the paper has it: strict, one FAP that fails decides"),
                ("robust", "Robust", "Their geometric mean, FAPs that were not seen left out: forgiving"),
            ),
            default="paper",
            update=_changed,
        ),
    ]
    all_faps: Annotated[
        bool,
        BoolProperty(
            name="All FAPs",
            description="List every FAP that the face shows, not only those that the most believed profile asks for",
            default=False,
        ),
    ]
    stream: Annotated[str, _file("FAP File", "A .fap file of the measured FAPs to write")]
    table: Annotated[str, _file("Table", "A .csv table of beliefs and FAPs to write, a row per frame")]
    plot: Annotated[str, _file("Plot", "A .png picture of the plot to write")]
