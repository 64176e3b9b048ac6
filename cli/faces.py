"""Verbs that look at a mesh: measure, points."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Floats
from ..errors import ModelError
from ..files import write_whole
from .faps import fap_lines, named_faps, range_lines, ranges_of
from .options import Verbs, add_face, face_of, refuse_ending, refuse_idle, verb, vertices_of
from .recordings import RECORDING, WRITABLE, add_recording, is_recording, read_as_told
from .result import Result, UsageError

if TYPE_CHECKING:
    from ..api import Face


def add_face_verbs(verbs: Verbs) -> None:
    """Add measure and points to the verbs."""
    measure = verb(verbs, "measure", _measure)
    measure.add_argument(
        "deformed",
        type=Path,
        nargs="+",
        help="deformed meshes with the same vertices as the neutral face; or a FAP stream or a tracker's recording",
    )
    add_recording(measure)
    add_face(measure)
    measure.add_argument("--out", type=Path, help=f"write the FAPs to this stream ({WRITABLE}), a frame for each mesh")

    points = verb(verbs, "points", _points)
    about = (
        'a JSON file {"8.4": vertex index or [x, y, z], ...} to check; without it, the points are found automatically'
    )
    points.add_argument("points", type=Path, nargs="?", help=about)
    points.add_argument("--mesh", type=Path, required=True, help="the mesh of the points: .npz or .obj")
    points.add_argument("--out", type=Path, help="write the found points to this JSON file")


def _measure(arguments: argparse.Namespace) -> Result:
    """Measure the FAPs and features of deformed meshes against a neutral mesh, or the FAPs of a recording."""
    from .. import api

    refuse_ending(arguments.out, *api.WRITABLE_STREAMS)
    if any(is_recording(path) for path in arguments.deformed):
        return _measure_recording(arguments)
    refuse_idle(arguments, "is for a recording: leave it out with meshes", *RECORDING)
    face = face_of(arguments)
    measured, features = {}, {}
    for path in arguments.deformed:
        vertices = vertices_of(path, face)
        measured[str(path)], features[str(path)] = face.measure(vertices), _features(face, vertices)
    if arguments.out:
        stream = api.FapStream(frames=np.stack(list(measured.values())), fps=arguments.fps, name=arguments.out.stem)
        api.write_stream(arguments.out, stream)
    lines = []
    for path, faps in measured.items():
        lines += [path, *fap_lines(faps), *_feature_lines(features[path])]
    return Result({path: {**named_faps(faps), **features[path]} for path, faps in measured.items()}, lines)


def _measure_recording(arguments: argparse.Namespace) -> Result:
    """The FAPs of a stream or a recording, as ranges; features are of meshes."""
    from .. import api

    if len(arguments.deformed) > 1:
        raise UsageError("give one recording, or meshes only")
    refuse_idle(arguments, "is for meshes: leave it out with a recording", "mesh", "points", "fps")
    path = arguments.deformed[0]
    recording = read_as_told(path, arguments)
    if arguments.out:
        api.write_stream(arguments.out, recording.stream)
    ranges = ranges_of(recording.stream)
    data = {
        "format": str(recording.format),
        "frames": len(recording.stream.frames),
        "fps": recording.stream.fps,
        "ranges": ranges,
        "assumed": list(recording.assumed),
    }
    about = f"{path}: {len(recording.stream.frames)} frames of FAPs ({recording.format}); features need meshes"
    return Result({str(path): data}, [about, *range_lines(ranges)])


def _features(face: Face, vertices: Floats) -> dict[str, float]:
    """Features f1 to f15 of a deformed mesh; none where the face lacks points for them."""
    try:
        return {f"f{index + 1}": float(value) for index, value in enumerate(face.features(vertices))}
    except ModelError as lack:
        print(f"risorius measure: {lack}", file=sys.stderr)
        return {}


def _feature_lines(features: Mapping[str, float]) -> list[str]:
    """The features, a line each."""
    from .. import api

    known = {f"f{feature.number}": feature for feature in api.FEATURES}
    return [
        f"{name:<4} {f'{known[name].point_a} to {known[name].point_b}':<24} {value:8.1f}  {known[name].unit}"
        for name, value in features.items()
    ]


def _points(arguments: argparse.Namespace) -> Result:
    """Find the feature points of a mesh, or check given points."""
    if arguments.points is None:
        return _found_points(arguments)
    if arguments.out is not None:
        raise UsageError("--out is for found points only: leave out --out or the file to check")
    face = face_of(arguments)
    units = {name: getattr(face.units, name) for name in ("irisd0", "es0", "ens0", "mns0", "mw0")}
    lines = [f"{len(face.points)} feature points fit {arguments.mesh}"]
    lines += [f"{name.upper():<7} {1000.0 * value:7.2f} mm" for name, value in units.items()]
    return Result({"points": len(face.points), "fapu_m": units}, lines)


def _found_points(arguments: argparse.Namespace) -> Result:
    """Feature points found on a mesh; written as the JSON that every verb reads."""
    from .. import api

    mesh = api.read_mesh(arguments.mesh)
    found = api.find_points(mesh.vertices, mesh.polygons)
    positions = {name: place.tolist() for name, place in found.positions.items()}
    if arguments.out is not None:
        write_whole(arguments.out, json.dumps(positions, indent=1) + "\n")
    how = f"by its topology ({found.topology})" if found.topology else f"score {found.score:.2f}"
    lines = [f"{len(positions)} feature points found on {arguments.mesh}, {how}"]
    lines += ["the face is unlike most faces: check every point"] if found.is_doubtful else []
    lines += [f"doubtful points to check: {', '.join(found.doubtful)}"] if found.doubtful else []
    lines += [f"wrote {arguments.out}"] if arguments.out else []
    return Result(
        {"points": positions, "confidence": found.confidence, "score": found.score, "topology": found.topology}, lines
    )
