"""The parts of a face mesh: which vertex is skin, eyeball, tooth or tongue."""

from __future__ import annotations

from enum import IntEnum


class Part(IntEnum):
    """What a vertex belongs to. The numbers are those of the public `parts` arrays and are never changed."""

    SKIN = 0
    EYEBALL_L = 1
    EYEBALL_R = 2
    TEETH_UPPER = 3
    TEETH_LOWER = 4
    TONGUE = 5
    OTHER = 6
