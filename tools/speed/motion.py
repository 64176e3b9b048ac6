"""A motion of four overlapping emotions on each head: time per phase, beside Blender's own solvers; its error.

Every head is measured in a process of its own, everything of it in one run: the motion by the way that faces move, with
all that surrounds it, and Blender's cloth, soft body and XPBD cloth on the skin of the same head with their default
settings. The error is the largest distance of any vertex in any frame from the implicit integrator with eight steps per
frame, as a share of the largest motion. Processor time.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import risorius.api as api
from places import OUT, shared_folder
from risorius.progress import run
from risorius.scene.bake.compress import TOLERANCE, gathering, squeeze

from .growth import FPS, PREVIEWS, Watch, done, gather, previews
from .machine import bandwidth
from .solvers import blender_frame
from .xpbd import xpbd_frame

#: Files of heads in the shared folder. Points stand beside a file or are found.
HEADS = (
    "default",
    *("ict.npz", "ict_narrow.npz", "makehuman.npz", "makehuman_body.npz", "mediapipe.npz", "suzanne.npz"),
    *("others/jeeliz_human/base.obj", "others/jeeliz_boy/base.obj", "others/leeperrysmith/leeperrysmith.obj"),
    *("others/mhr/mhr_head.obj", "others/mhr/subject0_head.obj", "others/mhr/subject1_head.obj"),
    *("others/mhr/subject3_head.obj", "others/menpo_james/james.obj"),
)
#: Steps per frame of the reference, and frames of Blender's solvers.
SUBSTEPS, BLENDER_FRAMES = 8, 6
WORDS = ("joy", "anger", "surprise", "sadness")


def film() -> list[api.Cue]:
    """Ten seconds of four emotions, each before the last has gone: how long it takes."""
    return [
        api.Cue(api.expression(word), start=0.1 + 2.3 * number, onset=0.6, apex=1.4, offset=1.0)
        for number, word in enumerate(WORDS)
    ]


def cues() -> list[api.Cue]:
    """The same in less than two seconds, which is harder to follow: how far it is off."""
    return [
        api.Cue(api.expression(word), start=0.1 + 0.35 * number, onset=0.3, apex=0.1, offset=0.3)
        for number, word in enumerate(WORDS)
    ]


def head(name: str) -> api.Face:
    """A head by its name."""
    return api.Face.from_arrays(*mesh_of(name))


def mesh_of(name: str) -> tuple[Any, Any, Any]:
    """Vertices, polygons and feature points of a head by its name."""
    if name == "default":
        made = api.build_default_head()
        return made.vertices, made.polygons, made.points
    path = shared_folder() / "heads" / name
    mesh, beside = api.read_mesh(path), path.with_suffix(".fp.json")
    points = api.read_point_file(beside) if beside.is_file() else None
    if points is None:
        points = run(api.find_points_steps(mesh.vertices, mesh.polygons)).positions
    return mesh.vertices, mesh.polygons, points


def positions(face: api.Face, **options: Any) -> Any:
    """(T, V, 3) of the motion."""
    return np.array([np.asarray(frame) for frame in face.performance(cues(), FPS, **options)])


def error(face: api.Face) -> dict[str, float]:
    """How far the motion is from the reference, as shares of the largest motion: at worst, and in the mean square."""
    shown = positions(face)
    reference = positions(face, integrator="implicit", substeps=SUBSTEPS)
    largest = float(np.linalg.norm(reference - face.vertices, axis=2).max())
    apart = np.linalg.norm(shown - reference, axis=2)
    worst_frame = float(np.sqrt((apart**2).mean(axis=1)).max())
    return {"worst": float(apart.max()) / largest, "rms": worst_frame / largest}


def traffic(face: api.Face, frames: int, keys: int) -> dict[str, float]:
    """Bytes that a frame must move through memory at least: what it is made of is read once, what it is is written."""
    count = len(face.vertices)
    carried = 12.0 * face.anatomy.carry.nnz
    own = 24.0 * (2 * count + face.anatomy.skin.vertex_count)
    packed = 12.0 * count * (1.0 + keys / frames)
    return {"live preview": carried + own, "motion, each frame": carried + own, "compress": packed}


def measured(name: str) -> dict[str, Any]:
    """All of one head."""
    face, watch = head(name), Watch()
    watch.run("prepare", face.prepare())
    joy = api.expression("joy")
    watch.run("first pose", done(lambda: face.pose(joy.frame(), emotion=joy.weights)))
    watch.run("live preview", previews(face, PREVIEWS), PREVIEWS)
    frames, count = face.performance(film(), FPS), len(api.sequence(film(), fps=FPS))
    watch.run("motion, once", frames.prepare())
    tolerance = TOLERANCE * face.scale
    gathered = gathering(len(face.vertices), tolerance=tolerance)
    watch.run("motion, each frame", gather(face, frames, gathered), count)
    packed = watch.run("compress", squeeze(gathered, tolerance=tolerance), count)
    phases = {key: asdict(phase) for key, phase in watch.phases.items()}
    frame = phases["motion, once"]["seconds"] / count + phases["motion, each frame"]["seconds"]
    return {
        "head": name.rpartition("/")[2] if not name.startswith("others") else "/".join(name.split("/")[1:]),
        "vertices": len(face.vertices),
        "solved": face.anatomy.skin.vertex_count,
        "frames": count,
        "shape_keys": len(packed.shapes),
        "seconds_per_frame": frame,
        "phases": phases,
        "bytes": traffic(face, count, len(packed.shapes)),
        "bandwidth": bandwidth(),
        "blender": beside(face),
        "error": error(face),
    }


def beside(face: api.Face) -> dict[str, Any]:
    """Processor seconds of a frame of Blender's own solvers on the skin of a face, or why there are none."""
    try:
        import bpy
    except ImportError:
        return {}
    skin = face.anatomy.given_skin
    skin_count = len(skin.positions)
    sides = [list(map(int, polygon)) for polygon in skin.polygons]
    found: dict[str, Any] = {"version": bpy.app.version_string, "vertices": skin_count}
    for kind, title in (("CLOTH", "cloth"), ("SOFT_BODY", "soft body")):
        found[title] = blender_frame(kind, skin.positions, sides, BLENDER_FRAMES)
    found["XPBD cloth"] = xpbd_frame(skin.positions, sides, BLENDER_FRAMES)
    return found


def tell(row: dict[str, Any]) -> None:
    """Print one head."""
    print(f"{row['head']}: {row['vertices']} vertices, {row['solved']} solved, {row['shape_keys']} shape keys")
    for name, phase in row["phases"].items():
        print(f"  {name:<20}{phase['seconds'] * 1e3:10.1f} ms")
    for name, seconds in row["blender"].items():
        if isinstance(seconds, float):
            longer = seconds / row["seconds_per_frame"]
            print(f"  {name}: {seconds * 1e3:.1f} ms, {longer:.1f} times as long as a frame")
    print(f"  off by {row['error']['worst']:.2%} at worst, {row['error']['rms']:.2%} rms", flush=True)


def rows_of(names: list[str]) -> Iterator[dict[str, Any]]:
    """Figures of heads, each measured in a process of its own; a head without a face is told and left out."""
    for name in names:
        if name != "default" and not (shared_folder() / "heads" / name).is_file():
            continue
        command = [sys.executable, sys.argv[0], "motion", "--head", name, "--json"]
        made = subprocess.run(command, stdout=subprocess.PIPE, text=True)
        if made.returncode:
            print(f"{name}: not measured")
            continue
        row = json.loads(made.stdout.splitlines()[-1])
        tell(row)
        yield row


def main(argv: list[str]) -> None:
    """Measure every head, and write the figures."""
    parser = argparse.ArgumentParser(prog="bench_speed.py motion", description=__doc__)
    parser.add_argument("--head", action="append", choices=HEADS, help="these heads only")
    parser.add_argument("--json", action="store_true", help="of one head: in this process, as JSON")
    parser.add_argument("--out", type=Path, default=OUT / "bench")
    parser.add_argument("--name", default="motion.json", help="of the file; xpbd.json in a Blender that has that node")
    arguments = parser.parse_args(argv)
    names = arguments.head or list(HEADS)
    if arguments.json:
        print(json.dumps(measured(names[0])))
        return
    rows = list(rows_of(names))
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / arguments.name).write_text(json.dumps({"heads": rows}, indent=1))
