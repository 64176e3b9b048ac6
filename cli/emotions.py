"""Verbs of words and FAP files: profile, fap."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

from .options import add_fps, add_strength, expression_of, verb
from .result import Result


def add_emotion_verbs(verbs: Any) -> None:
    """Add profile and fap to the verbs."""
    profile = verb(verbs, "profile", _profile)
    profile.add_argument("word", nargs="?", help="an emotion word")
    profile.add_argument("--angle", type=float, help="degrees on the emotion wheel, instead of a word")
    add_strength(profile)

    fap = verb(verbs, "fap", _fap)
    fap.add_argument("source", help="a .fap file to look into, or an emotion word to write as one")
    add_strength(fap)
    add_fps(fap)
    fap.add_argument("--out", type=Path, help="the .fap file to write")


def _profile(arguments: argparse.Namespace) -> Result:
    """An expression's FAP ranges."""
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


def _fap(arguments: argparse.Namespace) -> Result:
    """Look into a .fap file, convert it, or write an expression as one."""
    from .. import api

    if Path(arguments.source).suffix.lower() == ".fap":
        stream = api.read_fap(Path(arguments.source))
    else:
        arguments.word, arguments.angle = arguments.source, None
        timing = api.load_timings()["natural"]
        profile = expression_of(arguments)
        frames = api.envelope(profile, onset=timing.onset, apex=timing.apex, offset=timing.offset, fps=arguments.fps)
        stream = api.FapStream(frames=frames, fps=arguments.fps, name=arguments.source)
    if arguments.out:
        api.write_fap(arguments.out, stream)
    used = [number for number in api.FAPS if not all(map(math.isnan, stream.frames[:, number - 1]))]
    data = {"name": stream.name, "fps": stream.fps, "frames": len(stream.frames), "faps": used, "out": arguments.out}
    title = f"{stream.name}: {len(stream.frames)} frames at {stream.fps:g} per second, {len(used)} FAPs"
    peaks = [
        f"F{number:<3} {api.fap(number).name:<24} {min(column):8.0f} .. {max(column):8.0f}"
        for number in used
        for column in [[value for value in stream.frames[:, number - 1] if not math.isnan(value)]]
    ]
    return Result(data, [title, *peaks, *([f"wrote {arguments.out}"] if arguments.out else [])])
