"""Verb for what trackers write: import."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from .options import Verbs, refuse_ending, verb
from .recordings import WRITABLE, add_recording, read_as_told
from .result import Result


def add_capture_verb(verbs: Verbs) -> None:
    """Add import to the verbs."""
    importing = verb(verbs, "import", _import)
    importing.add_argument("file", type=Path, help="OpenFace, ARKit, Live Link Face or MediaPipe: .csv, .json, .jsonl")
    importing.add_argument("--out", type=Path, help=f"the stream to write: {WRITABLE}")
    importing.add_argument("--fps", type=float, help="frames per second of the stream (default: the recording's)")
    add_recording(importing)


def _import(arguments: argparse.Namespace) -> Result:
    """Convert a tracker's recording to a FAP stream."""
    from .. import api

    refuse_ending(arguments.out, *api.WRITABLE_STREAMS)
    recording = read_as_told(arguments.file, arguments, fps=arguments.fps)
    stream = recording.stream
    if arguments.out:
        api.write_stream(arguments.out, stream)
    known = ~np.isnan(stream.frames)
    faps = [int(place) + 1 for place in np.flatnonzero(known.any(axis=0))]
    unknown = int((~known.any(axis=1)).sum())
    data = {
        "name": stream.name,
        "fps": stream.fps,
        "frames": len(stream.frames),
        "unknown_frames": unknown,
        "faps": faps,
        "format": str(recording.format),
        "assumed": list(recording.assumed),
        "out": arguments.out,
    }
    title = f"{stream.name}: {len(stream.frames)} frames at {stream.fps:g} per second, {len(faps)} FAPs"
    lines = [title + (f", {unknown} frames unknown" if unknown else "")]
    for number in faps:
        column = stream.frames[:, number - 1]
        lines.append(f"F{number:<3} {api.fap(number).name:<24} {np.nanmin(column):8.0f} .. {np.nanmax(column):8.0f}")
    return Result(data, [*lines, *([f"wrote {arguments.out}"] if arguments.out else [])])
