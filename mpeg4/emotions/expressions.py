"""From an emotion word, or a point of the wheel, to a profile: sections 4.1 and 4.2 of Raouzaiou et al. 2002."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from dataclasses import replace

from ...errors import ParameterError
from .archetypes import BASE_WORDS, archetype
from .emotion_presets import WORDS
from .intermediate import between
from .profile import ARCHETYPES, AS_PRINTED, Archetype, Profile, Signs, check_archetype
from .prototypes import check_prototype
from .wheel import ANGLE_TOLERANCE, check_activation, check_angle, turn
from .words import Word

NEUTRAL_ACTIVATION = 1.0  # the calm end of the scale: a neutral face asks for nothing, so any value would do


def expression(
    word: str | None = None,
    *,
    activation: float | None = None,
    angle: float | None = None,
    variants: Mapping[str, int | str] | int | str | None = None,
    signs: str = Signs.MPEG4,
    words: Mapping[str, Word] | None = None,
) -> Profile:
    """The profile of an emotion word, or of any point of the wheel.

    A word with a category is its archetype at another activation (section 4.1). Any other word, and any angle, lies
    between its two neighbours on the wheel (section 4.2); an angle that is an archetype's own is that archetype.
    A neutral word ("accepting", the zero direction of the wheel, and "neutral") is a silent profile at any activation.

    Parameters
    ----------
    word : an emotion word of `words`; an archetype's name is one too. Upper case and outer blanks do not matter.
    activation : 1..7; by default the word's own.
    angle : degrees, instead of a word; needs an activation.
    variants : archetype -> variant of Table 5 (a number), where not the preset's: the natural drive then shows what it
        says and no more; or the way in which faces show the emotion in the natural drive (a name: anger "bared" or
        "pressed", joy "open" or "closed"; presets/prototypes.toml). A bare number or name serves a word of one
        category.
    signs : "mpeg4" (default) or "paper".
    words : the words to choose from; by default those that come with Risorius. `load_emotions` reads a user's own.

    Raises
    ------
    ParameterError
        When the word is unknown (the message suggests others), when both or neither of word and angle are given, or
        when activation, angle or variants break their rule.

    Examples
    --------
    >>> terrified = api.expression("terrified")
    >>> print(terrified.category, terrified.activation)
    fear 6.3
    >>> between = api.expression(angle=20.0, activation=5.0)
    >>> {str(name): round(share, 2) for name, share in between.weights.items()}
    {'joy': 0.47, 'fear': 0.53}
    """
    numbers, ways = _numbers_and_ways(variants)
    known = WORDS if words is None else words
    plain = _expression(word, activation, angle, numbers, signs, known)
    shown = _shown_as(plain, numbers, ways)
    if word is None or shown.prototypes:
        return shown
    entry = find_word(word, known)
    return replace(shown, shows=entry.shows, bearing=entry.bearing)


def _expression(
    word: str | None,
    activation: float | None,
    angle: float | None,
    variants: Mapping[str, int] | int | None,
    signs: str,
    known: Mapping[str, Word],
) -> Profile:
    """The ranges of an expression; see `expression`."""
    if (word is None) == (angle is None):
        raise ParameterError("expression", "needs either a word or an angle", (word, angle))
    if word is None:
        if activation is None:
            raise ParameterError("activation", "must be given with an angle, from 1 to 7", activation)
        return _at_angle(check_angle(angle or 0.0), check_activation(activation), _chosen(variants, None, known), signs)
    entry = find_word(word, known)
    if entry.neutral:
        level = NEUTRAL_ACTIVATION if activation is None else activation
        return Profile(ranges={}, activation=level, angle=entry.angle or 0.0, weights={}, word=entry.name)
    level = check_activation(entry.activation if activation is None else activation)
    chosen = _chosen(variants, entry, known)
    if entry.category is not None:
        profile = archetype(entry.category, chosen[entry.category], signs=signs).scaled(level)
        own_angle = profile.angle if entry.angle is None else entry.angle
        return replace(profile, angle=own_angle, word=entry.name)
    if entry.neighbours is not None and entry.angle is not None:
        return _mixed(*entry.neighbours, entry.angle, level, chosen, signs).named(entry.name)
    return _at_angle(check_angle(entry.angle or 0.0), level, chosen, signs).named(entry.name)


def _numbers_and_ways(
    variants: Mapping[str, int | str] | int | str | None,
) -> tuple[Mapping[str, int] | int | None, Mapping[str, str] | str | None]:
    """Variants that are numbers of Table 5, and those that are names of ways of showing an emotion."""
    if isinstance(variants, str):
        return None, variants
    if variants is None or isinstance(variants, int):
        return variants, None
    numbers = {name: int(variant) for name, variant in variants.items() if not isinstance(variant, str)}
    return numbers or None, {name: way for name, way in variants.items() if isinstance(way, str)}


def _shown_as(
    profile: Profile, numbers: Mapping[str, int] | int | None, ways: Mapping[str, str] | str | None
) -> Profile:
    """An expression shown as its word means, but for variants of Table 5 and ways that were asked for."""
    asked: dict[Archetype, str] = {}
    if isinstance(ways, str):
        if profile.category is None:
            rule = "must map archetypes to names for an expression between two, such as {'anger': 'pressed'}"
            raise ParameterError("variants", rule, ways)
        asked[profile.category] = check_prototype(profile.category, ways)
    if isinstance(ways, Mapping):
        asked.update({check_archetype(name): check_prototype(name, way) for name, way in ways.items()})
    if isinstance(numbers, Mapping):
        asked.update({check_archetype(name): AS_PRINTED for name in numbers})
    elif numbers is not None and profile.category is not None:
        asked[profile.category] = AS_PRINTED
    return replace(profile, prototypes=asked)


def find_word(word: str, words: Mapping[str, Word] = WORDS) -> Word:
    """The word of this name.

    Raises
    ------
    ParameterError
        When there is none; the message suggests the nearest, or lists them all.
    """
    name = word.strip().lower() if isinstance(word, str) else str(word)
    for candidate in (name, word):
        if candidate in words:
            return words[candidate]
    meant = [known for known, entry in words.items() if name in entry.synonyms]
    near = meant or difflib.get_close_matches(name, words, n=3, cutoff=0.6)
    hint = f"did you mean {' or '.join(near)}?" if near else f"use one of {', '.join(sorted(words))}"
    raise ParameterError("emotion word", f"must be a known word ({hint})", word)


def neighbours(angle: float) -> tuple[Archetype, Archetype]:
    """The archetypes on both sides of an angle on the wheel, lower side first.

    An archetype's own angle gives that archetype twice.
    """
    direction = check_angle(angle)
    below = min(ARCHETYPES, key=lambda name: turn(BASE_WORDS[name].angle, direction))
    above = min(ARCHETYPES, key=lambda name: turn(direction, BASE_WORDS[name].angle))
    for name in (below, above):
        gap = turn(BASE_WORDS[name].angle, direction)
        if min(gap, 360.0 - gap) <= ANGLE_TOLERANCE:
            return name, name
    return below, above


def default_variant(name: str, words: Mapping[str, Word] = WORDS) -> int:
    """The variant of Table 5 that shows an archetype best, from its preset; 0 where no preset says."""
    emotion = check_archetype(name)
    entry = words.get(emotion.value) or WORDS.get(emotion.value)
    return entry.variants.get(emotion, 0) if entry is not None else 0


def _chosen(
    asked: Mapping[str, int] | int | None, entry: Word | None, words: Mapping[str, Word]
) -> dict[Archetype, int]:
    """Variant of every archetype: what the caller asks, else the word's, else the archetype's default."""
    chosen = {name: default_variant(name, words) for name in ARCHETYPES}
    if entry is not None:
        chosen.update(entry.variants)
    if isinstance(asked, Mapping):
        chosen.update({check_archetype(name): number for name, number in asked.items()})
    elif asked is not None:
        if entry is None or entry.category is None:
            rule = "must map archetypes to numbers for an expression between two, such as {'fear': 8}"
            raise ParameterError("variants", rule, asked)
        chosen[entry.category] = asked
    return chosen


def _at_angle(angle: float, activation: float, variants: Mapping[Archetype, int], signs: str) -> Profile:
    """A point of the wheel."""
    below, above = neighbours(angle)
    if below is above:
        return archetype(below, variants[below], signs=signs).scaled(activation)
    return _mixed(below, above, angle, activation, variants, signs)


def _mixed(
    first: Archetype,
    second: Archetype,
    angle: float,
    activation: float,
    variants: Mapping[Archetype, int],
    signs: str,
) -> Profile:
    """Between two archetypes."""
    ends = (archetype(name, variants[name], signs=signs) for name in (first, second))
    return between(*ends, activation=activation, angle=angle)
