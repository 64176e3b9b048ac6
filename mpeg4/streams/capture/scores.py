"""Scores of blend shapes as FAPs, whatever they are called and on whichever scale they are."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from ....arrays import Floats
from ....errors import FormatError
from .columns import ColumnTable, arkit_columns
from .row_names import plain_name
from .shape_names import Named, shape_named

#: Scores are from 0 to 1; trackers overshoot a little. Beyond this they are none.
MOST, LEAST = 2.0, -1.0

#: A file whose scores go beyond this, and often beyond `MOST`, has them in per cent.
PER_CENT, OFTEN = 5.0, 0.1
MOST_PER_CENT, LEAST_PER_CENT = 150.0, -100.0


def faps_of_scores(
    scores: Mapping[str, Floats], refuse: Callable[[int, str, str], FormatError], *, per_cent: bool = False
) -> tuple[Floats, tuple[str, ...], tuple[str, ...]]:
    """FAPs of blend shapes, what was assumed, and the names that were not read.

    Parameters
    ----------
    scores : name -> (T,) scores; NaN where unknown.
    refuse : the error for a value: its row, its name, the problem.
    per_cent : they are known to go from 0 to 100; else the scale is told by all of them together.

    Returns
    -------
    (T, 68) FAPs; words for people; names that mean no blend shape, or one that another name means already.
    """
    named: dict[Named, str] = {}
    for name in sorted(scores, key=lambda name: len(plain_name(name))):  # what has least beside the shape's name
        shape = shape_named(name)
        if shape is not None:
            named.setdefault(shape, name)
    unread = [name for name in scores if name not in named.values()]
    values, assumed = _in_shares({name: scores[name] for name in named.values()}, refuse, per_cent)
    frames = _table().frames({_column(shape): values[name] for shape, name in named.items()})
    return frames, assumed, tuple(unread)


def _in_shares(
    scores: Mapping[str, Floats], refuse: Callable[[int, str, str], FormatError], per_cent: bool
) -> tuple[dict[str, Floats], tuple[str, ...]]:
    """Scores from 0 to 1, and what was assumed."""
    everything = np.concatenate([*scores.values(), np.zeros(0)])
    known = everything[np.isfinite(everything) & (everything != 0.0)]
    per_cent = per_cent or (bool(len(known)) and known.max() > PER_CENT and bool(np.mean(known > MOST) >= OFTEN))
    least, most = (LEAST_PER_CENT, MOST_PER_CENT) if per_cent else (LEAST, MOST)
    for name, values in scores.items():
        with np.errstate(invalid="ignore"):
            beyond = np.flatnonzero((values > most) | (values < least))
        if len(beyond):
            scale = "0 to 100" if per_cent else "0 to 1"
            problem = f"must be a score from {scale}, but it is {values[beyond[0]]:g}: correct or remove it"
            raise refuse(int(beyond[0]), name, problem)
    if not per_cent:
        return dict(scores), ()
    said = f"its scores go up to {known.max(initial=0.0):g}: taken as per cent"
    return {name: values / 100.0 for name, values in scores.items()}, (said,)


def _column(named: Named) -> str:
    """The column of `columns.arkit_columns` for a shape, or for one side of it."""
    return named.shape if named.side is None else f"{named.shape}_{named.side[0]}"


def _table() -> ColumnTable:
    """The blend shapes and their sides."""
    return arkit_columns()


def unread_words(names: tuple[str, ...] | list[str], *, shown: int = 12) -> tuple[str, ...]:
    """What is said of names that were not read; nothing where all were."""
    if not names:
        return ()
    more = f" and {len(names) - shown} more" if len(names) > shown else ""
    return (f"not read: {', '.join(names[:shown])}{more}",)
