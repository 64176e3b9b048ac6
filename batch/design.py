"""Designs: factors and their levels as the rows of a table of jobs.

    kind = "counterbalanced"          # grid, random or counterbalanced
    count = 60                        # rows
    draw = 1                          # what is drawn by chance is drawn by this

    [factors]
    emotion = ["joy", "fear", "anger"]
    activation = { least = 3, most = 7, steps = 5 }
    yaw = { least = -30, most = 30 }  # drawn anew in each row

    [constants]
    outputs = "film labels"

In one line: "emotion=joy,fear,anger activation=3..7/5 yaw=-30..30 outputs=film+labels kind=counterbalanced count=60".
The first rows of a design stay as they are when it gets more.
"""

from __future__ import annotations

import itertools
import math
import os
import re
import shlex
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import TypeAlias

import numpy as np

from ..errors import FormatError, ParameterError
from ..files import read_bytes, write_whole
from ..tables import TomlTable, csv_text, read_toml
from .columns import BY_NAME
from .jobs import file_columns

#: What a table says in one row of one column.
Level: TypeAlias = str
#: Rows of a design, at most; digits that number them.
MOST, DIGITS = 1_000_000, 6
#: Rows that are weighed against one another for the next one of a counterbalanced design.
WEIGHED = 2000
#: Letters of a design that is a line.
LONGEST_LINE = 100_000
#: Cells that are shuffled as a list.
SHUFFLED = 10_000_000
#: The keys of a design beside its factors.
KEYS = ("kind", "count", "repeats", "draw")
#: A range in a line: 3..7, 3..7/5.
RANGE = re.compile(r"(-?[\d.]+(?:e-?\d+)?)\.\.(-?[\d.]+(?:e-?\d+)?)(?:/([0-9]{1,18}))?")


class Kind(StrEnum):
    """How levels come together."""

    GRID = "grid"
    RANDOM = "random"
    COUNTERBALANCED = "counterbalanced"


@dataclass(frozen=True)
class Drawn:
    """A factor that is drawn anew in each row, evenly from `least` to `most`, in whole numbers where both are."""

    least: float
    most: float
    whole: bool

    def level(self, rng: np.random.Generator) -> Level:
        """One draw."""
        if self.whole:
            return str(int(rng.integers(int(self.least), int(self.most) + 1)))
        return f"{rng.uniform(self.least, self.most):.6g}"


@dataclass(frozen=True)
class Design:
    """Factors, each with its levels or a range; `constants` are the same in all rows.

    Attributes
    ----------
    count : rows; None: those of the whole grid, `repeats` times.
    draw : seed of all that is drawn.
    """

    factors: Mapping[str, tuple[Level, ...] | Drawn]
    constants: Mapping[str, Level]
    kind: Kind = Kind.GRID
    count: int | None = None
    repeats: int = 1
    draw: int = 0

    def __post_init__(self) -> None:
        for name in (*self.factors, *self.constants):
            if name not in BY_NAME or name == "id":
                raise ParameterError("a factor", "must be a column of the table", name)
        if not self.factors:
            raise ParameterError("factors", "must be at least one", 0)
        if self.kind is not Kind.GRID and self.count is None:
            raise ParameterError("count", f"must say how many rows a {self.kind} design has", self.count)
        if self.kind is Kind.GRID and self.count is not None:
            raise ParameterError("count", "must be left out of a grid, which has all its rows: use repeats", self.count)
        if self.row_count > MOST:
            raise ParameterError("rows of a design", f"must be {MOST} or fewer", self.row_count)
        varies = any(isinstance(factor, Drawn) for factor in self.factors.values())
        if self.row_count > self.cells * (1 if not varies else MOST):
            rule = f"must be {self.cells} or fewer, or clips would be the same: let a factor be drawn, as seed=0..9999"
            raise ParameterError("rows of a design", rule, self.row_count)

    @property
    def cells(self) -> int:
        """Rows of the grid of all levels."""
        return math.prod(len(levels) for levels in self.factors.values() if not isinstance(levels, Drawn))

    @property
    def row_count(self) -> int:
        """Number of rows."""
        return self.cells * self.repeats if self.count is None else self.count


def rows_of(design: Design) -> Iterator[dict[str, Level]]:
    """The rows of a design, with an id each."""
    levels = {name: each for name, each in design.factors.items() if not isinstance(each, Drawn)}
    drawn = {name: each for name, each in design.factors.items() if isinstance(each, Drawn)}
    chosen = {Kind.GRID: _grid, Kind.RANDOM: _random, Kind.COUNTERBALANCED: _balanced}[design.kind]
    rng = np.random.default_rng((design.draw, 1))
    for number, cell in enumerate(chosen(list(levels.values()), design), start=1):
        row = {"id": f"d{number:0{DIGITS}d}", **dict(zip(levels, cell, strict=True))}
        row |= {name: each.level(rng) for name, each in drawn.items()}
        yield {**row, **design.constants}


def _grid(levels: Sequence[Sequence[Level]], design: Design) -> Iterator[tuple[Level, ...]]:
    """All cells, again and again."""
    for _ in range(design.repeats):
        yield from itertools.product(*levels)


def _random(levels: Sequence[Sequence[Level]], design: Design) -> Iterator[tuple[Level, ...]]:
    """Cells by chance; each once before any comes again."""
    rng, cells = np.random.default_rng((design.draw, 0)), math.prod(map(len, levels))
    if cells > SHUFFLED:
        yield from _sparse(levels, design, rng)
        return
    places: list[int] = []
    for _ in range(design.row_count):
        places = places or rng.permutation(cells).tolist()
        place, cell = places.pop(), list[Level]()
        for each in levels:
            place, at = divmod(place, len(each))
            cell.append(each[at])
        yield tuple(cell)


def _sparse(levels: Sequence[Sequence[Level]], design: Design, rng: np.random.Generator) -> Iterator[tuple[Level, ...]]:
    """As `_random`, of so many cells that they are not listed."""
    seen = set[tuple[Level, ...]]()
    while len(seen) < design.row_count:
        cell = tuple(each[int(rng.integers(len(each)))] for each in levels)
        if cell not in seen:
            seen.add(cell)
            yield cell


def _balanced(levels: Sequence[Sequence[Level]], design: Design) -> Iterator[tuple[Level, ...]]:
    """Cells such that, after any number of rows, every level of a factor has come as often as any other, give or take
    one, and every pair of levels as nearly so as is found."""
    rng = np.random.default_rng((design.draw, 0))
    single, pairs, whole = Counter[tuple[int, int]](), Counter[tuple[int, int, int, int]](), Counter[tuple[int, ...]]()
    for _ in range(design.row_count):
        least = [_least_used(single, factor, len(each)) for factor, each in enumerate(levels)]
        if math.prod(map(len, least)) <= WEIGHED:
            candidates = list(itertools.product(*least))
        else:
            candidates = list({tuple(int(rng.choice(each)) for each in least) for _ in range(WEIGHED)})
        order = rng.permutation(len(candidates)).tolist()

        def cost(place: int, candidates: Sequence[tuple[int, ...]] = candidates) -> tuple[int, int]:
            cell = candidates[place]
            return sum(pairs[pair] ** 2 for pair in _pairs(cell)) + whole[cell] ** 2, whole[cell]

        cell = candidates[min(order, key=cost)]
        single.update(enumerate(cell))
        pairs.update(_pairs(cell))
        whole[cell] += 1
        yield tuple(each[at] for each, at in zip(levels, cell, strict=True))


def _least_used(single: Mapping[tuple[int, int], int], factor: int, count: int) -> list[int]:
    """Levels of a factor that have come least often."""
    used = [single[factor, level] for level in range(count)]
    return [level for level in range(count) if used[level] == min(used)]


def _pairs(cell: tuple[int, ...]) -> Iterator[tuple[int, int, int, int]]:
    """Every two levels of a cell."""
    for (first, a), (second, b) in itertools.combinations(enumerate(cell), 2):
        yield first, a, second, b


def read_design(said: str) -> Design:
    """A design from a TOML file, or from one line.

    Raises
    ------
    FormatError, ParameterError : it cannot be read; names what is wrong.
    """
    if said.lower().endswith(".toml"):
        return _from_file(Path(said))
    return _from_line(said)


def _from_file(path: Path) -> Design:
    """A design of a TOML file; files that it names are seen from its folder."""
    document = read_toml(path)
    document.only(*KEYS, "factors", "constants")
    factors, constants = document.table("factors"), document.table("constants", optional=True)
    for table in (factors, constants):
        table.only(*(name for name in BY_NAME if name != "id"))
    return document.made(
        lambda: Design(
            {name: _factor(factors, name, path.parent) for name in factors},
            {name: _level(constants, name, constants.cells[name], path.parent) for name in constants},
            document.choice("kind", Kind, Kind.GRID),
            document.integer("count", least=1) if "count" in document else None,
            document.integer("repeats", 1, least=1),
            document.integer("draw", 0, least=0),
        )
    )


def _factor(table: TomlTable, name: str, folder: Path) -> tuple[Level, ...] | Drawn:
    """The levels of a factor, or its range."""
    value = table.cells[name]
    if isinstance(value, list) and value:
        return tuple(_level(table, name, each, folder) for each in value)
    if not isinstance(value, dict):
        raise table.refuse("must be a list of levels, or a range: { least = -30, most = 30 }", name)
    inner = table.table(name)
    inner.only("least", "most", "steps")
    least, most = inner.number("least"), inner.number("most")
    whole = isinstance(inner.cells["least"], int) and isinstance(inner.cells["most"], int)
    steps = inner.integer("steps", least=2) if "steps" in inner else None
    return inner.made(lambda: _range(least, most, whole, steps))


def _level(table: TomlTable, name: str, value: object, folder: Path) -> Level:
    """One level as a cell of the table has it."""
    if isinstance(value, list):
        return " ".join(map(str, value))
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, str | int | float):
        raise table.refuse("must be texts, numbers, or true and false", name)
    return _from(folder, name, str(value))


def _from(folder: Path, name: str, value: str) -> str:
    """A level; a file as seen from anywhere."""
    return os.path.abspath(folder / os.path.expanduser(value)) if name in file_columns() and value else value


def _range(least: float, most: float, whole: bool, steps: int | None) -> tuple[Level, ...] | Drawn:
    """A range as levels at equal distances, or drawn."""
    if not (math.isfinite(least) and math.isfinite(most) and least < most):
        raise ParameterError("least", "must be below most", least)
    if steps is not None and steps > MOST:
        raise ParameterError("steps", f"must be {MOST} or fewer", steps)
    if steps is None:
        return Drawn(least, most, whole)
    return tuple(f"{level:.6g}" for level in np.linspace(least, most, steps))


def _from_line(line: str) -> Design:
    """A design of one line."""
    if len(line) > LONGEST_LINE:
        raise ParameterError("--design", f"must have {LONGEST_LINE} letters at most: write a .toml file", line)
    try:
        words = shlex.split(line)
    except ValueError as error:
        raise ParameterError("--design", f"must have its quotes in pairs ({error})", line) from error
    said: dict[str, str] = {}
    for word in words:
        name, equals, value = word.partition("=")
        if not equals or not value or name in said:
            raise ParameterError(
                "--design", "must be a .toml file, or factor=level,level ... with each factor once", word
            )
        said[name] = value
    numbers = {name: said.pop(name) for name in KEYS[1:] if name in said}
    for name, value in numbers.items():
        if not re.fullmatch(r"[0-9]{1,18}", value) or (name != "draw" and int(value) < 1):
            raise ParameterError(name, "must be a whole number", value)
    kind = said.pop("kind", Kind.GRID)
    if kind not in list(Kind):
        raise ParameterError("kind", f"must be one of {', '.join(Kind)}", kind)
    factors: dict[str, tuple[Level, ...] | Drawn] = {}
    for name, value in said.items():
        found = RANGE.fullmatch(value)
        if found is None:
            levels = value.split(",")
            if any(level != level.strip() or not level for level in levels):
                rule = (
                    "must have levels with a comma between and no blanks around: a text with a comma needs a .toml file"
                )
                raise ParameterError(name, rule, value)
            factors[name] = tuple(_from(Path(), name, level) for level in levels)
            continue
        whole = not any("." in part or "e" in part for part in found.group(1, 2))
        factors[name] = _range(_number(found[1]), _number(found[2]), whole, int(found[3]) if found[3] else None)
    options = {name: int(value) for name, value in numbers.items()}
    return Design(factors, {}, Kind(kind), options.get("count"), options.get("repeats", 1), options.get("draw", 0))


def _number(text: str) -> float:
    """A number of a range."""
    try:
        return float(text)
    except ValueError:
        raise ParameterError("--design", "must have numbers in a range", text) from None


def write_design(design: Design, path: Path) -> None:
    """Write the table that a design stands for; one that is there may be the beginning of it, not another.

    Raises
    ------
    FormatError : the table of another design is there, or it cannot be written.
    """
    heading = ["id", *design.factors, *design.constants]
    text = csv_text(heading, ([row[name] for name in heading] for row in rows_of(design)))
    if path.exists() and not text.startswith(read_bytes(path).decode("utf-8", "replace")):
        raise FormatError(path, "is the table of another design: choose another folder, or remove the file")
    write_whole(path, text)
