"""The verb of words: profile."""

from __future__ import annotations

import argparse

from .options import Verbs, add_strength, expression_of, verb
from .result import Result


def add_emotion_verbs(verbs: Verbs) -> None:
    """Add profile to the verbs."""
    profile = verb(verbs, "profile", _profile)
    profile.add_argument("word", nargs="?", help="an emotion word")
    profile.add_argument("--angle", type=float, help="degrees on the emotion wheel, instead of a word")
    add_strength(profile)


def _profile(arguments: argparse.Namespace) -> Result:
    """Print the FAP ranges of an expression."""
    profile = expression_of(arguments)
    from .. import api

    rows = [(api.fap(number), low, high) for number, (low, high) in profile.ranges.items()]
    data = {
        "word": profile.word,
        "activation": profile.activation,
        "angle": profile.angle,
        "category": profile.category,
        "ranges": {
            fap.number: {"name": fap.name, "unit": fap.unit, "low": low, "high": high} for fap, low, high in rows
        },
    }
    title = f"{profile.word or 'expression'}: activation {profile.activation:g}, angle {profile.angle:g} degrees"
    table = [f"F{fap.number:<3} {fap.name:<24} {low:8.1f} .. {high:8.1f}  {fap.unit}" for fap, low, high in rows]
    return Result(data, [title, *table])
