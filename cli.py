"""The command line: argparse over `api`, and over `scene` for what needs Blender. No logic of its own.

`risorius VERB`, `python -m risorius VERB` and `blender --command risorius VERB` are the same. Exit code 0 on success,
2 on wrong usage, 1 otherwise. With `--json` the result is one JSON object on standard output.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import math
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .errors import ParameterError, RisoriusError
from .face.fit.doubt import DOUBTFUL

DESCRIPTION = "An emotion word and an activation become a moving face."
NEEDS_BLENDER = (
    "this verb needs Blender: run it as `blender --command risorius ...`, or `pip install bpy` into this Python"
)


@dataclass(frozen=True)
class Result:
    """What a verb has to say: `data` for --json, `lines` for people."""

    data: Mapping[str, Any]
    lines: Sequence[str]


def main(argv: list[str] | None = None) -> int:
    """Run one verb and print its result.

    Parameters
    ----------
    argv : the arguments after the program's name; by default those of this process.

    Returns
    -------
    int
        0 on success, 2 on wrong usage, 1 on any error that Risorius raises on purpose.
    """
    parser = _parser()
    try:
        arguments = parser.parse_args(argv)
    except SystemExit as ended:  # argparse has said why
        return int(ended.code or 0)
    try:
        result: Result = arguments.run(arguments)
    except _UsageError as error:
        print(f"risorius {arguments.verb}: {error}", file=sys.stderr)
        return 2
    except (RisoriusError, OSError) as error:
        print(f"risorius {arguments.verb}: {error}", file=sys.stderr)
        return 1
    with contextlib.suppress(BrokenPipeError):  # the reader (head, less) has seen enough
        print(json.dumps(_plain(result.data), indent=1) if arguments.json else "\n".join(result.lines), flush=True)
    return 0


class _UsageError(Exception):
    """Options that do not go together."""


# ---- verbs --------------------------------------------------------------------------------------------------------


def _profile(arguments: argparse.Namespace) -> Result:
    """An expression's FAP ranges."""
    profile = _expression(arguments)
    from . import api

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


def _bake(arguments: argparse.Namespace) -> Result:
    """Bake expressions onto a face and save the .blend."""
    return _made("bake_file", arguments, dynamic=arguments.dynamic)


def _render(arguments: argparse.Namespace) -> Result:
    """Bake and film expressions."""
    return _made("render_film", arguments, engine=arguments.engine)


def _demo(arguments: argparse.Namespace) -> Result:
    """The six archetypes in one film, with its .blend and contact sheet."""
    return _made("demo", arguments, engine=arguments.engine)


def _measure(arguments: argparse.Namespace) -> Result:
    """FAPs of deformed meshes against a neutral one."""
    from . import api

    face = _face(arguments)
    frames = {str(path): face.measure(_vertices(path, face)) for path in arguments.deformed}
    if arguments.out:
        stream = api.FapStream(frames=np.stack(list(frames.values())), fps=arguments.fps, name=arguments.out.stem)
        api.write_fap(arguments.out, stream)
    lines = [line for path, frame in frames.items() for line in (path, *_frame_lines(frame))]
    return Result({path: _named(frame) for path, frame in frames.items()}, lines)


def _recognise(arguments: argparse.Namespace) -> Result:
    """Beliefs in the archetypes, from a .fap file or a deformed mesh."""
    from . import api

    if arguments.file.suffix.lower() == ".fap":
        frames = api.read_fap(arguments.file).expanded()
        strongest = int(np.nansum(np.abs(frames), axis=1).argmax())
        index = strongest if arguments.frame is None else arguments.frame
        if not 0 <= index < len(frames):
            raise ParameterError("frame", f"must lie in 0..{len(frames) - 1}", index)
        frame = frames[index]
    else:
        face = _face(arguments)
        frame = face.measure(_vertices(arguments.file, face))
    beliefs = {str(name): belief for name, belief in api.recognise(frame).items()}
    beliefs = dict(sorted(beliefs.items(), key=lambda item: -item[1]))
    return Result(beliefs, [f"{name:<12} {belief:.3f}" for name, belief in beliefs.items()])


def _fap(arguments: argparse.Namespace) -> Result:
    """Look into a .fap file, convert it, or write an expression as one."""
    from . import api

    if Path(arguments.source).suffix.lower() == ".fap":
        stream = api.read_fap(Path(arguments.source))
    else:
        arguments.word, arguments.angle = arguments.source, None
        timing = api.load_timings()["natural"]
        profile = _expression(arguments)
        frames = api.envelope(
            profile, onset=timing.onset, apex=timing.apex, offset=timing.offset, fps=arguments.fps
        )
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


def _points(arguments: argparse.Namespace) -> Result:
    """Find the feature points of a mesh, or check a file of them against it."""
    if arguments.points is None:
        return _found_points(arguments)
    if arguments.out is not None:
        raise _UsageError("--out belongs to points that are found; leave out the file to check")
    face = _face(arguments)
    units = {name: getattr(face.units, name) for name in ("irisd0", "es0", "ens0", "mns0", "mw0")}
    lines = [f"{len(face.points)} feature points fit {arguments.mesh}"]
    lines += [f"{name.upper():<7} {1000.0 * value:7.2f} mm" for name, value in units.items()]
    return Result({"points": len(face.points), "fapu_m": units}, lines)


def _point_order(name: str) -> tuple[int, ...]:
    """Feature points by group and number."""
    return tuple(int(part) for part in name.split("."))


def _found_points(arguments: argparse.Namespace) -> Result:
    """Feature points found on a mesh; written as the JSON that every verb reads."""
    from . import api
    from .face.mesh_file import read_mesh

    mesh = read_mesh(arguments.mesh)
    found = api.find_points(mesh.vertices, mesh.polygons)
    positions = {name: place.tolist() for name, place in found.positions.items()}
    if arguments.out is not None:
        arguments.out.write_text(json.dumps(positions, indent=1) + "\n", encoding="utf-8")
    how = f"by its topology ({found.topology})" if found.topology else f"score {found.score:.2f}"
    doubtful = sorted((name for name, sure in found.confidence.items() if sure < DOUBTFUL), key=_point_order)
    lines = [f"{len(positions)} feature points found on {arguments.mesh}, {how}"]
    lines += ["the face is unlike most: look at every point"] if found.is_doubtful else []
    lines += [f"look at: {', '.join(doubtful)}"] if doubtful else []
    lines += [f"wrote {arguments.out}"] if arguments.out else []
    return Result(
        {"points": positions, "confidence": found.confidence, "score": found.score, "topology": found.topology}, lines
    )


# ---- what the verbs share -----------------------------------------------------------------------------------------


def _expression(arguments: argparse.Namespace) -> Any:
    """The profile of the word, or of the angle and activation."""
    from . import api

    if (arguments.word is None) == (arguments.angle is None):
        raise _UsageError("give either a word, or --angle with --activation")
    if arguments.angle is not None:
        if arguments.activation is None:
            raise _UsageError("--angle needs --activation")
        return api.expression(angle=arguments.angle, activation=arguments.activation)
    return api.expression(arguments.word, activation=arguments.activation, variants=arguments.variant)


def _face(arguments: argparse.Namespace) -> Any:
    """The face of --mesh and --points; the default one without them."""
    from . import api
    from .face.mesh_file import read_mesh
    from .scene.points_file import read_points

    if (arguments.mesh is None) != (arguments.points is None):
        raise _UsageError("--mesh and --points go together")
    if arguments.mesh is None:
        return api.default_face()
    mesh = read_mesh(arguments.mesh)
    return api.Face.from_arrays(mesh.vertices, mesh.polygons, read_points(arguments.points))


def _vertices(path: Path, face: Any) -> Any:
    """The vertices of a deformed mesh, as many as the face has."""
    from .face.mesh_file import read_mesh

    vertices = read_mesh(path).vertices
    if len(vertices) != len(face.vertices):
        rule = f"must have the neutral face's {len(face.vertices)} vertices"
        raise ParameterError(str(path), rule, len(vertices))
    return vertices


def _jobs() -> Any:
    """The jobs that need Blender; imported only here."""
    try:
        from .scene import jobs
    except ModuleNotFoundError as missing:
        if missing.name in ("bpy", "mathutils"):
            raise RisoriusError(NEEDS_BLENDER) from None
        raise
    return jobs


def _job_options(arguments: argparse.Namespace) -> dict[str, Any]:
    """The options that all jobs share."""
    if arguments.mesh is None and arguments.points is not None:
        raise _UsageError("--points needs --mesh")
    shared = {name: getattr(arguments, name) for name in ("mesh", "points", "fps", "creases")}
    words = {"words": tuple(arguments.words)} if arguments.words else {}
    return {**shared, **words, "progress": _ShowProgress()}


class _ShowProgress:
    """One line per whole percent, on standard error so that --json stays clean."""

    def __init__(self) -> None:
        self.shown = -1

    def __call__(self, step: Any) -> None:
        percent = int(100.0 * step.fraction)
        if percent != self.shown:
            self.shown = percent
            print(f"{percent:3d} %  {step.text}", file=sys.stderr, flush=True)


@contextlib.contextmanager
def _silent_blender() -> Iterator[None]:
    """Keep what Blender prints for every frame it saves off standard output, at the level where it writes."""
    sys.stdout.flush()
    kept = os.dup(1)
    try:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), 1)
        yield
    finally:
        sys.stdout.flush()
        os.dup2(kept, 1)
        os.close(kept)


def _made(job: str, arguments: argparse.Namespace, **options: object) -> Result:
    """Run a job, and name the files that it has written."""
    run = getattr(_jobs(), job)
    with _silent_blender():
        made = dict(run(arguments.out, **_job_options(arguments), **options))
    return Result(made, [f"{key}: {value}" for key, value in made.items()])


def _frame_lines(frame: Any) -> list[str]:
    """The FAPs of a frame that have a value, a line each."""
    from . import api

    named = ((api.fap(index + 1), value) for index, value in enumerate(frame) if not math.isnan(value))
    return [f"F{fap.number:<3} {fap.name:<24} {value:8.1f}  {fap.unit}" for fap, value in named]


def _named(frame: Any) -> dict[str, float]:
    """FAP name -> value, without the FAPs that have none."""
    from . import api

    return {api.fap(index + 1).name: float(value) for index, value in enumerate(frame) if not math.isnan(value)}


def _plain(value: Any) -> Any:
    """What json can write: paths as strings, arrays as lists, NaN as null, dataclasses as objects."""
    if is_dataclass(value) and not isinstance(value, type):
        return {field.name: _plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if hasattr(value, "tolist"):
        return _plain(value.tolist())
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if value is None or isinstance(value, str | int | float | bool) else str(value)


# ---- options ------------------------------------------------------------------------------------------------------


def _parser() -> argparse.ArgumentParser:
    """All verbs and their options."""
    parser = argparse.ArgumentParser(prog="risorius", description=DESCRIPTION)
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB")

    profile = _verb(verbs, "profile", _profile)
    profile.add_argument("word", nargs="?", help="an emotion word")
    profile.add_argument("--angle", type=float, help="degrees on the emotion wheel, instead of a word")
    _add_strength(profile)

    bake = _verb(verbs, "bake", _bake)
    _add_words(bake)
    _add_face(bake)
    _add_creases(bake)
    bake.add_argument("--dynamic", action="store_true", help="simulate the motion instead of posing the apex")
    bake.add_argument("--out", type=Path, required=True, help="the .blend to write")

    render = _verb(verbs, "render", _render)
    _add_words(render)
    _add_face(render)
    _add_engine(render)
    _add_creases(render)
    render.add_argument("--out", type=Path, required=True, help="the .mp4 to write")

    measure = _verb(verbs, "measure", _measure)
    measure.add_argument("deformed", type=Path, nargs="+", help="meshes with the neutral face's vertices, moved")
    _add_face(measure)
    measure.add_argument("--out", type=Path, help="a .fap file to write, a frame per mesh")

    recognise = _verb(verbs, "recognise", _recognise)
    recognise.add_argument("file", type=Path, help="a .fap file, or a deformed mesh")
    recognise.add_argument("--frame", type=int, help="which frame of a .fap file (default: the strongest)")
    _add_face(recognise)

    fap = _verb(verbs, "fap", _fap)
    fap.add_argument("source", help="a .fap file to look into, or an emotion word to write as one")
    _add_strength(fap)
    _add_fps(fap)
    fap.add_argument("--out", type=Path, help="the .fap file to write")

    points = _verb(verbs, "points", _points)
    about = 'a JSON file {"8.4": vertex index or [x, y, z], ...} to check; without it, the points are found'
    points.add_argument("points", type=Path, nargs="?", help=about)
    points.add_argument("--mesh", type=Path, required=True, help="the mesh they belong to, .npz or .obj")
    points.add_argument("--out", type=Path, help="the JSON file to write found points to")

    demo = _verb(verbs, "demo", _demo)
    _add_words(demo, nargs="*")
    _add_face(demo)
    _add_engine(demo)
    _add_creases(demo)
    demo.add_argument("--out", type=Path, default=Path("out"), help="the folder to fill (default: out)")
    return parser


def _verb(verbs: Any, name: str, run: Callable[[argparse.Namespace], Result]) -> argparse.ArgumentParser:
    """A verb: its help is the docstring of the function that runs it."""
    about = (run.__doc__ or "").strip()
    parser: argparse.ArgumentParser = verbs.add_parser(name, help=about, description=about)
    parser.set_defaults(run=run)
    parser.add_argument("--json", action="store_true", help="print the result as JSON")
    return parser


def _add_words(parser: argparse.ArgumentParser, nargs: str = "+") -> None:
    parser.add_argument("words", nargs=nargs, metavar="WORD", help="emotion words, shown one after another")


def _add_strength(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--activation", type=float, help="1..7 (default: the word's own)")
    parser.add_argument("--variant", type=int, help="which of the paper's variants of the emotion")


def _add_fps(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--fps", type=float, default=25.0, help="frames per second (default: 25)")


def _add_engine(parser: argparse.ArgumentParser) -> None:
    choices = ("WORKBENCH", "CYCLES", "EEVEE")
    parser.add_argument("--engine", choices=choices, type=str.upper, default=choices[0], help="default: WORKBENCH")


def _add_creases(parser: argparse.ArgumentParser) -> None:
    about = "wrinkles where skin is squeezed, in Cycles and EEVEE (default: on the default head only)"
    parser.add_argument("--creases", action=argparse.BooleanOptionalAction, help=about)


def _add_face(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--mesh", type=Path, help="the neutral face: .npz or .obj; in Blender also .blend or .glb")
    parser.add_argument("--points", type=Path, help="its feature points, a JSON file; without it they are found")
    _add_fps(parser)
