"""Which FAPs are asked of a face and do not show on it, and why: nothing that is asked is dropped in silence."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..arrays import Floats
from ..mpeg4 import FAPS
from .anatomy import Anatomy

#: What shows of a FAP is nothing where it is less than this share of what is asked, or goes the other way.
NOTHING = 0.02

EYEBALL_FAPS, TONGUE_FAPS, HEAD_FAPS = range(23, 31), range(43, 48), range(48, 51)

#: FAPs that move what they name wherever a face has it. A tongue that is raised may go down with the jaw all the same.
MOVED_DIRECTLY = (*EYEBALL_FAPS, *TONGUE_FAPS, *HEAD_FAPS)


def unmet(
    anatomy: Anatomy, asked: Floats, achieved: Floats, reasons: Mapping[int, str] | None = None
) -> dict[int, str]:
    """FAP number -> why, of FAPs that are asked and of which nothing shows.

    Parameters
    ----------
    asked, achieved : (68,) or (T, 68) FAP units, NaN where silent or not measurable. Over time what is asked most of a
        FAP is compared with what shows most of it.
    reasons : FAP number -> why its goal is not as asked (`Plan.reasons`).
    """
    peak, shown = _peaks(np.atleast_2d(asked), np.atleast_2d(achieved))
    missed = {}
    for number in (np.flatnonzero(np.nan_to_num(peak)) + 1).tolist():
        if FAPS[number].high_level:
            continue
        wanted, found = peak[number - 1], shown[number - 1]
        if found > NOTHING * abs(wanted):
            continue
        why = _lacking(anatomy, number, is_read=not np.isnan(found))
        if not why and number not in MOVED_DIRECTLY:
            why = (reasons or {}).get(number) or f"check feature point {FAPS[number].feature_point}"
        if why:
            missed[number] = why
    return missed


def _peaks(asked: Floats, achieved: Floats) -> tuple[Floats, Floats]:
    """(68,) what is asked most of each FAP, and how far (68,) it is shown in that direction at most."""
    silent = np.isnan(asked)
    largest = np.argmax(np.where(silent, 0.0, np.abs(asked)), axis=0)
    peak = np.take_along_axis(np.where(silent, 0.0, asked), largest[None], axis=0)[0]
    along = achieved * np.sign(peak)
    unknown = np.isnan(along).all(axis=0)
    shown = np.max(np.where(np.isnan(along), -np.inf, along), axis=0)
    return peak, np.where(unknown, np.nan, shown)


def _lacking(anatomy: Anatomy, number: int, *, is_read: bool) -> str:
    """What the face lacks for a FAP; "" where it lacks nothing. `is_read`: the FAP can be measured on it."""
    if number in EYEBALL_FAPS:
        return "" if any(number in ball.fap_numbers for ball in anatomy.eyeballs) else "the face has no such eyeball"
    if number in TONGUE_FAPS:
        return "the face has no tongue" if anatomy.tongue is None else ""
    if is_read or number in MOVED_DIRECTLY:
        return ""
    return f"the face has no feature point {FAPS[number].feature_point} on its skin"


def unmet_lines(missed: Mapping[int, str]) -> tuple[str, ...]:
    """What is asked and does not show, in words for people, a line for each reason.

    Examples
    --------
    >>> api.unmet_lines({31: "check feature point 4.1"})
    ('F31 raise_l_i_eyebrow requested, but nothing shows: check feature point 4.1',)
    """
    named: dict[str, list[str]] = {}
    for number, why in missed.items():
        named.setdefault(why, []).append(f"F{number} {FAPS[number].name}")
    return tuple(f"{', '.join(names)} requested, but nothing shows: {why}" for why, names in named.items())
