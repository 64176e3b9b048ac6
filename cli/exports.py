"""Verb for what engines use: export csv, shapes, gltf, weights."""

from __future__ import annotations

import argparse
import io
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import FormatError
from ..files import write_whole
from ..tables import read_arrays
from .films import in_blender, needing_blender
from .options import (
    Verbs,
    add_inertia,
    add_scene,
    face_to_pose,
    motion_line,
    refuse_ending,
    refuse_idle,
    scene_options,
    verb,
)
from .progress import ShowProgress
from .recordings import RECORDING, add_recording, read_as_told, whole_frames
from .result import Result, UsageError

if TYPE_CHECKING:
    from ..api import Controls, Face

#: Files of `export shapes` that need Blender; .npz does not.
BLENDER_SUFFIXES = (".blend", ".glb")
KINDS = {
    "csv": "FAPs as a table",
    "shapes": "shape keys for engines",
    "gltf": "the clips that are baked in a .blend",
    "weights": "values of shape keys over time",
}
#: Options that each of them uses.
USED = {
    "csv": RECORDING,
    "shapes": ("mesh", "points", "object_name", "names", "morph_normals", "replace"),
    "gltf": ("mesh", "object_name", "points", "morph_normals"),
    "weights": (*RECORDING, "mesh", "points", "object_name", "shapes", "symmetric", "inertia"),
}


def add_export_verb(verbs: Verbs) -> None:
    """Add export to the verbs."""
    exporting = verb(verbs, "export", _export)
    about = "; ".join(f"{kind}: {what}" for kind, what in KINDS.items())
    exporting.add_argument("what", choices=tuple(KINDS), help=about)
    about = "csv, weights: a FAP stream or a tracker's recording"
    exporting.add_argument("source", type=Path, nargs="*", help=about)
    about = "csv, weights: .csv; shapes: .npz, or in Blender .blend or .glb; gltf: .glb or .gltf"
    exporting.add_argument("--out", type=Path, required=True, help=about)
    add_scene(exporting)
    names = (
        "shapes: arkit, ict_facekit, oculus_visemes, vrm1, talkinghead_extras, a .toml file, or several with commas "
        "between (default: arkit)"
    )
    exporting.add_argument("--names", default="arkit", help=names)
    about = "shapes, gltf: targets move the normals, too (default: they do; the file is larger)"
    exporting.add_argument("--morph-normals", action=argparse.BooleanOptionalAction, default=True, help=about)
    add_recording(exporting)
    exporting.add_argument("--replace", action="store_true", help="shapes: replace keys with the same names")
    about = "weights: .npz of the shape keys, as `export shapes` writes it: names (N,), displacement (N, V, 3)"
    exporting.add_argument("--shapes", type=Path, help=about)
    about = "weights: left and right get the same value"
    exporting.add_argument("--symmetric", action="store_true", help=about)
    add_inertia(exporting, only="weights: ")


def _export(arguments: argparse.Namespace) -> Result:
    """Write FAPs as a table, a face's shape keys or clips for engines, or values of shape keys over time."""
    used = USED[arguments.what]
    idle = (name for names in USED.values() for name in names if name not in used)
    refuse_idle(arguments, f"does nothing in export {arguments.what}: leave it out", *idle)
    exports = {"csv": _export_csv, "shapes": _export_shapes, "gltf": _export_gltf, "weights": _export_weights}
    return exports[arguments.what](arguments)


def _export_csv(arguments: argparse.Namespace) -> Result:
    """A stream as CSV."""
    from .. import api

    refuse_ending(arguments.out, ".csv")
    recording = read_as_told(_source(arguments), arguments)
    stream = recording.stream
    api.write_fap_csv(arguments.out, stream)
    data = {"frames": len(stream.frames), "fps": stream.fps, "assumed": list(recording.assumed), "out": arguments.out}
    return Result(data, [f"wrote {arguments.out}: {len(stream.frames)} frames at {stream.fps:g} per second"])


def _source(arguments: argparse.Namespace) -> Path:
    """The stream to export."""
    if len(arguments.source) != 1:
        problem = f"export {arguments.what} needs one input file: a .fap, or a tracker's .csv or .json"
        raise UsageError(problem)
    source: Path = arguments.source[0]
    return source


def _export_shapes(arguments: argparse.Namespace) -> Result:
    """Shape keys of a face."""
    if arguments.source:
        raise UsageError("export shapes takes no input file: set the face with --mesh and --points")
    suffix = arguments.out.suffix.lower()
    if suffix == ".npz":
        made = _shapes_to_npz(arguments)
    elif suffix in BLENDER_SUFFIXES:
        made = _shapes_in_blender(arguments)
    else:
        raise UsageError(f"--out must end in .npz, {' or '.join(BLENDER_SUFFIXES)}")
    keys, remarks = made["keys"], made["remarks"]
    lines = [f"wrote {arguments.out}: {len(keys)} shape keys", *keys, *(f"note: {remark}" for remark in remarks)]
    return Result({**made, "out": arguments.out}, lines)


def _shapes_to_npz(arguments: argparse.Namespace) -> dict[str, tuple[str, ...]]:
    """Write names (N,) and displacements (N, V, 3) in metres as NumPy's file; returns what there is to say."""
    from .. import api

    refuse_idle(arguments, "is for a .blend or .glb: leave it out", "replace", "morph_normals")
    scene_options(arguments)  # refuses --object where nothing has objects
    with face_to_pose(arguments) as face:
        shapes = api.arkit_shapes(face, arguments.names)
    moved = np.stack([positions - face.vertices for positions in shapes.values()])
    held = io.BytesIO()
    np.savez_compressed(held, names=np.array(list(shapes)), displacement=moved.astype(np.float32))
    write_whole(arguments.out, held.getvalue())
    remarks = tuple(f"{name}: {why}" for name, why in shapes.unmet.items())
    return {"keys": tuple(shapes), "replaced": (), "remarks": remarks}


def _shapes_in_blender(arguments: argparse.Namespace) -> dict[str, tuple[str, ...]]:
    """Write them by Blender; returns what there is to say."""
    options = scene_options(arguments) | {
        name: getattr(arguments, name) for name in ("names", "replace", "morph_normals")
    }
    with needing_blender():
        from ..scene.jobs.shapes import blendshape_file
    with in_blender():
        written = blendshape_file(arguments.out, **options, progress=ShowProgress())
    return {"keys": written.keys, "replaced": written.replaced, "remarks": written.remarks}


def _export_gltf(arguments: argparse.Namespace) -> Result:
    """The clips of a face in a .blend."""
    if arguments.source or arguments.mesh is None or arguments.mesh.suffix.lower() != ".blend":
        raise UsageError("export gltf exports what is baked in a .blend: set it with --mesh")
    if arguments.points is not None:
        raise UsageError("--points has no meaning for export gltf")
    with needing_blender():
        from ..scene.jobs.shapes import gltf_file
    with in_blender():
        made = gltf_file(
            arguments.out,
            mesh=arguments.mesh,
            object_name=arguments.object_name,
            morph_normals=arguments.morph_normals,
        )
    size = made.size
    lines = [f"wrote {made.path}: {', '.join(made.clips)}", f"size: {size.line}"]
    lines += [f"note: {remark}" for remark in made.remarks]
    data = {"out": made.path, "clips": made.clips, "bytes": size.bytes, "bytes_full": size.full}
    return Result({**data, "remarks": made.remarks}, lines)


def _export_weights(arguments: argparse.Namespace) -> Result:
    """A stream as values of shape keys over time."""
    from .. import api

    if arguments.shapes is None:
        raise UsageError("export weights needs --shapes, with the face's shape keys")
    refuse_ending(arguments.out, ".csv")
    scene_options(arguments)  # refuses --object where nothing has objects
    recording = read_as_told(_source(arguments), arguments)
    stream = recording.stream
    with face_to_pose(arguments) as face:
        controls, (frames, said) = _controls_of(arguments.shapes, face), whole_frames(recording)
        motion = api.play(face, api.FapStream(frames, fps=stream.fps), inertia=arguments.inertia)
        found = api.retarget(face, controls, motion, fps=stream.fps, requested=frames, symmetric=arguments.symmetric)
    values = np.zeros((len(found.values), len(controls)))
    values[:, [controls.names.index(name) for name in found.names]] = found.values
    api.write_weight_csv(arguments.out, controls.names, values, fps=stream.fps)
    off_mm = 1000.0 * float(found.off[int(np.argmax(found.moved))])
    missing = {api.fap(short.number).name: {"asked": short.asked, "shown": short.shown} for short in found.missing}
    data = {
        "frames": len(values),
        "fps": stream.fps,
        "names": list(controls.names),
        "explained": found.explained,
        "off_mm": off_mm,
        "carriers": dict(found.carriers),
        "missing": missing,
        "unmet": {api.fap(number).name: why for number, why in found.unmet.items()},
        "still": list(found.still),
        "same": dict(found.same),
        "inertia": arguments.inertia,
        "assumed": [*recording.assumed, *said],
        "out": arguments.out,
    }
    lines = [
        f"wrote {arguments.out}: {len(values)} frames at {stream.fps:g} per second of {len(controls)} shape keys",
        f"they show {found.explained:.0%} of the motion, {off_mm:.1f} mm off at its peak",
        f"motion: {motion_line(arguments.inertia)}",
        *(f"note: too little of {short.line}" for short in found.missing),
        *(f"note: {line}" for line in api.unmet_lines(found.unmet)),
    ]
    return Result(data, lines)


def _controls_of(path: Path, face: Face) -> Controls:
    """The shape keys of a .npz as controls from 0 to 1.

    Raises
    ------
    FormatError : it cannot be read, or is not of this face.
    """
    from .. import api

    rule = f"must have names (N,) and displacement (N, {len(face.vertices)}, 3), as `export shapes` writes them"
    stored = read_arrays(path, "names", "displacement")
    named, effects = stored.get("names"), stored.get("displacement")
    if named is None or effects is None or named.dtype.kind != "U" or effects.dtype.kind not in "iuf":
        raise FormatError(path, f"cannot be read as shape keys: it {rule}")
    if named.ndim != 1 or effects.shape != (len(named), len(face.vertices), 3):
        raise FormatError(path, f"{rule}, but displacement is {effects.shape}")
    names = [str(name) for name in named]
    effects = effects.astype(np.float64)
    return api.Controls(tuple(names), effects, np.zeros(len(names)), np.ones(len(names)))
