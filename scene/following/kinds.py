"""The ways in which an object may follow a face."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum

from ...face.mesh.parts import Part, Told


class Follows(StrEnum):
    """How an object follows a face. Files keep the place in this order: what is new comes last."""

    EYES = "eyes"
    EYE_L = "eye_l"
    EYE_R = "eye_r"
    TEETH = "teeth"
    TEETH_UPPER = "teeth_upper"
    TEETH_LOWER = "teeth_lower"
    TONGUE = "tongue"
    SEVERAL = "several"
    SKIN = "skin"
    SKULL = "skull"
    NONE = "none"


#: What each is to a face; what does not follow is not in it.
PARTS: Mapping[Follows, Part | Told] = {
    Follows.EYES: Told.EYES,
    Follows.EYE_L: Part.EYEBALL_L,
    Follows.EYE_R: Part.EYEBALL_R,
    Follows.TEETH: Told.TEETH,
    Follows.TEETH_UPPER: Part.TEETH_UPPER,
    Follows.TEETH_LOWER: Part.TEETH_LOWER,
    Follows.TONGUE: Part.TONGUE,
    Follows.SEVERAL: Told.ANYTHING,
    Follows.SKIN: Part.OTHER,
    Follows.SKULL: Part.SKULL,
}

#: What lies inside the head; a name of two of them is of several parts.
INNER = frozenset(
    (Follows.EYES, Follows.TEETH, Follows.TEETH_UPPER, Follows.TEETH_LOWER, Follows.TONGUE, Follows.SEVERAL)
)
