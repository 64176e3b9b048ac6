"""The verb track: a film, pictures or a camera to a FAP stream."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import RisoriusError
from ..tables import write_csv
from .faps import range_lines, ranges_of
from .options import Verbs, verb
from .progress import ShowProgress
from .result import Result, UsageError

if TYPE_CHECKING:
    from ..arrays import Floats
    from ..track import Track

SOURCES = (
    'a video; images, or a folder or pattern of images ("shots/*.png"); "camera", or "camera:1" for the second camera'
)
NEUTRAL = 'FROM:TO in seconds with a neutral face, or "generic" for a generic face (default: found automatically)'
TIMES = re.compile(r"(\d+(?:\.\d+)?):(\d+(?:\.\d+)?)")
WRITABLE = (".fap", ".json")

#: The extension leaves the folder `track` out: it would need a camera's permission and packages from outside.
OUTSIDE_BLENDER = "tracking runs outside Blender: install Risorius in a separate Python (docs/tracking.md)"


def add_track_verb(verbs: Verbs) -> None:
    """Add track to the verbs."""
    track = verb(verbs, "track", _track)
    track.add_argument("source", nargs="+", metavar="SOURCE", help=SOURCES)
    track.add_argument("--out", type=Path, required=True, help=f"the stream to write: {', '.join(WRITABLE)}")
    track.add_argument("--neutral", help=NEUTRAL)
    ways = "savgol: no lag, uses later frames (default); euro: past frames only, for live use; none"
    track.add_argument("--smooth", choices=("savgol", "euro", "none"), default="savgol", help=ways)
    track.add_argument("--fps", type=float, help="frames per second (default: those of the video; 25 for images)")
    track.add_argument("--seconds", type=float, help="duration in seconds (default: to the end; camera: until Ctrl-C)")
    track.add_argument("--least", type=float, help="mask values with a lower confidence, 0 to 1 (default: 0.3)")
    about = "write the confidence of each value, for `recognise --confidence`"
    track.add_argument("--confidence", type=Path, metavar="FILE.csv", help=about)
    about = "your own model, for MediaPipe 1.x and every Python (default: the one in mediapipe 0.10.21)"
    track.add_argument("--model", type=Path, metavar="face_landmarker.task", help=about)
    about = "with --model: also write the blend shapes, a recording for `import` and `fap`"
    track.add_argument("--shapes", type=Path, metavar="FILE.csv", help=about)


def _track(arguments: argparse.Namespace) -> Result:
    """Track FAPs in a video, images or a camera (needs `pip install risorius[track]`)."""
    from .. import api

    try:
        from .. import track
    except ImportError as absent:
        raise RisoriusError(OUTSIDE_BLENDER) from absent
    if arguments.out.suffix.lower() not in WRITABLE:
        raise UsageError(f"--out must end in {' or '.join(WRITABLE)}")
    if arguments.shapes is not None and arguments.model is None:
        raise UsageError("--shapes needs --model: the model in MediaPipe's package has no blend shapes")
    neutral = _neutral(arguments.neutral)
    pictures = track.open_pictures(arguments.source, fps=arguments.fps, seconds=arguments.seconds)
    if pictures.live:
        print("reading the camera; press Ctrl-C to stop", file=sys.stderr, flush=True)
    progress, shapes = ShowProgress(percent=5), list[Mapping[str, float]]()
    if arguments.model is None:
        landmarks = track.find_landmarks(pictures, progress=progress)
    else:
        landmarks, shapes = track.find_faces(pictures, model=arguments.model, progress=progress)
    options = {} if arguments.least is None else {"least": arguments.least}
    found = track.track_landmarks(
        landmarks,
        fps=arguments.fps if pictures.live or len(landmarks.times) > 1 else pictures.fps,
        neutral=neutral,
        smoothing=arguments.smooth,
        name=pictures.name,
        **options,
    )
    api.write_stream(arguments.out, found.stream)
    if arguments.confidence is not None:
        track.write_confidence(arguments.confidence, found.confidence, found.doubt)
    if arguments.shapes is not None:
        _write_shapes(arguments.shapes, landmarks.times, shapes)
    return _described(found, arguments.out)


def _neutral(text: str | None) -> tuple[float, float] | str | None:
    """What --neutral says."""
    if text is None or text == "generic":
        return text
    times = TIMES.fullmatch(text)
    if times is None:
        raise UsageError('--neutral must be FROM:TO in seconds, such as 0:0.5, or "generic"')
    return float(times[1]), float(times[2])


def _write_shapes(path: Path, times: Floats, shapes: list[Mapping[str, float]]) -> None:
    """A row per image, a column per blend shape: a recording as `import` reads it; cells without a face are empty."""
    names = sorted({name for scores in shapes for name in scores})
    rows = [
        [index, f"{when:.4f}", *("" if name not in scores else f"{scores[name]:.4f}" for name in names)]
        for index, (when, scores) in enumerate(zip(times, shapes, strict=True))
    ]
    write_csv(path, ["frame", "timestamp", *names], rows)


def _described(found: Track, out: Path) -> Result:
    """What was read, for people and as JSON."""
    stream = found.stream
    ranges = ranges_of(stream)
    sure = {number: float(found.confidence[:, number - 1].mean()) for number in ranges}
    data = {
        "name": stream.name,
        "fps": stream.fps,
        "frames": len(stream.frames),
        "lost": found.lost,
        "neutral": "generic" if found.generic else found.neutral,
        "doubts": found.doubts,
        "delay": found.delay,
        "ranges": ranges,
        "confidence": sure,
        "out": out,
    }
    lines = [f"{stream.name}: {len(stream.frames)} frames at {stream.fps:g} per second, {len(ranges)} FAPs"]
    if len(found.lost):
        lines.append(f"{len(found.lost)} frames without a face are masked")
    if found.generic:
        lines.append(
            "no neutral face of this person: FAPs are relative to a generic face and include the difference from it; "
            "--confidence writes how doubtful that is"
        )
    else:
        lines.append(
            f"neutral face from {len(found.neutral)} images at {found.neutral.min():.2f} .. {found.neutral.max():.2f} s"
        )
    if found.doubts:
        lines.append(
            f"its mouth is unusual for a neutral face ({', '.join(found.doubts)}): if it smiles or speaks there, give "
            "a time range at rest with --neutral FROM:TO, or use --neutral generic"
        )
    if len(stream.frames) == 1:
        shown = found.recognise()
        verdict = shown.best[0]
        data["best"] = verdict
        lines.append(f"shows: {verdict or 'nothing that can be told'} (robust rule)")
    if found.delay:
        lines.append(f"slow motions lag by {1000.0 * found.delay:.0f} ms")
    lines += [
        f"{line}   confidence {sure[number]:.2f}" for number, line in zip(ranges, range_lines(ranges), strict=True)
    ]
    return Result(data, [*lines, f"wrote {out}"])
