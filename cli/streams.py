"""Verbs of FAP streams: fap (info, convert, play), tables."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import FormatError, RisoriusError
from .films import NEEDS_BLENDER, silent_blender
from .options import add_creases, add_engine, add_face, add_strength, expression_of, face_of, verb
from .progress import ShowProgress, when_slow
from .result import Result, UsageError

if TYPE_CHECKING:
    from ..api import FapStream

READABLE, WRITABLE = (".fap", ".fba", ".json", ".csv"), (".fap", ".fba", ".json", ".csv")
SOURCES = "info FILE | convert FILE OUT | play FILE OUT; or a FILE to inspect, or an emotion WORD to write as a stream"


def add_stream_verbs(verbs: Any) -> None:
    """Add fap and tables to the verbs."""
    fap = verb(verbs, "fap", _fap)
    fap.add_argument("source", nargs="+", metavar="WHAT", help=SOURCES)
    add_strength(fap)
    add_face(fap)
    add_engine(fap)
    add_creases(fap)
    fap.add_argument("--out", type=Path, help=f"the stream to write: {', '.join(WRITABLE)}")
    fap.add_argument("--fill", choices=("copy", "hold", "standard"), help="fill FAPs that are not stated")
    fap.add_argument("--expand", action="store_true", help="convert visemes and expressions to low-level FAPs")
    fap.add_argument(
        "--strict", action="store_true", help="stop at damage in an .fba file instead of continuing after it"
    )
    fap.add_argument("--quantiser", type=int, default=1, help=".fba: 0 (lossless) to 31 (default: 1)")
    fap.add_argument("--refresh", type=float, default=10.0, help=".fba: seconds between I frames (default: 10)")
    fap.add_argument("--decimals", type=int, default=0, help=".fap: number of decimals (default: 0)")

    tables = verb(verbs, "tables", _tables)
    add_face(tables)
    tables.add_argument(
        "--out", type=Path, required=True, help="the file to write: .json, or .wrl or .txt for BIFS nodes"
    )
    tables.add_argument("--steps", type=int, default=4, help="intervals on either side of 0 (default: 4)")
    tables.add_argument("--faps", type=int, nargs="+", help="FAP numbers (default: all)")
    about = "still: other points keep their place (default); free: they follow skin and jaw"
    tables.add_argument("--others", choices=("still", "free"), default="still", help=about)


def _fap(arguments: argparse.Namespace) -> Result:
    """Inspect a FAP stream, convert it, play it on a face, or write an expression as a stream."""
    actions: dict[str, tuple[Callable[[argparse.Namespace], Result], int]] = {
        "info": (_info, 1),
        "convert": (_convert, 2),
        "play": (_play, 2),
    }
    first, *rest = arguments.source
    if first in actions:
        run, count = actions[first]
        if len(rest) == count - 1 and count == 2 and arguments.out is not None:
            rest.append(str(arguments.out))
        if len(rest) != count:
            raise UsageError(f"{first} needs {'one file' if count == 1 else 'an input file and an output file'}")
        arguments.files = [Path(name) for name in rest]
        return run(arguments)
    if rest:
        raise UsageError(f"give one of: {SOURCES}")
    arguments.files = [Path(first), *([arguments.out] if arguments.out else [])]
    if arguments.files[0].suffix.lower() in READABLE:
        return _convert(arguments) if arguments.out else _info(arguments)
    stream = _of_word(arguments, first)
    if arguments.out:
        _write(arguments.out, stream, arguments)
    return _described(stream, out=arguments.out)


def _info(arguments: argparse.Namespace) -> Result:
    """What a stream holds."""
    stream, damage = _read(arguments.files[0], arguments)
    return _described(stream, damage=damage)


def _convert(arguments: argparse.Namespace) -> Result:
    """Read one format and write another."""
    source, out = arguments.files
    stream, damage = _read(source, arguments)
    _write(out, stream, arguments)
    return _described(stream, out=out, damage=damage)


def _play(arguments: argparse.Namespace) -> Result:
    """Bake a stream onto a face: a .blend, or a film."""
    source, out = arguments.files
    stream, _ = _read(source, arguments)
    shared = {name: getattr(arguments, name) for name in ("mesh", "points", "creases")}
    if arguments.mesh is None and arguments.points is not None:
        raise UsageError("--points needs --mesh")
    try:
        from ..scene.jobs import playing
    except ModuleNotFoundError as missing:
        if missing.name in ("bpy", "mathutils"):
            raise RisoriusError(NEEDS_BLENDER) from None
        raise
    with silent_blender():
        options = {**shared, "engine": arguments.engine, "progress": ShowProgress()}
        made = dict(playing.play_stream(out, stream, **options))
    return Result(made, [f"{key}: {value}" for key, value in made.items()])


def _of_word(arguments: argparse.Namespace, word: str) -> FapStream:
    """An expression that comes and goes."""
    from .. import api

    arguments.word, arguments.angle = word, None
    timing = api.load_timings()["natural"]
    profile = expression_of(arguments)
    frames = api.envelope(profile, onset=timing.onset, apex=timing.apex, offset=timing.offset, fps=arguments.fps)
    return api.FapStream(frames=frames, fps=arguments.fps, name=word)


def _read(path: Path, arguments: argparse.Namespace) -> tuple[FapStream, list[str]]:
    """A stream of any format, filled and expanded as asked; and what was damaged."""
    from .. import api

    damage: list[str] = []
    suffix = path.suffix.lower()
    if suffix == ".fba":
        try:
            decoded = api.decode_fba(path.read_bytes(), path=path, strict=arguments.strict, progress=when_slow())
        except OSError as error:
            raise FormatError(path, f"cannot be read ({error.strerror})") from error
        stream, damage = decoded.stream, [str(error) for error in decoded.damage]
    elif suffix == ".json":
        stream = api.read_fap_json(path)
    elif suffix == ".csv":
        stream = api.read_capture(path)
    elif suffix == ".fap":
        stream = api.read_fap(path)
    else:
        raise FormatError(path, f"is not a readable FAP stream: use {', '.join(READABLE)}")
    for problem in damage:
        print(f"risorius fap: {problem}", file=sys.stderr)
    if arguments.fill:
        stream = stream.filled(arguments.fill)
    if arguments.expand:
        stream = api.FapStream(stream.expanded(), fps=stream.fps, name=stream.name, first_frame=stream.first_frame)
    return stream, damage


def _write(path: Path, stream: FapStream, arguments: argparse.Namespace) -> None:
    """A stream in the format of the file's name."""
    from .. import api

    suffix = path.suffix.lower()
    if suffix == ".fba":
        api.write_fba(path, stream, quantiser=arguments.quantiser, refresh=arguments.refresh, progress=when_slow())
    elif suffix == ".json":
        api.write_fap_json(path, stream)
    elif suffix == ".csv":
        api.write_fap_csv(path, stream)
    elif suffix == ".fap":
        api.write_fap(path, stream, decimals=arguments.decimals)
    else:
        raise FormatError(path, f"is not a writable FAP stream: use {', '.join(WRITABLE)}")


def _described(stream: FapStream, *, out: Path | None = None, damage: list[str] | None = None) -> Result:
    """What a stream holds, for people and as JSON."""
    from .. import api

    columns = {number: stream.frames[:, number - 1] for number in api.FAPS}
    stated = {number: [value for value in column if not math.isnan(value)] for number, column in columns.items()}
    used = [number for number, values in stated.items() if values]
    seconds = len(stream.frames) / stream.fps
    data: dict[str, Any] = {
        "name": stream.name,
        "fps": stream.fps,
        "frames": len(stream.frames),
        "seconds": seconds,
        "faps": used,
        "visemes": len(stream.visemes),
        "expressions": len(stream.expressions),
        "ranges": {number: [min(stated[number]), max(stated[number])] for number in used},
        "damage": damage or [],
        "out": out,
    }
    if out is not None:
        data["bytes"] = out.stat().st_size
        data["kilobits_per_second"] = out.stat().st_size * 8 / 1000.0 / seconds
    title = f"{stream.name}: {len(stream.frames)} frames at {stream.fps:g} per second, {len(used)} FAPs"
    extra = [
        f"{len(fields)} frames with {what}"
        for what, fields in (("visemes", stream.visemes), ("expressions", stream.expressions))
        if fields
    ]
    peaks = [
        f"F{number:<3} {api.fap(number).name:<24} {min(stated[number]):8.0f} .. {max(stated[number]):8.0f}"
        for number in used
    ]
    wrote = [f"wrote {out}: {data['kilobits_per_second']:.1f} kilobits per second"] if out is not None else []
    return Result(data, [title, *extra, *peaks, *wrote])


def _tables(arguments: argparse.Namespace) -> Result:
    """Write Face Animation Tables: the effect of every FAP on every vertex, for players without muscles."""
    from .. import api

    suffix = arguments.out.suffix.lower()
    writers = {
        ".json": api.write_animation_tables,
        ".wrl": api.write_face_def_tables,
        ".txt": api.write_face_def_tables,
    }
    if suffix not in writers:
        raise UsageError(f"--out must end in {', '.join(writers)}")
    options = {"faps": arguments.faps} if arguments.faps else {}
    face = face_of(arguments)
    tables = api.face_animation_tables(
        face, steps=arguments.steps, others=arguments.others, progress=when_slow(), **options
    )
    writers[suffix](arguments.out, tables)
    rows = {
        number: {
            "name": api.fap(number).name,
            "vertices": len(table.vertices),
            "rms_mm": 1e3 * table.error.rms if table.error else None,
            "largest_mm": 1e3 * table.error.largest if table.error else None,
        }
        for number, table in tables.tables.items()
    }
    lines = [f"{len(rows)} tables of {len(tables.vertices)} vertices; error between borders, rms and largest:"]
    lines += [
        f"F{number:<3} {row['name']:<24} {row['vertices']:6d} vertices {row['rms_mm']:7.3f} {row['largest_mm']:7.3f} mm"
        for number, row in rows.items()
    ]
    return Result({"out": arguments.out, "tables": rows}, [*lines, f"wrote {arguments.out}"])
