"""What a row of a table of jobs may say: each column with its default, unit and range.

The manual's table (docs/batch.md) is made from this (`reference`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType
from typing import TypeAlias

#: What a cell says, read; None where it is left out and nothing stands for it.
Value: TypeAlias = "str | int | float | bool | tuple[str, ...] | None"


class Kind(StrEnum):
    """How a cell is read."""

    TEXT = "text"
    FILE = "file"
    NUMBER = "number"
    WHOLE = "whole number"
    FLAG = "yes or no"
    CHOICE = "one of"
    CHOICES = "some of"
    COLOUR = "#rrggbb"
    SIZE = "pixels"


@dataclass(frozen=True)
class Column:
    """One column.

    Attributes
    ----------
    default : what an empty cell stands for; None where `about` says it.
    about : what it is, for people.
    unit, least, most : of a number.
    options : of a choice.
    """

    name: str
    kind: Kind
    default: Value
    about: str
    unit: str = ""
    least: float | None = None
    most: float | None = None
    options: tuple[str, ...] = ()


#: What a job can make.
OUTPUTS = ("still", "film", "blend", "glb", "fap", "labels")


def _number(name: str, default: float | None, least: float, most: float, unit: str, about: str) -> Column:
    """A column of numbers."""
    return Column(name, Kind.NUMBER, default, about, unit, least, most)


COLUMNS = (
    Column("id", Kind.TEXT, None, "name of the clip's folder (default: made from what the row says)"),
    Column("note", Kind.TEXT, "", "anything you want to keep with the clip: a condition, a group"),
    # Whose face
    Column("head", Kind.FILE, None, "the neutral face: .npz, .obj, .blend, .glb or .gltf (default: the default head)"),
    Column("object", Kind.TEXT, None, "the object of the file that has the face (default: found)"),
    Column("points", Kind.FILE, None, "its feature points, JSON (default: found)"),
    # What it shows
    Column("emotion", Kind.TEXT, None, "an emotion word; with `text`, what is felt while speaking"),
    _number("angle", None, -360.0, 360.0, "degrees", "instead of a word: a direction on the emotion wheel"),
    _number("activation", None, 1.0, 7.0, "", "how strongly it is felt (default: the word's own; `angle` needs one)"),
    Column("variant", Kind.TEXT, None, "how it shows: `bared`, `closed` ..., or the number of the paper's variant"),
    Column("fap", Kind.FILE, None, "instead: a stream of FAPs or a tracker's recording"),
    Column("text", Kind.TEXT, None, "instead: what is said, by a voice of eSpeak NG"),
    Column("voice", Kind.TEXT, "en", "language of `text`: `en`, `de`, `en+f3` ..."),
    _number("speed", 175.0, 80.0, 450.0, "words per minute", "of `text`"),
    _number("voice_pitch", 50.0, 0.0, 99.0, "", "of the voice"),
    _number("articulation", 1.0, 0.0, 2.0, "", "how distinctly the lips move while speaking"),
    _number("jaw", 1.0, 0.0, 2.0, "", "how far the jaw opens while speaking"),
    _number("lean", 1.0, 0.0, 2.0, "", "how far the mouth leans to the emotion while speaking"),
    Column(
        "seed",
        Kind.WHOLE,
        None,
        "draws the expression within its ranges, and blinks and small motions (default: the middle, as is usual)",
        least=0,
        most=2**31 - 1,
    ),
    _number("variation", 1.0, 0.0, 1.0, "", "how far `seed` draws the expression away from the middle"),
    # When
    Column(
        "timing",
        Kind.CHOICE,
        "natural",
        "how the expression comes and goes",
        options=("flash", "natural", "posed", "spontaneous", "slow"),
    ),
    _number("onset", None, 0.0, 600.0, "s", "to appear (default: of `timing`)"),
    _number("apex", None, 0.0, 600.0, "s", "to stay (default: of `timing`)"),
    _number("offset", None, 0.0, 600.0, "s", "to fade (default: of `timing`)"),
    _number("before", 0.2, 0.0, 60.0, "s", "of the neutral face before the onset"),
    _number("after", 0.2, 0.0, 60.0, "s", "of the neutral face after the offset"),
    _number("fps", None, 1.0, 240.0, "frames per second", "of all that moves (default: 25; of `fap`, its own)"),
    # How it moves
    _number("liveliness", 0.0, 0.0, 3.0, "", "blinks and small motions of head and eyes; 1 is as usual at rest"),
    _number("blinks", None, 0.0, 120.0, "per minute", "(default: of `liveliness`)"),
    _number("head_motion", None, 0.0, 3.0, "", "(default: of `liveliness`)"),
    _number("eye_motion", None, 0.0, 3.0, "", "(default: of `liveliness`)"),
    Column("tissue", Kind.CHOICE, "default", "what the skin is like", options=("default", "young", "aged", "stiff")),
    Column(
        "drive",
        Kind.CHOICE,
        "natural",
        "from FAPs to muscles",
        options=("natural", "exact", "muscles", "points"),
    ),
    Column("max_keys", Kind.WHOLE, None, "at most so many shape keys in .blend and .glb (default: no limit)", least=1),
    Column("creases", Kind.FLAG, None, "draw wrinkles, in Cycles and EEVEE (default: on the default head)"),
    # How it is pictured
    Column("engine", Kind.CHOICE, "WORKBENCH", "who draws", options=("WORKBENCH", "EEVEE", "CYCLES")),
    Column("size", Kind.SIZE, "512x512", "width and height, or one number for both; even", "pixels", 16, 8192),
    Column("samples", Kind.WHOLE, 16, "rays per pixel, in Cycles", least=1, most=16384),
    _number("yaw", 0.0, -180.0, 180.0, "degrees", "how far the camera stands to the subject's left"),
    _number("pitch", 0.0, -89.0, 89.0, "degrees", "how far the camera stands above the face"),
    _number("roll", 0.0, -180.0, 180.0, "degrees", "how far the camera is turned clockwise about its line of sight"),
    _number("lens", 85.0, 10.0, 1000.0, "mm", "focal length, for a picture 24 mm high"),
    _number("distance", None, 0.05, 100.0, "m", "from camera to face (default: the face fills the picture)"),
    _number("light", 1.0, 0.0, 20.0, "", "how strong the lights are, as a multiple of the usual"),
    _number("light_yaw", 0.0, -180.0, 180.0, "degrees", "how far the lights are turned to the subject's left"),
    _number("ambient", 0.35, 0.0, 5.0, "", "how much of the background's light falls on the face, in Cycles and EEVEE"),
    Column("skin", Kind.COLOUR, None, "colour of the skin, sRGB (default: the head's own)"),
    Column("background", Kind.COLOUR, "#73767a", "colour behind the face, sRGB"),
    _number("still_at", None, 0.0, 3600.0, "s", "from the beginning, of the still (default: the end of the apex)"),
    Column(
        "label_pictures",
        Kind.WHOLE,
        10,
        "areas, depth and normals of every n-th frame of a film, from the first on; 0: none; of a still always",
        least=0,
        most=100000,
    ),
    Column("licence", Kind.TEXT, None, "of the head, for the data card of labels"),
    Column("outputs", Kind.CHOICES, ("film",), "what to make, with blanks between", options=OUTPUTS),
)

BY_NAME: Mapping[str, Column] = MappingProxyType({column.name: column for column in COLUMNS})

#: What tells a row from others for people alone: two rows that differ in these make the same.
ASIDE = ("id", "note")


def range_of(column: Column) -> str:
    """The values that a column takes, for people."""
    if column.options:
        return ", ".join(column.options)
    if column.least is None:
        return str(column.kind)
    return f"{column.least:g} or more" if column.most is None else f"{column.least:g} to {column.most:.12g}"


def default_of(column: Column) -> str:
    """What an empty cell stands for, for people."""
    if column.default in (None, ""):
        return ""
    if isinstance(column.default, tuple):
        return " ".join(column.default)
    return f"{column.default:g}" if isinstance(column.default, float) else str(column.default)


def reference() -> str:
    """All columns as a table of Markdown."""
    lines = ["| column | what it says | values | unit | default |", "|---|---|---|---|---|"]
    for column in COLUMNS:
        cells = (f"`{column.name}`", column.about, range_of(column), column.unit, default_of(column))
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"
