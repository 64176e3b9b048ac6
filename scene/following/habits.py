"""How objects of characters are named: from a name to how what is named so follows the face."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cache

from ...resources import PRESETS
from ...tables import read_toml
from .kinds import INNER, Follows

TABLE = PRESETS / "companions.toml"

#: Where a word of a name begins inside it: MouthBag, mouthBag, HTMLBag.
_INSIDE = re.compile(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")


@cache
def habits() -> Mapping[tuple[str, ...], Follows]:
    """Words of a name -> how what has them follows the face."""
    names = read_toml(TABLE).table("names")
    return {tuple(phrase.split()): follows for follows in _ways() for phrase in names.texts(follows)}


def _ways() -> list[Follows]:
    """The ways that names tell."""
    return [follows for follows in Follows if follows not in (Follows.EYE_L, Follows.EYE_R)]


def words_of(name: str) -> tuple[str, ...]:
    """The words of a name, in lower case, without numbers."""
    apart = _INSIDE.sub(" ", name)
    return tuple(word.lower() for word in re.split(r"[\W\d_]+", apart) if word)


def told_by_name(name: str) -> Follows | None:
    """How an object of a name follows the face; None where the name does not tell."""
    found = sorted(_matches(name), key=lambda match: (-len(match[0]), -sum(map(len, match[0]))))
    taken: set[int] = set()
    chosen: list[Follows] = []
    for _, places, follows in found:
        if not taken & places:
            taken |= places
            chosen.append(follows)
    if not chosen or Follows.NONE in chosen:
        return Follows.NONE if chosen else None
    inner = _joined(follows for follows in chosen if follows in INNER)
    if chosen[0] not in INNER:
        return chosen[0]
    return next(iter(inner)) if len(inner) == 1 else Follows.SEVERAL


def _joined(told: Iterable[Follows]) -> set[Follows]:
    """Ways to follow, with both rows of teeth as one."""
    found = set(told)
    rows = found & {Follows.TEETH, Follows.TEETH_UPPER, Follows.TEETH_LOWER}
    return (found - rows) | {Follows.TEETH} if len(rows) > 1 else found


def _matches(name: str) -> Iterable[tuple[tuple[str, ...], frozenset[int], Follows]]:
    """The words known of a name, which of its words they are, and what they tell."""
    words = words_of(name)
    for phrase, follows in habits().items():
        if len(phrase) == 1 and not phrase[0].isascii() and not phrase[0].islower():
            if phrase[0] in name:
                yield phrase, frozenset(), follows
            continue
        for first in range(len(words) - len(phrase) + 1):
            if words[first : first + len(phrase)] == phrase:
                yield phrase, frozenset(range(first, first + len(phrase))), follows


def told_by_names(names: Iterable[str]) -> Follows | None:
    """How an object follows whose materials, or vertex groups, have some names; None where they tell nothing.

    Names of several parts of the face are those of several parts; skin or hair beside them tells nothing.
    """
    told = _joined(follows for name in names if (follows := told_by_name(name)) not in (None, Follows.NONE))
    if len(told) == 1:
        return next(iter(told))
    return Follows.SEVERAL if told and told <= INNER else None
