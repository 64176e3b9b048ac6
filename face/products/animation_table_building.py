"""Face Animation Tables from the muscle model: the face is posed at every border of every FAP."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache

import numpy as np

from ...arrays import Floats, Ints
from ...errors import ParameterError
from ...mpeg4 import ANGLE_UNIT, FAP_COUNT, FAPS, GROUPS
from ...progress import Progress, Report
from ...tables import read_csv
from ..drive.natural.synergies import load_synergies, template_unit
from ..drive.request import Drive
from ..face import Face
from ..figures import ANATOMY
from ..mesh.fap_units import unit_length
from ..mesh.parts import Part
from .animation_tables import AnimationTable, AnimationTables, TableError, slopes_of


class Others(StrEnum):
    """What the points of all other FAPs do while a table's FAP moves its own.

    still : they stay, so that the FAPs of a played frame add up to themselves (default): for streams that state what
        every part of the face does, as measured ones do.
    free : they follow as the skin and the jaw take them: for streams of few FAPs; it counts twice what is stated too.
    """

    STILL = "still"
    FREE = "free"


LOW_LEVEL = tuple(number for number, fap in FAPS.items() if not fap.high_level)
STEPS = 4

#: Lower teeth and tongue are the mandible's: only the FAPs of jaw, tongue and head move them. (A lowered lip is partly
#: the jaw's work where muscles explain it; in a sum of tables the teeth would go down twice.)
INNER_PARTS = (Part.TEETH_LOWER, Part.TONGUE)
INNER_FAPS = (*GROUPS[6], *GROUPS[7], 3, 14, 15)

#: open_jaw takes lips and chin along; see `_Solver.carried`.
JAW = 3

#: Vertices that never move farther than this share of the distance of the pupils (6 micrometres) are left out.
MOVED = 1e-4


@lru_cache(maxsize=1)
def table_ranges() -> Mapping[int, tuple[float, float]]:
    """FAP number -> smallest and largest value that tables reach for, FAP units, from presets/anatomy."""
    data = load_synergies()
    ranges = {
        int(number): (float(low) / template_unit(int(number)), float(high) / template_unit(int(number)))
        for number, low, high in zip(data.numbers, data.low, data.high, strict=True)
    }
    for row in read_csv(ANATOMY / "table_ranges.csv"):
        ranges[row.integer("fap", least=3, most=FAP_COUNT)] = row.number("low"), row.number("high")
    return ranges


def table_borders(number: int, steps: int = STEPS) -> Ints:
    """Borders (b,) of a FAP's intervals, whole units: `steps` on either side of 0, as far as anatomy goes."""
    low, high = table_ranges()[number]
    shares = np.arange(1, steps + 1) / steps
    sides = np.concatenate([low * shares, [0.0], high * shares])
    return np.unique(np.rint(sides).astype(np.int64))


def face_animation_tables(
    face: Face,
    *,
    faps: Iterable[int] = LOW_LEVEL,
    steps: int = STEPS,
    drive: str | Drive = Drive.EXACT,
    others: str | Others = Others.STILL,
    progress: Report | None = None,
) -> AnimationTables:
    """The Face Animation Tables of a face.

    Parameters
    ----------
    face : whose; posing it takes `2 * steps` solutions of each FAP on either side of 0, the half of them for the error.
    faps : which low-level FAPs; all by default.
    steps : intervals on either side of 0.
    drive : how the face is posed (`Drive`).
    others : what the other FAPs' points do meanwhile (`Others`).
    progress : called after each FAP.

    Raises
    ------
    ParameterError : no low-level FAP, steps below 1, an unknown drive.

    Examples
    --------
    >>> tables = api.face_animation_tables(api.default_face(), faps=[3], steps=1)
    >>> list(tables.tables)
    [3]
    """
    numbers = sorted(set(faps))
    if not numbers or not set(numbers) <= set(LOW_LEVEL):
        raise ParameterError("faps", f"must be low-level FAPs, {LOW_LEVEL[0]}..{LOW_LEVEL[-1]}", numbers)
    if steps < 1:
        raise ParameterError("steps", "must be 1 or more", steps)
    for name, choices, value in (("drive", Drive, drive), ("others", Others, others)):
        if value not in list(choices):
            raise ParameterError(name, f"must be one of {', '.join(choices)}", value)
    tables: dict[int, AnimationTable] = {}
    solver = _Solver(face, Drive(drive), Others(others), tables)
    jaw_last = sorted(numbers, key=lambda number: number == JAW)
    for done, table in enumerate(_tables(solver, jaw_last, steps), start=1):
        if table is not None:
            tables[table.fap] = table
        if progress is not None:
            progress(Progress.counted(done, len(numbers), "FAPs"))
    return AnimationTables(face.vertices.copy(), dict(sorted(tables.items())))


@dataclass(frozen=True)
class _Solver:
    """Poses a face for one FAP."""

    face: Face
    drive: Drive
    others: Others
    tables: Mapping[int, AnimationTable]  # those that are there already

    def shift(self, number: int, value: float) -> Floats:
        """(V, 3) metres that all vertices move at a value of one FAP."""
        if value == 0.0:
            return np.zeros_like(self.face.vertices)
        if number == JAW and self.others is Others.STILL:
            return self.carried(value)
        shift = self.posed(number, value, 0.0 if self.others is Others.STILL else np.nan)
        if number not in INNER_FAPS:
            shift[np.isin(self.face.parts, INNER_PARTS)] = 0.0
        return shift

    def posed(self, number: int, value: float, other: float) -> Floats:
        """(V, 3) metres between rest and the pose of one FAP, all others at a value."""
        faps = np.full(FAP_COUNT, other)
        faps[number - 1] = value
        return np.asarray(self.face.pose(faps, drive=self.drive).positions - self.face.vertices, dtype=np.float64)

    def carried(self, value: float) -> Floats:
        """(V, 3) metres of the jaw: it takes lips and chin along, and what their own tables do of that is taken off.

        Played together with lips that go down, this is an opening jaw. (Lips and chin held by force while the jaw opens
        leave spikes between the points that are held.) FAPs without a table follow the jaw.
        """
        shift = self.posed(JAW, value, np.nan)
        seen = self.face.measure(self.face.vertices + shift)
        for number, table in self.tables.items():
            if number not in (JAW, *GROUPS[6], *GROUPS[7]) and not np.isnan(seen[number - 1]):
                shift[table.vertices] -= table.displacement(float(seen[number - 1]))
        return shift


def _tables(solver: _Solver, numbers: Iterable[int], steps: int) -> Iterator[AnimationTable | None]:
    """A table for each FAP; None where nothing moves."""
    units = solver.face.units
    for number in numbers:
        fap = FAPS[number]
        unit = ANGLE_UNIT if fap.angular else unit_length(fap.unit, units)
        borders = table_borders(number, steps)
        shifts = np.stack([solver.shift(number, int(value)) for value in borders])
        moving = np.flatnonzero(np.linalg.norm(shifts, axis=2).max(axis=0) > MOVED * units.es0)
        if len(moving):
            table = AnimationTable(number, unit, borders, moving, slopes_of(borders, shifts[:, moving], unit))
            yield replace(table, error=_error(solver, table))
        else:
            yield None


def _error(solver: _Solver, table: AnimationTable) -> TableError:
    """Against the full solution in the middle of every interval."""
    between = (table.borders[:-1] + table.borders[1:]) / 2.0
    solved = np.stack([solver.shift(table.fap, float(value))[table.vertices] for value in between])
    played = np.stack([table.displacement(float(value)) for value in between])
    return distance(played, solved)


def distance(played: Floats, solved: Floats) -> TableError:
    """How far (..., 3) positions lie apart."""
    apart = np.linalg.norm(played - solved, axis=-1)
    return TableError(float(np.sqrt((apart**2).mean())), float(apart.max(initial=0.0)))
