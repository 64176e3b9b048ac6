"""Intermediate words read off faces: which of all words a face is taken for."""

from __future__ import annotations

from collections.abc import Sequence

import risorius.api as api
from risorius.mpeg4 import Profile

from .poses import Measured, words


def meanings() -> dict[str, str]:
    """Word -> the first word of the same profile: joy and joyful cannot be told apart."""
    first: dict[tuple[tuple[int, tuple[float, float]], ...], str] = {}
    return {word: first.setdefault(tuple(sorted(api.expression(word).ranges.items())), word) for word in words()}


def kind(word: str) -> str:
    """The archetype of a word, or the two that it lies between."""
    profile: Profile = api.expression(word)
    return " and ".join(sorted(str(name) for name in profile.weights))


def rankings(measured: Measured) -> list[Sequence[str]]:
    """For each pose all distinct words, the most believed first."""
    distinct = sorted(set(meanings().values()))
    return [list(api.recognise_words(faps, distinct)) for faps in measured.faps]
