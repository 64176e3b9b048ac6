"""The standard's facial animation parameters (FAPs), feature points and FAP units, as data.

Source of every figure: the tables in ``data/`` (ISO/IEC 14496-2, cross-checked in public decoders).
"""

from __future__ import annotations

import difflib
import numbers
import operator
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType
from typing import SupportsIndex, cast

from ..errors import ParameterError
from ..resources import STANDARD
from ..tables import CsvRow, read_csv

FAP_COUNT = 68

FAP_LIMIT = 1e7
"""FAP units that no value exceeds: sixteen turns of the head, and far beyond any length of a face."""

FRAMES_LIMIT = 1_000_000
"""Frames of a stream, at most: eleven hours at 25 a second."""

SLOWEST, FASTEST = 1e-3, 1e5
"""Frames per second: from one in a quarter of an hour to more than any camera has."""


def check_fps(fps: object, name: str = "fps") -> None:
    """Refuse what is no rate of frames.

    Raises
    ------
    ParameterError : it is no number, or so small or large that times are lost in it.
    """
    if not (isinstance(fps, numbers.Real) and SLOWEST <= cast("float", fps) <= FASTEST):
        raise ParameterError(name, f"must be from {SLOWEST:g} to {FASTEST:g} frames per second", fps)


class Unit(StrEnum):
    """FAP units: a 1024th of a distance of the neutral face, or (AU) an angle of 1e-5 rad."""

    IRISD = "IRISD"
    ES = "ES"
    ENS = "ENS"
    MNS = "MNS"
    MW = "MW"
    AU = "AU"


class Motion(StrEnum):
    """Where a positive FAP value moves its feature point; left and right are the subject's."""

    UP = "up"
    DOWN = "down"
    LEFT = "left"
    RIGHT = "right"
    FORWARD = "forward"
    GROWING = "growing"
    CONCAVE_UPWARD = "concave_upward"

    @property
    def direction(self) -> tuple[float, float, float] | None:
        """Unit vector in the head's frame (+X subject's left, -Y out of the face, +Z up); None where it is no shift."""
        return _DIRECTIONS.get(self)


_DIRECTIONS = {
    Motion.UP: (0.0, 0.0, 1.0),
    Motion.DOWN: (0.0, 0.0, -1.0),
    Motion.LEFT: (1.0, 0.0, 0.0),
    Motion.RIGHT: (-1.0, 0.0, 0.0),
    Motion.FORWARD: (0.0, -1.0, 0.0),
}


class Side(StrEnum):
    """The subject's side."""

    LEFT = "left"
    RIGHT = "right"
    MIDDLE = "middle"


@dataclass(frozen=True)
class Fap:
    """One facial animation parameter.

    Attributes
    ----------
    number, name : 1..68 and the standard's name.
    unit : FAP unit; None for the high-level FAPs 1 (viseme) and 2 (expression).
    bidirectional : False where only non-negative values are meant.
    motion : where a positive value moves the point; None for FAPs 1 and 2.
    group, subgroup : the standard's group 1..10 and the place in it (None for FAPs 1 and 2).
    feature_point : the point that moves, as "8.4"; None for FAPs 1 and 2.
    mirror : FAP number of the other side, None in the middle. Equal values are a symmetric face.
    lip_twin : FAP number of the same motion on the other lip contour (inner or outer), None elsewhere.
    quant_step : FAP units per quantiser step of the binary stream.
    intra_limits, inter_limits : coding limits of I and P frames, in quantiser steps.
    confidence, note : how well the row is corroborated, and what a reader should know.
    """

    number: int
    name: str
    unit: Unit | None
    bidirectional: bool
    motion: Motion | None
    group: int
    subgroup: int | None
    feature_point: str | None
    mirror: int | None
    lip_twin: int | None
    quant_step: int | None
    intra_limits: tuple[int, int] | None
    inter_limits: tuple[int, int] | None
    confidence: str
    note: str

    def __post_init__(self) -> None:
        """Refuse a number outside 1..68."""
        if not 1 <= self.number <= FAP_COUNT:
            raise ParameterError("FAP number", f"must be in 1..{FAP_COUNT}", self.number)

    @property
    def high_level(self) -> bool:
        """True for viseme and expression, whose values are sub-fields and no displacement."""
        return self.unit is None

    @property
    def angular(self) -> bool:
        """True where the value is an angle (eyeballs, head, tongue roll)."""
        return self.unit is Unit.AU


@dataclass(frozen=True)
class FeaturePoint:
    """One of the 84 feature points: name "8.4", group and number in it, side, mirror point, place in words."""

    name: str
    group: int
    number: int
    side: Side
    mirror: str | None
    location: str
    faps: tuple[int, ...]
    confidence: str


@dataclass(frozen=True)
class FapuDefinition:
    """How a FAP unit is measured on the neutral face.

    Attributes
    ----------
    unit, symbol, name : as IRISD, "IRISD0", words.
    axis : "vertical" (up) or "lateral" (towards the subject's left); None for the angle unit.
    pairs : the points (a, b): the unit is the coordinate of a minus that of b, of several pairs their mean; none for
        the angle unit.
    divisor : one unit is the distance divided by this; None for the angle unit.
    radians : one unit of the angle unit in rad; None for the distances.
    """

    unit: Unit
    symbol: str
    name: str
    axis: str | None
    pairs: tuple[tuple[str, str], ...]
    divisor: int | None
    radians: float | None


def _whole(row: CsvRow, name: str) -> int | None:
    """A whole number, where the row has one."""
    return row.integer(name) if name in row else None


def _limits(row: CsvRow, low: str, high: str) -> tuple[int, int] | None:
    """A smallest and a largest value, where the row has them."""
    return (row.integer(low), row.integer(high)) if low in row else None


def _read_faps() -> dict[int, Fap]:
    """All rows of faps.csv by number."""
    return {
        row.integer("number", least=1, most=FAP_COUNT): Fap(
            number=row.integer("number"),
            name=row.text("name"),
            unit=row.choice("unit", Unit) if "unit" in row else None,
            bidirectional=row.choice("bidirectional", ("yes", "no"), "no") == "yes",
            motion=row.choice("motion", Motion) if "motion" in row else None,
            group=row.integer("group"),
            subgroup=_whole(row, "subgroup"),
            feature_point=row.text("feature_point", "") or None,
            mirror=_whole(row, "mirror"),
            lip_twin=_whole(row, "lip_twin"),
            quant_step=_whole(row, "quant_step"),
            intra_limits=_limits(row, "intra_min", "intra_max"),
            inter_limits=_limits(row, "inter_min", "inter_max"),
            confidence=row.text("confidence"),
            note=row.text("note", ""),
        )
        for row in read_csv(STANDARD / "faps.csv")
    }


FAPS: Mapping[int, Fap] = MappingProxyType(_read_faps())
"""The 68 FAPs by number."""

_NUMBERS = {entry.name: number for number, entry in FAPS.items()}


def fap(which: str | SupportsIndex) -> Fap:
    """One FAP by its number or name.

    Parameters
    ----------
    which : 1..68, or the standard's name such as "open_jaw".

    Raises
    ------
    ParameterError
        When no FAP has this number or name; the message names the nearest names.

    Examples
    --------
    >>> api.fap("open_jaw").number
    3
    >>> print(api.fap(3).unit)
    MNS
    """
    if isinstance(which, str):
        if which in _NUMBERS:
            return FAPS[_NUMBERS[which]]
        near = difflib.get_close_matches(which, _NUMBERS, n=3)
        hint = f"; did you mean {' or '.join(near)}?" if near else ""
        raise ParameterError("FAP name", f"must be a name of the standard such as 'open_jaw'{hint}", which)
    try:
        return FAPS[operator.index(which)]
    except (KeyError, TypeError):
        raise ParameterError("FAP number", f"must be a whole number in 1..{FAP_COUNT}", which) from None


def _groups() -> dict[int, tuple[int, ...]]:
    members: dict[int, list[int]] = {}
    for number, entry in FAPS.items():
        members.setdefault(entry.group, []).append(number)
    return {group: tuple(numbers) for group, numbers in members.items()}


GROUPS: Mapping[int, tuple[int, ...]] = MappingProxyType(_groups())
"""FAP numbers of the groups 1..10."""

PAIRS: tuple[tuple[int, int], ...] = tuple(
    (number, entry.mirror) for number, entry in FAPS.items() if entry.mirror is not None and number < entry.mirror
)
"""FAP numbers of the pairs (left, right)."""

LIP_TWINS: tuple[tuple[int, int], ...] = tuple(
    (number, entry.lip_twin) for number, entry in FAPS.items() if entry.lip_twin is not None and number < entry.lip_twin
)
"""FAP numbers of the same motion on the (inner, outer) lip contour."""


def _read_feature_points() -> dict[str, FeaturePoint]:
    """All rows of feature_points.csv by name."""
    return {
        row.text("point"): FeaturePoint(
            name=row.text("point"),
            group=row.integer("group"),
            number=row.integer("number"),
            side=row.choice("side", Side),
            mirror=row.text("mirror", "") or None,
            location=row.text("location"),
            faps=tuple(number for number, entry in FAPS.items() if entry.feature_point == row.text("point")),
            confidence=row.text("confidence"),
        )
        for row in read_csv(STANDARD / "feature_points.csv")
    }


FEATURE_POINTS: Mapping[str, FeaturePoint] = MappingProxyType(_read_feature_points())
"""The 84 feature points by name."""

FAPU_PAIRS = (("point_a", "point_b"), ("other_a", "other_b"))
"""Columns of fapu.csv that hold a pair of points each."""

FAPU: Mapping[Unit, FapuDefinition] = MappingProxyType(
    {
        row.choice("unit", Unit): FapuDefinition(
            unit=row.choice("unit", Unit),
            symbol=row.text("symbol"),
            name=row.text("name"),
            axis=row.text("axis", "") or None,
            pairs=tuple((row.text(a), row.text(b)) for a, b in FAPU_PAIRS if a in row),
            divisor=_whole(row, "divisor"),
            radians=row.number("radians") if "radians" in row else None,
        )
        for row in read_csv(STANDARD / "fapu.csv")
    }
)
"""How each FAP unit is measured."""

ANGLE_UNIT: float = FAPU[Unit.AU].radians or 0.0
"""Radians in one unit of the FAPs that are angles."""
