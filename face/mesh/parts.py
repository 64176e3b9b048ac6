"""The parts of a face mesh: which vertex is skin, eyeball, tooth or tongue."""

from __future__ import annotations

from enum import IntEnum


class Part(IntEnum):
    """What a vertex belongs to. The numbers are those of the public `parts` arrays and are never changed.

    SKIN is moved by muscles; OTHER grows out of the skin and goes with it (lashes, brows, a beard); SKULL goes with the
    head alone (hair, glasses, a hat).
    """

    SKIN = 0
    EYEBALL_L = 1
    EYEBALL_R = 2
    TEETH_UPPER = 3
    TEETH_LOWER = 4
    TONGUE = 5
    OTHER = 6
    SKULL = 7


class Told(IntEnum):
    """What may stand in a `parts` array where the part is not known: what the vertex is among.

    Connected pieces are then told apart by their shape and their place.
    """

    ANYTHING = -1
    EYES = -2
    TEETH = -3
