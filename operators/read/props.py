"""How faces are read, and what is written of it. Kept with the scene."""

from __future__ import annotations

from bpy.props import BoolProperty, EnumProperty, StringProperty

from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Context
from ..film.props import _RELATIVE


def _changed(owner: RISORIUS_PG_read, context: Context) -> None:
    """Read again."""
    from . import live

    live.ask()


def _file(name: str, what: str) -> object:
    """A file that may be written."""
    about = f"{what}. Empty: none. A path that begins with // is relative to the .blend file"
    return StringProperty(name=name, description=about, subtype="FILE_PATH", options=_RELATIVE)


class RISORIUS_PG_read(PropertyGroup):
    """The rule, what is listed, and files."""

    rule: Annotated[
        str,
        EnumProperty(
            name="Rule",
            description="Rule that turns FAPs into beliefs in emotions",
            items=(
                ("paper", "Paper", "Product over all FAPs, as in the paper. Strict: one FAP that does not fit decides"),
                (
                    "robust",
                    "Robust",
                    "Geometric mean over the measured FAPs. Tolerant: FAPs that cannot be measured are left out. "
                    "Motion that an emotion does not explain counts against it. A face can be neutral",
                ),
            ),
            default="paper",
            update=_changed,
        ),
    ]
    all_faps: Annotated[
        bool,
        BoolProperty(
            name="All FAPs",
            description="List every measured FAP, not only those in the most believed profile",
            default=False,
        ),
    ]
    stream: Annotated[str, _file("FAP File", "FAP file for the measured FAPs")]
    table: Annotated[str, _file("Table", "CSV table for beliefs and FAPs, one row per frame")]
    plot: Annotated[str, _file("Plot", "PNG image for the plot")]
