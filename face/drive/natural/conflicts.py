"""Requests beside one another: which are doubted, and which give way."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....arrays import Bools, Floats
from ...bodies.contact import LOWER_LIP_FAPS
from ...figures import Length, Share, read_figures
from .synergies import JAW_FAP, Synergies

CORNER_STRETCH_FAPS = (6, 7, 53, 54)
CORNER_RAISE_FAPS = (12, 13, 59, 60)
UPPER_LID_FAPS = (19, 20)


@dataclass(frozen=True)
class ConflictFigures:
    """How far requests are doubted, and give way (presets/anatomy/natural.toml)."""

    any: Share
    beyond: Share
    lower_lip: Share
    jaw: Share
    narrowed: Share
    smile: Length
    spared_lids: Share


CONFLICTS = read_figures("natural.conflicts", ConflictFigures)


def doubts(data: Synergies, spread: Floats, asked: Floats, limited: Floats, is_asked: Bools) -> Floats:
    """(m,) doubt in metres about each request, beyond its range and of lips against an open jaw; 0 where silent.

    spread : (m,) metres that action units may miss. asked, limited : (m,) metres before and after the ranges.
    """
    doubt = CONFLICTS.any * spread + CONFLICTS.beyond * np.abs(asked - limited)
    jaw = max(float(limited[data.row_of[JAW_FAP]]), 0.0)
    doubt[[data.row_of[number] for number in LOWER_LIP_FAPS]] += CONFLICTS.lower_lip * jaw
    doubt[data.row_of[JAW_FAP]] += CONFLICTS.jaw * jaw
    for number in CORNER_STRETCH_FAPS:
        if asked[data.row_of[number]] < 0.0:
            doubt[data.row_of[number]] += CONFLICTS.narrowed * jaw
    return np.where(is_asked, doubt, 0.0)


def smiling_eyes_spared(data: Synergies, limited: Floats) -> Floats:
    """(m,) requests in metres (0 = none): a smile narrows the eye, so requests to open the upper lids fade with it."""
    spared = limited.copy()
    corners = max(float(limited[data.row_of[number]]) for number in CORNER_RAISE_FAPS)
    smile = float(np.clip(corners / CONFLICTS.smile, 0.0, 1.0))
    for row in (data.row_of[number] for number in UPPER_LID_FAPS):
        if limited[row] < 0.0:
            spared[row] *= 1.0 - CONFLICTS.spared_lids * smile
    return spared
