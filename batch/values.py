"""One cell of a table of jobs, read by its column's rule."""

from __future__ import annotations

import contextlib
import re

from ..errors import FormatError
from ..tables import Cells
from .columns import Column, Kind, Value

#: Whole numbers below this are exact as floating point.
EXACT = 2.0**53
YES, NO = ("yes", "true", "1"), ("no", "false", "0")


def read_value(cells: Cells, column: Column) -> Value:
    """What a cell says; the default where it is empty or not there.

    Raises
    ------
    FormatError : names file, line, column, rule and value.
    """
    if column.name not in cells:
        return column.default
    match column.kind:
        case Kind.NUMBER:
            return cells.number(column.name, least=column.least, most=column.most)
        case Kind.WHOLE:
            return _integer(cells, column)
        case Kind.CHOICE:
            return _choice(cells, column)
        case Kind.CHOICES:
            return _choices(cells, column)
        case Kind.FLAG:
            return _flag(cells, column)
        case Kind.COLOUR:
            return _colour(cells, column)
        case Kind.SIZE:
            return _size(cells, column)
        case _:
            return _text(cells, column)


def linear_colour(text: str) -> tuple[float, float, float]:
    """Linear RGB of "#rrggbb", which is sRGB."""
    shares = [int(text[place : place + 2], 16) / 255.0 for place in (1, 3, 5)]
    red, green, blue = (share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4 for share in shares)
    return red, green, blue


def pixels(text: str) -> tuple[int, int]:
    """Width and height of "640x480"."""
    width, height = text.split("x")
    return int(width), int(height)


def _integer(cells: Cells, column: Column) -> int:
    """A whole number; 3.0 is one, as programs write it in a column with gaps."""
    least, most = (None if bound is None else int(bound) for bound in (column.least, column.most))
    with contextlib.suppress(FormatError):
        number = cells.number(column.name, least=least, most=most)
        if number.is_integer() and abs(number) < EXACT:
            return int(number)
    return cells.integer(column.name, least=least, most=most)


def _plain(cells: Cells, name: str) -> str:
    """A cell as text, of whatever type it is in TOML."""
    value = cells.cells[name]
    if isinstance(value, bool):
        return "yes" if value else "no"
    return str(value).strip() if isinstance(value, str | int | float) else "?"


def _text(cells: Cells, column: Column) -> str:
    """Text; a number in TOML, as a variant, is one, too."""
    value = cells.cells[column.name]
    if isinstance(value, int | float) and not isinstance(value, bool):
        return str(value)
    text = cells.text(column.name)
    if any(ord(letter) < 32 for letter in text):
        raise cells.refuse("must be one line of text", column.name)
    return text.strip()


def _choice(cells: Cells, column: Column) -> str:
    """One of the options, in any case of letters."""
    said = _plain(cells, column.name).lower()
    for option in column.options:
        if said == option.lower():
            return option
    raise cells.refuse(f"must be one of {', '.join(column.options)}, but it is {said!r}", column.name)


def _choices(cells: Cells, column: Column) -> tuple[str, ...]:
    """Some of the options, in their own order; in TOML as a list or as a text with blanks."""
    value = cells.cells[column.name]
    words = re.split(r"[\s,;+|]+", value.strip()) if isinstance(value, str) else cells.texts(column.name)
    said = [word.lower() for word in words if word]
    for word in said:
        if word not in column.options:
            raise cells.refuse(f"must be some of {', '.join(column.options)}, but it has {word!r}", column.name)
    if not said:
        raise cells.refuse(f"must be at least one of {', '.join(column.options)}", column.name)
    return tuple(option for option in column.options if option in said)


def _flag(cells: Cells, column: Column) -> bool:
    """Yes or no."""
    said = _plain(cells, column.name).lower()
    if said not in YES + NO:
        raise cells.refuse(f"must be yes or no, but it is {said!r}", column.name)
    return said in YES


def _colour(cells: Cells, column: Column) -> str:
    """A colour as #rrggbb in small letters."""
    said = _plain(cells, column.name).lower()
    if not re.fullmatch(r"#?[0-9a-f]{6}", said):
        raise cells.refuse(f"must be a colour as #rrggbb, such as #c58c6e, but it is {said!r}", column.name)
    return said if said.startswith("#") else f"#{said}"


def _size(cells: Cells, column: Column) -> str:
    """A size as WIDTHxHEIGHT."""
    said = _plain(cells, column.name).lower().replace(" ", "")
    found = re.fullmatch(r"(\d{1,5})(?:[x×](\d{1,5}))?", said)
    sides = [] if found is None else [int(found[1]), int(found[2] or found[1])]
    least, most = int(column.least or 0), int(column.most or 0)
    if not sides or not all(least <= side <= most and side % 2 == 0 for side in sides):
        rule = f"must be even numbers of pixels from {least} to {most}, as 512 or 640x480"
        raise cells.refuse(f"{rule}, but it is {said!r}", column.name)
    return f"{sides[0]}x{sides[1]}"
