"""Where a bake may go: new shape keys, or the controls that the character already has."""

from __future__ import annotations

from enum import StrEnum

from .baking import FindRig
from .bones import bone_rig
from .keys import key_rig


class BakeTo(StrEnum):
    """What is keyed: new shape keys, the character's own ones, or the bones and properties of its rig."""

    NEW = "new"
    KEYS = "keys"
    BONES = "bones"


def find_rig(to: BakeTo) -> FindRig:
    """How the controls of a rig are found."""
    return {BakeTo.KEYS: key_rig, BakeTo.BONES: bone_rig}[to]
