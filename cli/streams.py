"""Verbs of FAP streams: fap info, convert, play; fap of a file or a word."""

from __future__ import annotations

import argparse
import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from .faps import range_lines, ranges_of
from .films import destination_of, in_blender, labels_of, lines_of, needing_blender
from .options import (
    Verbs,
    add_film,
    add_fps,
    add_inertia,
    add_strength,
    expression_of,
    motion_line,
    onto_options,
    refuse_ending,
    refuse_idle,
    scene_options,
    verb,
)
from .progress import ShowProgress, when_slow
from .recordings import RECORDING, WRITABLE, add_recording, read_as_told, whole_frames
from .result import Result, UsageError

if TYPE_CHECKING:
    from ..api import FapStream, Recording

READABLE = "a FAP stream (.fap, .fba, .json, .csv) or a tracker's recording"

#: What `fap` does; `of` may be left out.
ACTIONS = ("info", "convert", "play", "of")


def add_stream_verb(verbs: Verbs) -> None:
    """Add fap to the verbs; what it does are verbs of its own."""
    about = "Inspect a FAP stream, convert it, play it on a face, or write an expression as a stream."
    fap = verbs.add_parser("fap", help=about, description=f"{about} `of` may be left out.")
    actions = fap.add_subparsers(dest="action", required=True, metavar="ACTION")

    info = verb(actions, "info", _info)
    info.add_argument("source", metavar="FILE", help=READABLE)

    convert = verb(actions, "convert", _convert)
    convert.add_argument("source", metavar="FILE", help=READABLE)
    convert.add_argument("target", metavar="OUT", nargs="?", help=f"the stream to write: {WRITABLE}")
    _add_writing(convert)

    play = verb(actions, "play", _play)
    play.add_argument("source", metavar="FILE", help=READABLE)
    play.add_argument("target", metavar="OUT", nargs="?", help="the file to write: .blend or .mp4")
    play.add_argument("--out", type=Path, help="the same as OUT")
    add_film(play)
    add_inertia(play)

    of = verb(actions, "of", _of)
    of.add_argument("source", metavar="FILE|WORD", help=f"{READABLE}, to inspect or to convert; or an emotion word")
    add_strength(of)
    add_fps(of)
    _add_writing(of)
    for action in (info, convert, play, of):
        _add_reading(action)


def with_action(argv: list[str]) -> list[str]:
    """Arguments in which what `fap` does comes first: options may stand before it, and `of` may be left out."""
    first, *rest = argv or [""]
    if first != "fap" or not rest or rest[0] in ("-h", "--help"):
        return argv
    place = next((place for place, argument in enumerate(rest) if argument in ACTIONS), None)
    if place is None:
        return [first, "of", *rest]
    return [first, rest[place], *rest[:place], *rest[place + 1 :]]


def _add_reading(parser: argparse.ArgumentParser) -> None:
    """Options of reading a stream."""
    add_recording(parser)
    parser.add_argument("--fill", choices=("copy", "hold", "standard"), help="fill FAPs that are not stated")
    parser.add_argument("--expand", action="store_true", help="convert visemes and expressions to low-level FAPs")
    parser.add_argument(
        "--strict", action="store_true", help="stop at damage in an .fba file instead of continuing after it"
    )


def _add_writing(parser: argparse.ArgumentParser) -> None:
    """Options of writing a stream."""
    parser.add_argument("--out", type=Path, help=f"the stream to write: {WRITABLE}")
    parser.add_argument("--quantiser", type=int, default=1, help=".fba: 0 (lossless) to 31 (default: 1)")
    parser.add_argument("--refresh", type=float, default=10.0, help=".fba: seconds between I frames (default: 10)")
    parser.add_argument("--decimals", type=int, default=0, help=".fap: number of decimals (default: 0)")


def _info(arguments: argparse.Namespace) -> Result:
    """Inspect a FAP stream."""
    return _described(*_read(arguments))


def _convert(arguments: argparse.Namespace) -> Result:
    """Convert a FAP stream to another format."""
    out = _target(arguments)
    _tell_idle_writing(arguments, out)
    stream, recording = _read(arguments)
    _write(out, stream, arguments)
    return _described(stream, recording, out=out)


def _play(arguments: argparse.Namespace) -> Result:
    """Play a FAP stream on a face, as .blend or video (needs Blender)."""
    from .. import api

    out = _target(arguments)
    refuse_ending(out, ".blend", ".mp4")
    stream, recording = _read(arguments)
    frames, said = whole_frames(replace(recording, stream=stream))
    stream = api.FapStream(frames, fps=stream.fps, name=stream.name)
    onto, shared, labels = onto_options(arguments), scene_options(arguments), labels_of(arguments, out)
    with needing_blender():
        from ..scene.jobs import playing
    shared |= {name: getattr(arguments, name) for name in ("creases", "engine", "inertia")}
    shared["destination"] = destination_of(onto)
    shared["labels"] = labels
    with in_blender():
        made = dict(playing.play_stream(out, stream, **shared, progress=ShowProgress()))
    data = {**made, "inertia": arguments.inertia, "assumed": [*recording.assumed, *said]}
    return Result(data, [*lines_of(made), f"motion: {motion_line(arguments.inertia)}"])


def _of(arguments: argparse.Namespace) -> Result:
    """Inspect a FAP stream or convert it, or write an expression as a stream."""
    from .. import api

    source = Path(arguments.source)
    if source.suffix.lower() in api.READABLE_STREAMS or os.path.isfile(source):
        refuse_idle(arguments, "is for an emotion word: leave it out with a file", "activation", "variant", "fps")
        _tell_idle_writing(arguments, arguments.out)
        return _convert(arguments) if arguments.out else _info(arguments)
    read = (*RECORDING, "fill", "expand", "strict")
    refuse_idle(arguments, "is for a file: leave it out with an emotion word", *read)
    _tell_idle_writing(arguments, arguments.out)
    stream = _of_word(arguments)
    if arguments.out:
        _write(arguments.out, stream, arguments)
    return _described(stream, out=arguments.out)


def _of_word(arguments: argparse.Namespace) -> FapStream:
    """An expression that comes and goes."""
    from .. import api

    arguments.word, arguments.angle = arguments.source, None
    timing = api.load_timings()["natural"]
    profile = expression_of(arguments)
    frames = api.envelope(profile, onset=timing.onset, apex=timing.apex, offset=timing.offset, fps=arguments.fps)
    return api.FapStream(frames=frames, fps=arguments.fps, name=arguments.source)


def _target(arguments: argparse.Namespace) -> Path:
    """The file to write, as an argument or as --out."""
    given = getattr(arguments, "target", None)
    if (given is None) == (arguments.out is None):
        raise UsageError(f"{arguments.action} needs an input file and an output file")
    return Path(given) if given is not None else arguments.out


def _read(arguments: argparse.Namespace) -> tuple[FapStream, Recording]:
    """The stream of a file, filled and expanded as asked; and the file as it was read."""
    from .. import api

    recording = read_as_told(Path(arguments.source), arguments, strict=arguments.strict)
    for problem in recording.damage:
        print(f"risorius fap: {problem}", file=sys.stderr)
    stream = recording.stream
    if arguments.fill:
        stream = stream.filled(arguments.fill)
    if arguments.expand:
        stream = api.FapStream(stream.expanded(), fps=stream.fps, name=stream.name, first_frame=stream.first_frame)
    return stream, recording


def _tell_idle_writing(arguments: argparse.Namespace, out: Path | None) -> None:
    """Say which options are of formats that are not written; the same ones may be given with every format."""
    for names, ending in ((("quantiser", "refresh"), ".fba"), (("decimals",), ".fap")):
        for name in names if out is None or out.suffix.lower() != ending else ():
            if getattr(arguments, name) != arguments.parser.get_default(name):
                print(f"note: --{name} is for writing {ending} files: not used", file=sys.stderr)


def _write(path: Path, stream: FapStream, arguments: argparse.Namespace) -> None:
    """A stream in the format of the file's name."""
    from .. import api

    options = {name: getattr(arguments, name) for name in ("decimals", "quantiser", "refresh")}
    api.write_stream(path, stream, progress=when_slow(), **options)


def _described(stream: FapStream, recording: Recording | None = None, *, out: Path | None = None) -> Result:
    """What a stream holds, for people and as JSON."""
    ranges = ranges_of(stream)
    seconds = len(stream.frames) / stream.fps
    data: dict[str, object] = {
        "name": stream.name,
        "fps": stream.fps,
        "frames": len(stream.frames),
        "seconds": seconds,
        "faps": list(ranges),
        "visemes": len(stream.visemes),
        "expressions": len(stream.expressions),
        "ranges": ranges,
        "format": None if recording is None else str(recording.format),
        "assumed": [] if recording is None else list(recording.assumed),
        "damage": [] if recording is None else [str(problem) for problem in recording.damage],
        "out": out,
    }
    wrote = []
    if out is not None:
        size = out.stat().st_size
        rate = size * 8 / 1000.0 / seconds
        data |= {"bytes": size, "kilobits_per_second": rate}
        wrote = [f"wrote {out}: {rate:.1f} kilobits per second"]
    title = f"{stream.name}: {len(stream.frames)} frames at {stream.fps:g} per second, {len(ranges)} FAPs"
    extra = [
        f"{len(fields)} frames with {what}"
        for what, fields in (("visemes", stream.visemes), ("expressions", stream.expressions))
        if fields
    ]
    return Result(data, [title, *extra, *range_lines(ranges), *wrote])
