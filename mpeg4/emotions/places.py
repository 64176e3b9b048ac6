"""Places of the face: FAPs that move together, what profiles usually ask of them, and how far places have moved."""

from __future__ import annotations

from functools import cache

import numpy as np

from ...arrays import Bools, Floats
from ..standard import FAP_COUNT
from .fuzzy import archetype_classes

#: FAPs that move together: contours of a lip, chin and jaw, both lids of a kind, both brows at one place, cheeks, nose.
TOGETHER = (
    (3, 18),
    (4, 8, 9, 51, 55, 56),
    (5, 10, 11, 52, 57, 58),
    (6, 7, 53, 54),
    (12, 13, 59, 60),
    (19, 20),
    (21, 22),
    (31, 32),
    (33, 34),
    (35, 36),
    (37, 38),
    (39, 40),
    (41, 42),
    (61, 62),
)

#: The chin's FAP: it rises where the jaw, with which it goes, opens less.
CHIN = 18

#: So many places that moved most tell whether a face rests and how much it moves.
MOVED_MOST = 3


@cache
def usual() -> Floats:
    """(68,) the median of what profiles of Table 5 ask of a FAP, of FAPs that move together the largest; 0: no profile
    asks for it."""
    asked = np.full((len(archetype_classes()), FAP_COUNT), np.nan)
    for row, fuzzy in enumerate(archetype_classes().values()):
        asked[row, list(fuzzy.indices)] = np.abs(fuzzy.centres)
    sizes = np.zeros(FAP_COUNT)
    some = ~np.isnan(asked).all(axis=0)
    sizes[some] = np.nanmedian(asked[:, some], axis=0)
    for numbers in TOGETHER:
        columns = np.array([number - 1 for number in numbers if some[number - 1]], dtype=np.int64)
        sizes[columns] = sizes[columns].max(initial=0.0)
    sizes.flags.writeable = False
    return sizes


def known(asked: Bools) -> Bools:
    """(k, 68) FAPs that profiles ask for (k, 68), with those that move together with them."""
    found = asked.copy()
    for numbers in TOGETHER:
        columns = [number - 1 for number in numbers]
        found[:, columns] |= asked[:, columns].any(axis=1, keepdims=True)
    return found


@cache
def places() -> tuple[list[int], ...]:
    """Columns of the FAPs that profiles ask for, by the places of the face that they move: `TOGETHER`, others alone."""
    together = [[number - 1 for number in numbers] for numbers in TOGETHER]
    alone = [[column] for column in range(FAP_COUNT) if not any(column in columns for columns in together)]
    asked = [[column for column in columns if usual()[column] > 0.0] for columns in (*together, *alone)]
    return tuple(columns for columns in asked if columns)


def by_place(values: Floats, sure: Floats) -> Floats:
    """(n, p) means of values (n, 68) over the seen FAPs of each place, weighed by how sure they are.

    That is what the place does as a whole, without each FAP's own noise.
    """
    along = np.where(np.arange(FAP_COUNT) == CHIN - 1, -1.0, 1.0) * values * sure
    seen = sure > 0.0
    return np.stack(
        [along[:, columns].sum(axis=1) / np.maximum(seen[:, columns].sum(axis=1), 1) for columns in places()], axis=1
    )


def largest(moved: Floats) -> Floats:
    """(n,) mean of the places that moved most, of (n, p)."""
    return np.asarray(np.sort(moved, axis=1)[:, -MOVED_MOST:].mean(axis=1))
