"""The verb that tells emotions: recognise."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import FormatError, ParameterError, RisoriusError
from .options import Verbs, add_face, face_of, refuse_ending, refuse_idle, verb, vertices_of
from .progress import ShowProgress
from .recordings import RECORDING, add_recording, is_recording, read_as_told
from .result import Result, UsageError
from .track import OUTSIDE_BLENDER

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
    about = "with --rule robust: the table that `risorius track --confidence` wrote beside the stream"
    recognise.add_argument("--confidence", type=Path, metavar="FILE.csv", help=about)
    add_recording(recognise)
    add_face(recognise)


def _recognise(arguments: argparse.Namespace) -> Result:
    """Recognise which of the six emotions a FAP stream or a deformed mesh shows."""
    if arguments.over_time and (arguments.words is not None or arguments.frame is not None):
        raise UsageError("--over-time cannot be used with --words or --frame")
    if arguments.out is not None and not arguments.over_time:
        raise UsageError("--out needs --over-time")
    refuse_ending(arguments.out, ".csv")
    if arguments.confidence is not None and arguments.rule != "robust":
        raise UsageError("--confidence needs --rule robust: the paper's rule weighs nothing")
    frames, fps, first, assumed = _frames(arguments)
    weights = _weights(arguments, frames)
    if arguments.over_time:
        return _over_time(arguments, frames, weights, fps, first, assumed)
    index = int(np.nansum(np.abs(frames), axis=1).argmax()) if arguments.frame is None else arguments.frame
    if not 0 <= index < len(frames):
        raise ParameterError("frame", f"must be in 0..{len(frames) - 1}", index)
    return _one(arguments, frames[index], weights.frame(index), index, assumed)


class _Weights(dict[str, "Floats | None"]):
    """Confidence and doubt, as recognition takes them."""

    def frame(self, index: int) -> _Weights:
        """Those of one frame."""
        sure = self["confidence"]
        return _Weights(confidence=None if sure is None else sure[index], doubt=self["doubt"])


def _weights(arguments: argparse.Namespace, frames: Floats) -> _Weights:
    """How sure the values of frames (T, 68) are."""
    if arguments.confidence is None:
        return _Weights(confidence=None, doubt=None)
    try:
        from ..track import read_confidence
    except ImportError as absent:
        raise RisoriusError(OUTSIDE_BLENDER) from absent
    confidence, doubt = read_confidence(arguments.confidence)
    if len(confidence) != len(frames):
        rule = f"has {len(confidence)} frames, the stream {len(frames)}: give the table that was written with it"
        raise FormatError(arguments.confidence, rule)
    return _Weights(confidence=confidence, doubt=doubt)


def _frames(arguments: argparse.Namespace) -> tuple[Floats, float, int, tuple[str, ...]]:
    """(T, 68) FAPs, frames per second, number of the first frame, what was assumed to read them."""

    path, *others = arguments.files
    if not is_recording(path):
        refuse_idle(arguments, "is for a recording: leave it out with meshes", *RECORDING)
        face = face_of(arguments)
        return np.stack([face.measure(vertices_of(p, face)) for p in arguments.files]), arguments.fps, 0, ()
    if others:
        raise UsageError("give one stream only")
    refuse_idle(arguments, "is for meshes: leave it out with a recording", "mesh", "points", "fps")
    recording = read_as_told(path, arguments)
    stream = recording.stream
    if not len(stream.frames):
        raise FormatError(path, "has no frames: nothing to recognise")
    return stream.expanded(), stream.fps, stream.first_frame, recording.assumed


def _one(
    arguments: argparse.Namespace, frame: Floats, weights: _Weights, index: int, assumed: tuple[str, ...]
) -> Result:
    """Beliefs of one frame; more of it where words are asked for. Beliefs alone where nothing was assumed."""
    from .. import api

    found = api.recognise(frame, rule=arguments.rule, **weights)
    believed = {str(name): belief for name, belief in found.items()}
    if found.neutral is not None:
        believed = {api.NEUTRAL: found.neutral, **believed}
    beliefs = dict(sorted(believed.items(), key=lambda item: -item[1]))
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
    if decisive:
        lines += [f"decisive for {max(found, key=found.__getitem__)}"]
    lines += [f"  F{number:<3} {api.fap(number).name:<24} {speaks:+.2f}" for number, speaks in decisive.items()]
    return Result(data, lines)


def _over_time(
    arguments: argparse.Namespace,
    frames: Floats,
    weights: _Weights,
    fps: float,
    first: int,
    assumed: tuple[str, ...],
) -> Result:
    """Beliefs of every frame."""
    from .. import api

    progress = ShowProgress(percent=10) if len(frames) > MANY else None
    track = api.recognise_over_time(
        frames, rule=arguments.rule, **weights, fps=fps, first_frame=first, progress=progress
    )
    if arguments.out is not None:
        api.write_belief_csv(arguments.out, track)
    beliefs = {str(name): track.beliefs[:, column] for column, name in enumerate(api.ARCHETYPES)}
    if track.neutral is not None:
        beliefs = {api.NEUTRAL: track.neutral, **beliefs}
    data = {
        "rule": arguments.rule,
        "fps": fps,
        "frames": [int(number) for number in track.numbers],
        "beliefs": beliefs,
        "best": list(track.best),
        "strength": track.strengths,
        "assumed": list(assumed),
        "out": arguments.out,
    }
    wrote = [f"wrote {arguments.out}"] if arguments.out is not None else _table(track, beliefs)
    return Result(data, wrote)


def _table(track: BeliefTrack, beliefs: Mapping[str, Floats]) -> list[str]:
    """A line per frame for people."""
    head = f"{'frame':>6} " + " ".join(f"{name:>8}" for name in beliefs) + "  strength  best"
    columns = np.column_stack(list(beliefs.values()))
    rows = [
        f"{number:6.0f} " + " ".join(f"{belief:8.3f}" for belief in row) + f"  {strength:8.2f}  {best or '-'}"
        for number, row, strength, best in zip(track.numbers, columns, track.strengths, track.best, strict=True)
    ]
    return [head, *rows]
