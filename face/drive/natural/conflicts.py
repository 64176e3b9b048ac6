"""Requests beside one another: which are doubted, and which give way."""

from __future__ import annotations

import numpy as np

from ....arrays import Bools, Floats
from .synergies import JAW_FAP, Synergies

LOWER_LIP_FAPS = (5, 10, 11, 52, 57, 58)
CORNER_STRETCH_FAPS = (6, 7, 53, 54)
CORNER_RAISE_FAPS = (12, 13, 59, 60)
UPPER_LID_FAPS = (19, 20)


def doubts(data: Synergies, spread: Floats, asked: Floats, limited: Floats, is_asked: Bools) -> Floats:
    """(m,) doubt in mm about each request: what lies beyond the range, and lips against an open jaw; 0 where silent.

    spread : (m,) mm that action units leave unexplained. asked, limited : (m,) mm before and after the ranges.
    """
    doubt = 0.5 * spread + 0.25 * np.abs(asked - limited)
    jaw = max(float(limited[data.row_of[JAW_FAP]]), 0.0)
    doubt[[data.row_of[number] for number in LOWER_LIP_FAPS]] += 0.35 * jaw
    doubt[data.row_of[JAW_FAP]] += 0.08 * jaw
    for number in CORNER_STRETCH_FAPS:
        if asked[data.row_of[number]] < 0.0:
            doubt[data.row_of[number]] += 0.12 * jaw
    return np.where(is_asked, doubt, 0.0)


def smiling_eyes_spared(data: Synergies, limited: Floats) -> Floats:
    """(m,) requests in mm (0 = none): a smile narrows the eye, so requests to open the upper lids fade with it."""
    spared = limited.copy()
    corners = max(float(limited[data.row_of[number]]) for number in CORNER_RAISE_FAPS)
    smile = float(np.clip(corners / 6.0, 0.0, 1.0))
    for row in (data.row_of[number] for number in UPPER_LID_FAPS):
        if limited[row] < 0.0:
            spared[row] *= 1.0 - 0.9 * smile
    return spared
