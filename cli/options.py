"""Options that several verbs share, and what they stand for."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from ..arrays import Floats
from ..errors import ParameterError
from .kept import kept_face
from .result import Result, UsageError

if TYPE_CHECKING:
    from ..api import Face, Profile

#: What verbs are added to.
Verbs: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"


def verb(verbs: Verbs, name: str, run: Callable[[argparse.Namespace], Result]) -> argparse.ArgumentParser:
    """A verb: its help is the docstring of the function that runs it."""
    about = (run.__doc__ or "").strip()
    parser = verbs.add_parser(name, help=about, description=about)
    parser.set_defaults(run=run, parser=parser)
    parser.add_argument("--json", action="store_true", help="print the result as JSON")
    return parser


#: Options whose names are not those of what they set.
OPTIONS = {"object_name": "--object", "word": "--emotion"}


def refuse_idle(arguments: argparse.Namespace, why: str, *names: str) -> None:
    """Refuse options that are given although they would do nothing; `why` ends the message.

    Raises
    ------
    UsageError : names the first of them.
    """
    for name in names:
        if getattr(arguments, name) != arguments.parser.get_default(name):
            raise UsageError(f"{OPTIONS.get(name, '--' + name.replace('_', '-'))} {why}")


def refuse_ending(path: Path | None, *endings: str) -> None:
    """Refuse a file to write whose name ends otherwise: it would not be what its name says.

    Raises
    ------
    UsageError : names the endings.
    """
    if path is not None and path.suffix.lower() not in endings:
        raise UsageError(f"--out must end in {' or '.join(endings)}")


def add_words(parser: argparse.ArgumentParser, nargs: str = "+") -> None:
    parser.add_argument("words", nargs=nargs, metavar="WORD", help="emotion words, shown one after another")


def _variant(text: str) -> int | str:
    """A variant of the paper's by its number, or a way of showing an emotion by its name."""
    return int(text) if text.isdecimal() and len(text) < 16 else text


def add_strength(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--activation", type=float, help="how strongly the emotion is felt, 1 to 7 (default: the word's own)"
    )
    parser.add_argument(
        "--variant",
        type=_variant,
        help="number of the emotion's variant in the paper, or how it shows: anger bared, pressed or glaring, "
        "joy open or closed, fear drawn or raised, disgust shut or open",
    )


def add_fps(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--fps", type=float, default=25.0, help="frames per second (default: 25)")


def add_scene(parser: argparse.ArgumentParser) -> None:
    """Options of a verb that works in Blender: whose face, and how fast it plays."""
    parser.add_argument("--mesh", type=Path, help="the neutral face: .npz, .obj, .blend, .glb or .gltf")
    parser.add_argument(
        "--object", dest="object_name", metavar="NAME", help="the object of the file that has the face (default: found)"
    )
    parser.add_argument(
        "--points", type=Path, help="its feature points (JSON); without it, they are found automatically"
    )


def scene_options(arguments: argparse.Namespace) -> dict[str, Any]:
    """What `add_scene` has asked for, as the jobs of `scene` want it."""
    if arguments.mesh is None:
        for name, value in (("--points", arguments.points), ("--object", arguments.object_name)):
            if value is not None:
                raise UsageError(f"{name} needs --mesh")
    elif arguments.object_name is not None and arguments.mesh.suffix.lower() in (".npz", ".obj"):
        raise UsageError(f"--object needs a .blend, .glb or .gltf: {arguments.mesh} is read as one mesh")
    return {name: getattr(arguments, name) for name in ("mesh", "points", "object_name")}


def add_timing(parser: argparse.ArgumentParser) -> None:
    """How strongly each word is felt, and how long its expression takes."""
    parser.add_argument(
        "--activation", type=float, help="how strongly each emotion is felt, 1 to 7 (default: the word's own)"
    )
    about = "how each expression comes and goes: flash, natural, posed, spontaneous, slow (default: natural)"
    parser.add_argument("--timing", metavar="NAME", default="natural", help=about)
    for name, what in (("onset", "appear"), ("apex", "stay"), ("offset", "fade")):
        parser.add_argument(f"--{name}", type=float, metavar="S", help=f"seconds to {what} (default: of --timing)")


def timing_options(arguments: argparse.Namespace) -> dict[str, Any]:
    """What `add_timing` has asked for, as the jobs of `scene` want it."""
    from .. import api

    timings = api.load_timings()
    if arguments.timing not in timings:
        raise ParameterError("--timing", f"must be one of {', '.join(timings)}", arguments.timing)
    given = {name: getattr(arguments, name) for name in ("onset", "apex", "offset")}
    seconds = {name: value for name, value in given.items() if value is not None}
    return {"activation": arguments.activation, "timing": replace(timings[arguments.timing], **seconds)}


def add_onto(parser: argparse.ArgumentParser) -> None:
    """Which shape keys or controls are keyed."""
    about = "what is keyed: new shape keys, or the keys or the bones that the face of --mesh has (default: new)"
    parser.add_argument("--onto", choices=("new", "keys", "bones"), default="new", help=about)
    parser.add_argument("--symmetric", action="store_true", help="--onto keys, bones: left and right move alike")
    about = "--onto keys, bones: how smooth a motion is over time; 0 leaves each frame to itself (default: 1)"
    parser.add_argument("--smooth", type=float, metavar="AMOUNT", help=about)
    about = "--onto keys, bones: key the action that plays, instead of laying a clip over it that can be taken off"
    parser.add_argument("--into-action", action="store_true", help=about)
    about = "--onto new: at most N shape keys for a motion, the best ones; says how far it is off (default: no limit)"
    parser.add_argument("--max-keys", type=int, metavar="N", help=about)


def onto_options(arguments: argparse.Namespace, *, moves: bool = True) -> dict[str, Any]:
    """What `add_onto` has asked for; `moves` : whether a motion is baked, not single poses."""
    asked = {name: getattr(arguments, name) for name in ("symmetric", "smooth", "into_action")}
    given = {name: value for name, value in asked.items() if value not in (None, False)}
    if arguments.max_keys is not None:
        if arguments.onto != "new":
            raise UsageError("--max-keys needs --onto new: your own keys and bones are as many as they are")
        if not moves:
            raise UsageError("--max-keys needs --dynamic: without it, each expression is one shape key")
        if arguments.max_keys < 1:
            raise UsageError("--max-keys must be 1 or more")
    if arguments.onto == "new":
        for name in given:
            raise UsageError(f"--{name.replace('_', '-')} needs --onto keys or bones")
        return {"onto": "new", "max_keys": arguments.max_keys}
    if arguments.mesh is None:
        raise UsageError(f"--onto {arguments.onto} needs --mesh: the default head has no controls of its own")
    if arguments.creases:
        raise UsageError("--creases needs --onto new")
    if "smooth" in given and not moves:
        raise UsageError("--smooth needs --dynamic: without it, each expression is one pose")
    return {"onto": arguments.onto, **given}


def add_inertia(parser: argparse.ArgumentParser, *, only: str = "") -> None:
    """Whether a stream that is played gets the inertia of skin and jaw."""
    about = f"{only}add the inertia of skin and jaw, for streams that were computed without it (default: each frame as "
    about += "it is: a recorded face has moved with its own)"
    parser.add_argument("--inertia", action=argparse.BooleanOptionalAction, default=False, help=about)


def motion_line(inertia: bool) -> str:
    """What was done with a stream that was played."""
    return "with the inertia of skin and jaw" if inertia else "each frame as it is, without added inertia"


def add_engine(parser: argparse.ArgumentParser) -> None:
    choices = ("WORKBENCH", "CYCLES", "EEVEE")
    parser.add_argument("--engine", choices=choices, type=str.upper, default=choices[0], help="default: WORKBENCH")


def add_labels(parser: argparse.ArgumentParser) -> None:
    """The truth beside a video."""
    about = "also write labels of every frame to this folder: FAPs, muscles, emotion, landmarks, camera (.mp4 only)"
    parser.add_argument("--labels", type=Path, metavar="FOLDER", help=about)
    about = "with --labels: areas, objects, depth and normals of every N-th frame as images (default: 0, none)"
    parser.add_argument("--label-images", type=int, default=0, metavar="N", help=about)
    parser.add_argument("--licence", default="", metavar="TEXT", help="with --labels: licence of the head of --mesh")


def add_film(parser: argparse.ArgumentParser) -> None:
    """Options of a verb that films a motion: whose face, what is keyed, how it looks, and the truth beside it."""
    for add in (add_scene, add_onto, add_engine, add_creases, add_labels):
        add(parser)


def add_creases(parser: argparse.ArgumentParser) -> None:
    about = "draw wrinkles where skin is compressed, in Cycles and EEVEE (default: on the default head only)"
    parser.add_argument("--creases", action=argparse.BooleanOptionalAction, help=about)


def add_face(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--mesh", type=Path, help="the neutral face: .npz or .obj")
    parser.add_argument(
        "--points", type=Path, help="its feature points (JSON); without it, they are found automatically"
    )
    add_fps(parser)


def expression_of(arguments: argparse.Namespace) -> Profile:
    """The profile of the word, or of the angle and activation."""
    from .. import api

    if (arguments.word is None) == (arguments.angle is None):
        raise UsageError("give either a word, or --angle with --activation")
    if arguments.angle is not None:
        if arguments.activation is None:
            raise UsageError("--angle needs --activation")
        return api.expression(angle=arguments.angle, activation=arguments.activation, variants=arguments.variant)
    return api.expression(arguments.word, activation=arguments.activation, variants=arguments.variant)


def face_of(arguments: argparse.Namespace) -> Face:
    """The face of --mesh and --points; the default one without them."""
    from .. import api

    given = _given_face(arguments)
    return api.Face.from_arrays(*given) if given else api.default_face()


def face_to_pose(arguments: argparse.Namespace) -> AbstractContextManager[Face]:
    """As `face_of`, prepared already where it has been kept; it is kept at the end."""
    return kept_face(*_given_face(arguments))


def _given_face(arguments: argparse.Namespace) -> tuple[Any, ...]:
    """Vertices, polygons and points of --mesh and --points; nothing without them."""
    from .. import api

    if (arguments.mesh is None) != (arguments.points is None):
        raise UsageError("--mesh and --points must be given together")
    if arguments.mesh is None:
        return ()
    mesh = api.read_mesh(arguments.mesh)
    return mesh.vertices, mesh.polygons, api.read_point_file(arguments.points)


def vertices_of(path: Path, face: Face) -> Floats:
    """(V, 3) vertices of a deformed mesh, as many as the face has."""
    from .. import api

    vertices = api.read_mesh(path).vertices
    if len(vertices) != len(face.vertices):
        rule = f"must have the neutral face's {len(face.vertices)} vertices"
        raise ParameterError(str(path), rule, len(vertices))
    return vertices
