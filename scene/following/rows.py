"""What a list *Follows the Face* says: its rows, who follows by them, and who stays behind."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from ...face.mesh.parts import Part
from ..blender_types import Object
from ..companions import Companion
from ..refusals import reason
from .kinds import PARTS, Follows

#: Properties of a face that name the object of one part, from before there was a list; scripts set them.
SLOTS = {
    "eyeball_l": Part.EYEBALL_L,
    "eyeball_r": Part.EYEBALL_R,
    "teeth_upper": Part.TEETH_UPPER,
    "teeth_lower": Part.TEETH_LOWER,
    "tongue": Part.TONGUE,
}

#: What an object with several parts follows as.
_EYES = frozenset((Part.EYEBALL_L, Part.EYEBALL_R))
_TEETH = frozenset((Part.TEETH_UPPER, Part.TEETH_LOWER))


@dataclass(frozen=True)
class Row:
    """One object of the list: how it follows, why it cannot, whether the user has said so."""

    obj: Object
    follows: Follows
    why_not: str = ""
    by_hand: bool = False

    def refused(self, *, make_single_user: bool) -> str | None:
        """Why it stays behind, or None. What the user has said to follow and cannot is for the bake to refuse."""
        if self.follows is Follows.NONE:
            why: str | None = self.why_not or "does not follow"
        else:
            why = None if self.by_hand else reason(self.obj, make_single_user=make_single_user)
        return None if why is None else why.removeprefix(self.obj.name).lstrip(": ")


def followers_of(rows: Iterable[Row], *, make_single_user: bool = False) -> tuple[Companion, ...]:
    """The objects that follow a face. What was found by itself and cannot be written to is left out."""
    return tuple(
        Companion(row.obj, PARTS[row.follows]) for row in rows if row.refused(make_single_user=make_single_user) is None
    )


def behind_of(rows: Iterable[Row], *, make_single_user: bool = False) -> tuple[str, ...]:
    """The objects of the list that do not follow, each with the reason."""
    refused = ((row.obj.name, row.refused(make_single_user=make_single_user)) for row in rows)
    return tuple(f"{name} ({why})" for name, why in refused if why is not None)


def staying_of(rows: Iterable[Row], *, make_single_user: bool = False) -> list[Object]:
    """The objects of the list that do not follow: what shows the face shows them, too."""
    return [row.obj for row in rows if row.refused(make_single_user=make_single_user) is not None]


def of_slots(slots: Mapping[str, Object | None]) -> dict[Object, Follows]:
    """The objects that properties of single parts name, and how they follow; one that is named twice has both."""
    named: dict[Object, set[Part]] = {}
    for slot, part in SLOTS.items():
        other = slots.get(slot)
        if other is not None:
            named.setdefault(other, set()).add(part)
    return {other: _together(frozenset(parts)) for other, parts in named.items()}


def _together(parts: frozenset[Part]) -> Follows:
    """How an object of these parts follows."""
    if len(parts) == 1:
        return next(follows for follows, part in PARTS.items() if part is next(iter(parts)))
    return {_EYES: Follows.EYES, _TEETH: Follows.TEETH}.get(parts, Follows.SEVERAL)
