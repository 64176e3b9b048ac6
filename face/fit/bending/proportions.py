"""Where points on smooth skin lie by a face's proportions, told by points that the skin's shape does tell."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache

import numpy as np

from ....arrays import Floats
from ....resources import PRESETS
from ....tables import read_csv

FILE, BROWS_FILE = (PRESETS / "anatomy" / f"{name}.csv" for name in ("point_proportions", "brow_places"))
#: What brows are told from: the eye's inner corner, and the width of both eyes.
BROW_ORIGIN, BROW_UNIT = "3.11", ("3.12", "3.7")


class View(Enum):
    """Where a face is looked at from; the value is the axes of the picture: across and up."""

    FRONT = (0, 2)
    SIDE = (1, 2)


@dataclass(frozen=True)
class Proportion:
    """A row of presets/anatomy/point_proportions.csv.

    Attributes
    ----------
    point : the feature point, on the subject's left.
    view : from where the other points are seen.
    origin, start, end : feature points; the unit is the way from `start` to `end`.
    along, across : from `origin`, along that way and at a right angle to it, units.
    share : how much this counts beside the bent template, 0 to 1.
    """

    point: str
    view: View
    origin: str
    start: str
    end: str
    along: float
    across: float
    share: float

    def place(self, places: Mapping[str, Floats], twins: Mapping[str, str], *, left: bool) -> Floats:
        """(3,) where the point, or its twin on the right, shall lie; the depth of the view stays.

        Parameters
        ----------
        places : name -> (3,) template coordinates; the middle of the face is at x = 0.
        twins : feature point -> the one on the other side.
        """
        flip = np.array([1.0 if left else -1.0, 1.0, 1.0])
        point, origin, start, end = (
            places[name if left else twins.get(name, name)] * flip
            for name in (self.point, self.origin, self.start, self.end)
        )
        picture = list(self.view.value)
        way = (end - start)[picture]
        told = origin[picture] + self.along * way + self.across * np.array([-way[1], way[0]])
        there = point.copy()
        there[picture] += self.share * (told - point[picture])
        return np.asarray(there * flip)


@lru_cache(maxsize=1)
def read_proportions() -> tuple[Proportion, ...]:
    """The table of proportions.

    Raises
    ------
    FormatError : a row that is none.
    """
    return tuple(
        Proportion(
            point=row.text("point"),
            view=View[row.choice("view", ("front", "side")).upper()],
            origin=row.text("origin"),
            start=row.text("from"),
            end=row.text("to"),
            along=row.number("along"),
            across=row.number("across"),
            share=row.number("share", least=0.0, most=1.0),
        )
        for row in read_csv(FILE)
    )


@lru_cache(maxsize=1)
def read_brow_places() -> tuple[Proportion, ...]:
    """Where most people have their brows; the default head's are drawn higher.

    Raises
    ------
    FormatError : a row that is none.
    """
    return tuple(
        Proportion(
            row.text("point"), View.FRONT, BROW_ORIGIN, *BROW_UNIT, row.number("aside"), row.number("up"), share=1.0
        )
        for row in read_csv(BROWS_FILE)
    )
