"""The verb of words: profile."""

from __future__ import annotations

import argparse
from typing import Any

from .options import add_strength, expression_of, verb
from .result import Result


def add_emotion_verbs(verbs: Any) -> None:
    """Add profile to the verbs."""
    profile = verb(verbs, "profile", _profile)
    profile.add_argument("word", nargs="?", help="an emotion word")
    profile.add_argument("--angle", type=float, help="degrees on the emotion wheel, instead of a word")
    add_strength(profile)


def _profile(arguments: argparse.Namespace) -> Result:
    """Print the FAP ranges of an expression."""
    profile = expression_of(arguments)
    from .. import api

    rows = {number: api.fap(number) for number in profile.ranges}
    data = {
        "word": profile.word,
        "activation": profile.activation,
        "angle": profile.angle,
        "category": profile.category,
        "ranges": {
            number: {"name": fap.name, "unit": fap.unit, "low": low, "high": high}
            for (number, fap), (low, high) in zip(rows.items(), profile.ranges.values(), strict=True)
        },
    }
    title = f"{profile.word or 'expression'}: activation {profile.activation:g}, angle {profile.angle:g} degrees"
    table = [
        f"F{number:<3} {row['name']:<24} {row['low']:8.1f} .. {row['high']:8.1f}  {row['unit']}"
        for number, row in data["ranges"].items()
    ]
    return Result(data, [title, *table])
