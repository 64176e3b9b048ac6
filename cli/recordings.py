"""Options of reading a recording, and a recording as it was read: what had to be assumed is said."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from .progress import when_slow

if TYPE_CHECKING:
    from ..api import Recording
    from ..arrays import Floats

FLIPS = ("yaw", "pitch", "roll", "eye_yaw", "eye_pitch")
#: Endings of meshes; what is none of them is a stream or a recording, or says what it seems to be.
MESHES = (
    ".npz",
    ".obj",
    ".blend",
    ".glb",
    ".gltf",
    ".fbx",
    ".ply",
    ".stl",
    ".abc",
    ".dae",
    ".usd",
    ".usda",
    ".usdc",
    ".usdz",
)
#: Pixels of an image's side, at most.
LARGEST_SIDE = 1e6
#: What `add_recording` sets.
RECORDING = ("kind", "rate", "start", "face", "flip", "aspect", "steady", "neutral", "neutral_frame")
#: Endings of the streams that are written.
WRITABLE = ".fap, .fba, .json, .csv"
KINDS = ("openface", "py_feat", "arkit", "mediapipe", "landmarks", "faps")


def add_recording(parser: argparse.ArgumentParser) -> None:
    """Options of reading what a tracker wrote."""
    parser.add_argument("--kind", choices=KINDS, help="the kind of a recording (default: detected from its contents)")
    about = "frames per second of a recording (default: what its times, timecodes or frame numbers show, else 30)"
    parser.add_argument("--rate", type=float, help=about)
    about = "where the stream begins: seconds of the recording's own times, or a timecode (default: its first row)"
    parser.add_argument("--start", metavar="TIME", help=about)
    about = "which face of a recording of several: its number, or its place in a frame (0, 1, ...)"
    parser.add_argument("--face", type=int, metavar="N", help=about)
    about = (
        "turns that the recording has the other way round: of the head yaw, pitch, roll; of the eyes eye_yaw, eye_pitch"
    )
    parser.add_argument("--flip", nargs="+", choices=FLIPS, default=(), metavar="TURN", help=about)
    parser.add_argument(
        "--aspect", type=_aspect, default=16.0 / 9.0, help="landmarks: WIDTH:HEIGHT of the image (default: 16:9)"
    )
    about = "take out the trembling of a tracker; blinks and closing lips keep their time and their edge"
    parser.add_argument("--steady", action="store_true", help=about)
    about = "time range in seconds with a neutral face, from which all is counted (default: the tracker's zero; of "
    about += "landmarks, the usual shape)"
    neutral = parser.add_mutually_exclusive_group()
    neutral.add_argument("--neutral", type=float, nargs=2, metavar=("FROM", "TO"), help=about)
    about = "the same for one frame, by its number from 0"
    neutral.add_argument("--neutral-frame", type=int, metavar="N", help=about)


def is_recording(path: Path) -> bool:
    """Whether a file is read as a stream or a recording, not as a mesh."""
    from .. import api

    ending = path.suffix.lower()
    return ending in api.READABLE_STREAMS or (ending not in MESHES and os.path.isfile(path))


def read_as_told(
    path: Path, arguments: argparse.Namespace, *, fps: float | None = None, strict: bool = False
) -> Recording:
    """The recording in a file, read as `add_recording` has asked; says on standard error what was assumed."""
    from .. import api

    recording = api.read_recording(
        path,
        arguments.kind,
        fps=fps,
        rate=arguments.rate,
        start=arguments.start,
        face=arguments.face,
        flip=arguments.flip,
        aspect=arguments.aspect,
        neutral=arguments.neutral_frame if arguments.neutral is None else tuple(arguments.neutral),
        steady=arguments.steady,
        strict=strict,
        progress=when_slow(),
    )
    for assumed in recording.assumed:
        print(f"note: {path.name}: {assumed}", file=sys.stderr)
    return recording


def whole_frames(recording: Recording) -> tuple[Floats, tuple[str, ...]]:
    """(T, 68) FAPs of a recording that is to be played, its holes bridged; says on standard error which."""
    frames, said = recording.played()
    for line in said:
        print(f"note: {recording.stream.name}: {line}", file=sys.stderr)
    return frames, said


def _aspect(text: str) -> float:
    """16:9, or a number."""
    width, _, height = text.partition(":")
    sides = float(width), float(height or 1.0)
    if not all(0.0 < side <= LARGEST_SIDE for side in sides) or not 1e-3 <= sides[0] / sides[1] <= 1e3:
        raise argparse.ArgumentTypeError("must be WIDTH:HEIGHT of an image, such as 16:9")
    return sides[0] / sides[1]
