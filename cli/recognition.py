"""The verb that tells emotions: recognise."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import FormatError, ParameterError
from .options import Verbs, add_face, face_of, verb, vertices_of
from .progress import ShowProgress
from .recordings import add_recording, is_recording, read_as_told
from .result import Result, UsageError

if TYPE_CHECKING:
    from ..api import BeliefTrack
    from ..arrays import Floats

#: Words that are printed where none are named; FAPs that are said to have decided; frames from which progress is said.
CLOSEST, DECISIVE, MANY = 10, 5, 500


def add_recognition_verb(verbs: Verbs) -> None:
    """Add recognise to the verbs."""
    recognise = verb(verbs, "recognise", _recognise)
    about = "a FAP stream (.fap, .fba, .json, .csv), a tracker's recording, or deformed meshes, one for each frame"
    recognise.add_argument("files", type=Path, nargs="+", metavar="FILE", help=about)
    recognise.add_argument("--rule", choices=("paper", "robust"), default="paper", help="default: paper")
    recognise.add_argument("--frame", type=int, help="frame to recognise (default: the strongest)")
    about = "also print these words (default: the closest words), the strength and the decisive FAPs"
    recognise.add_argument("--words", nargs="*", metavar="WORD", help=about)
    recognise.add_argument("--over-time", action="store_true", help="recognise every frame instead of one")
    recognise.add_argument("--out", type=Path, help="with --over-time: write a .csv table, one row per frame")
    add_recording(recognise)
    add_face(recognise)


def _recognise(arguments: argparse.Namespace) -> Result:
    """Recognise which of the six emotions a FAP stream or a deformed mesh shows."""
    if arguments.over_time and (arguments.words is not None or arguments.frame is not None):
        raise UsageError("--over-time cannot be used with --words or --frame")
    if arguments.out is not None and not arguments.over_time:
        raise UsageError("--out needs --over-time")
    frames, fps, first, assumed = _frames(arguments)
    if arguments.over_time:
        return _over_time(arguments, frames, fps, first, assumed)
    index = int(np.nansum(np.abs(frames), axis=1).argmax()) if arguments.frame is None else arguments.frame
    if not 0 <= index < len(frames):
        raise ParameterError("frame", f"must be in 0..{len(frames) - 1}", index)
    return _one(arguments, frames[index], index, assumed)


def _frames(arguments: argparse.Namespace) -> tuple[Floats, float, int, tuple[str, ...]]:
    """(T, 68) FAPs, frames per second, number of the first frame, what was assumed to read them."""

    path, *others = arguments.files
    if not is_recording(path):
        face = face_of(arguments)
        return np.stack([face.measure(vertices_of(p, face)) for p in arguments.files]), arguments.fps, 0, ()
    if others:
        raise UsageError("give one stream only")
    recording = read_as_told(path, arguments)
    stream = recording.stream
    if not len(stream.frames):
        raise FormatError(path, "has no frames: nothing to recognise")
    return stream.expanded(), stream.fps, stream.first_frame, recording.assumed


def _one(arguments: argparse.Namespace, frame: Floats, index: int, assumed: tuple[str, ...]) -> Result:
    """Beliefs of one frame; more of it where words are asked for. Beliefs alone where nothing was assumed."""
    from .. import api

    found = api.recognise(frame, rule=arguments.rule)
    beliefs = {str(name): belief for name, belief in sorted(found.items(), key=lambda item: -item[1])}
    lines = [f"{name:<12} {belief:.3f}" for name, belief in beliefs.items()]
    if arguments.words is None:
        return Result({**beliefs, "assumed": list(assumed)} if assumed else beliefs, lines)
    words = api.recognise_words(frame, arguments.words or api.WORDS, rule=arguments.rule)
    if not arguments.words:
        words = dict(list(words.items())[:CLOSEST])
    profile = found.best_profile
    strength = 0.0 if profile is None else api.shown_strength(frame, profile)
    decisive = dict(list(found.decisive.items())[:DECISIVE])
    data = {
        "frame": index,
        "rule": arguments.rule,
        "emotions": beliefs,
        "best": found.best,
        "strength": strength,
        "words": words,
        "decisive": {api.fap(number).name: speaks for number, speaks in decisive.items()},
        "assumed": list(assumed),
    }
    lines += [f"strength     {strength:.3f}", "words"]
    lines += [f"  {word:<14} {belief:.3f}" for word, belief in words.items()]
    lines += [f"decisive for {found.best}"]
    lines += [f"  F{number:<3} {api.fap(number).name:<24} {speaks:+.2f}" for number, speaks in decisive.items()]
    return Result(data, lines)


def _over_time(
    arguments: argparse.Namespace, frames: Floats, fps: float, first: int, assumed: tuple[str, ...]
) -> Result:
    """Beliefs of every frame."""
    from .. import api

    progress = ShowProgress(percent=10) if len(frames) > MANY else None
    track = api.recognise_over_time(frames, rule=arguments.rule, fps=fps, first_frame=first, progress=progress)
    if arguments.out is not None:
        api.write_belief_csv(arguments.out, track)
    names = [str(name) for name in api.ARCHETYPES]
    data = {
        "rule": arguments.rule,
        "fps": fps,
        "frames": [int(number) for number in track.numbers],
        "beliefs": {name: track.beliefs[:, column] for column, name in enumerate(names)},
        "best": list(track.best),
        "strength": track.strengths,
        "assumed": list(assumed),
        "out": arguments.out,
    }
    wrote = [f"wrote {arguments.out}"] if arguments.out is not None else _table(track, names)
    return Result(data, wrote)


def _table(track: BeliefTrack, names: list[str]) -> list[str]:
    """A line per frame for people."""
    head = f"{'frame':>6} " + " ".join(f"{name:>8}" for name in names) + "  strength  best"
    rows = [
        f"{number:6.0f} " + " ".join(f"{belief:8.3f}" for belief in beliefs) + f"  {strength:8.2f}  {best or '-'}"
        for number, beliefs, strength, best in zip(
            track.numbers, track.beliefs, track.strengths, track.best, strict=True
        )
    ]
    return [head, *rows]
