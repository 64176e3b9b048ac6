"""Tables that are laid out otherwise: a row for each score, or a row for each shape and a column for each frame."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import replace

from ....tables import parsed_number
from .row_names import numbers_at_end, plain_name, tells_of_a_row, tells_the_frame
from .shape_names import shape_named
from .table_file import TableFile

#: Names of a score, where each has a row or an entry of its own.
SCORES = ("score", "value", "weight", "coefficient", "amount", "strength", "intensity")
#: Rows that are looked at, to tell what a column holds.
LOOKED_AT = 200
#: A sideways table has more frames than this.
FEW = 3


def frame_by_frame(table: TableFile) -> TableFile:
    """A table with a row for each frame, made of one that has a row for each score or shape; else as it is."""
    if any(shape_named(name) is not None for name in table.columns):
        return table
    named = next((place for place in range(len(table.columns)) if _names_shapes(table, place)), None)
    if named is None:
        return table
    others = [place for place in range(len(table.columns)) if place != named]
    return _turned(table, named, others) or _gathered(table, named, others) or table


def by_frame(keys: Iterable[Hashable], names: Iterable[str]) -> list[int]:
    """Which frame each score is of: a new one begins with another key, or where a name repeats."""
    frames: list[int] = []
    before: Hashable = None
    seen: set[str] = set()
    for key, name in zip(keys, names, strict=True):
        begins = not frames or key != before or name in seen
        seen = {name} if begins else seen | {name}
        frames.append((frames[-1] if frames else -1) + begins)
        before = key
    return frames


def _names_shapes(table: TableFile, place: int) -> bool:
    """Whether most cells of a column are names of blend shapes."""
    cells = [row[place] for row in table.rows[:LOOKED_AT]]
    return 2 * sum(shape_named(cell) is not None for cell in cells) > len(cells)


def _turned(table: TableFile, named: int, others: Sequence[int]) -> TableFile | None:
    """A sideways table set upright; None where the columns are no frames."""
    places = [place for place in others if table.columns[place] and plain_name(table.columns[place]) != "index"]
    heads = [table.columns[place] for place in places]
    numbers = [parsed_number(head) for head in heads]
    if len(places) <= FEW or (None in numbers and numbers_at_end(heads) is None):
        return None
    whole = all(number is None or float(number).is_integer() for number in numbers)
    columns = ("frame" if whole else "timestamp", *(row[named] for row in table.rows))
    stamps = heads if None not in numbers else [f"{number:g}" for number in numbers_at_end(heads) or ()]
    rows = tuple((stamp, *(row[place] for row in table.rows)) for stamp, place in zip(stamps, places, strict=True))
    return replace(table, columns=columns, rows=rows, lines=(table.lines[0],) * len(rows))


def _gathered(table: TableFile, named: int, others: Sequence[int]) -> TableFile | None:
    """The rows of each frame as one; None where none of the columns is the score."""
    scores = [place for place in others if plain_name(table.columns[place]) in SCORES]
    scores = scores or [place for place in others if not tells_of_a_row(table.columns[place])]
    if len(scores) != 1:
        return None
    keys = [place for place in others if tells_the_frame(table.columns[place])]
    names = list(dict.fromkeys(row[named] for row in table.rows))
    frames = by_frame((tuple(row[key] for key in keys) for row in table.rows), (row[named] for row in table.rows))
    cells: list[dict[str, str]] = [{} for _ in range(frames[-1] + 1)]
    first = [0] * len(cells)
    for number, frame in reversed(list(enumerate(frames))):
        cells[frame][table.rows[number][named]] = table.rows[number][scores[0]]
        first[frame] = number
    rows = tuple(
        (*(table.rows[number][key] for key in keys), *(of_frame.get(name, "") for name in names))
        for number, of_frame in zip(first, cells, strict=True)
    )
    columns = (*(table.columns[key] for key in keys), *names)
    return replace(table, columns=columns, rows=rows, lines=tuple(table.lines[number] for number in first))
