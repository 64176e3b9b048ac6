"""Verbs for what trackers and engines use: import, export."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from ..errors import FormatError
from .films import needing_blender, silent_blender
from .options import Verbs, add_scene, face_of, scene_options, verb
from .progress import ShowProgress
from .recordings import add_recording, read_as_told
from .result import Result, UsageError

#: Files of `export shapes` that need Blender; .npz does not.
BLENDER_SUFFIXES = (".blend", ".glb")


def add_capture_verbs(verbs: Verbs) -> None:
    """Add import and export to the verbs."""
    importing = verb(verbs, "import", _import)
    importing.add_argument("file", type=Path, help="OpenFace, ARKit, Live Link Face or MediaPipe: .csv, .json, .jsonl")
    importing.add_argument("--out", type=Path, help="the .fap file to write")
    importing.add_argument("--fps", type=float, help="frames per second of the stream (default: the recording's)")
    add_recording(importing)

    exporting = verb(verbs, "export", _export)
    exporting.add_argument(
        "what", choices=("csv", "shapes"), help="csv: FAPs as a table; shapes: shape keys for engines"
    )
    exporting.add_argument("source", type=Path, nargs="*", help="csv: a .fap file or a tracker's recording")
    exporting.add_argument(
        "--out", type=Path, required=True, help="csv: .csv; shapes: .npz, or in Blender .blend or .glb"
    )
    add_scene(exporting)
    names = "shapes: arkit, ict_facekit, oculus_visemes, or a .toml file (default: arkit)"
    exporting.add_argument("--names", default="arkit", help=names)
    about = "shapes to .glb: targets move the normals, too (default: they do; the file is larger)"
    exporting.add_argument("--morph-normals", action=argparse.BooleanOptionalAction, default=True, help=about)
    add_recording(exporting)
    exporting.add_argument("--replace", action="store_true", help="shapes: replace keys with the same names")


def _import(arguments: argparse.Namespace) -> Result:
    """Convert a tracker's recording to a FAP stream."""
    from .. import api

    recording = read_as_told(arguments.file, arguments, fps=arguments.fps)
    stream = recording.stream
    if arguments.out:
        api.write_fap(arguments.out, stream)
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


def _export(arguments: argparse.Namespace) -> Result:
    """Write FAPs as a table, or a face's shape keys with names for engines."""
    return _export_csv(arguments) if arguments.what == "csv" else _export_shapes(arguments)


def _export_csv(arguments: argparse.Namespace) -> Result:
    """A stream as CSV."""
    from .. import api

    if len(arguments.source) != 1:
        raise UsageError("export csv needs one input file: a .fap, or a tracker's .csv or .json")
    recording = read_as_told(arguments.source[0], arguments)
    stream = recording.stream
    api.write_fap_csv(arguments.out, stream)
    data = {"frames": len(stream.frames), "fps": stream.fps, "assumed": list(recording.assumed), "out": arguments.out}
    return Result(data, [f"wrote {arguments.out}: {len(stream.frames)} frames at {stream.fps:g} per second"])


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

    scene_options(arguments)  # refuses --object where nothing has objects
    face = face_of(arguments)
    shapes = api.arkit_shapes(face, arguments.names)
    moved = np.stack([positions - face.vertices for positions in shapes.values()])
    try:
        np.savez_compressed(arguments.out, names=np.array(list(shapes)), displacement=moved.astype(np.float32))
    except OSError as error:
        problem = f"cannot be written ({error.strerror}): choose a folder you may write to"
        raise FormatError(arguments.out, problem) from error
    remarks = tuple(f"{name}: {why}" for name, why in shapes.unmet.items())
    return {"keys": tuple(shapes), "replaced": (), "remarks": remarks}


def _shapes_in_blender(arguments: argparse.Namespace) -> dict[str, tuple[str, ...]]:
    """Write them by Blender; returns what there is to say."""
    options = scene_options(arguments) | {
        name: getattr(arguments, name) for name in ("names", "replace", "morph_normals")
    }
    with needing_blender():
        from ..scene.jobs.shapes import blendshape_file
    with silent_blender():
        written = blendshape_file(arguments.out, **options, progress=ShowProgress())
    return {"keys": written.keys, "replaced": written.replaced, "remarks": written.remarks}
