"""Speed of the live preview as a slider is dragged, beside Blender's own cloth and soft body on the same head.

Without --mesh it takes the default head, and the shared ict head where there is one. One update is everything from the
changed choice to the mesh that Blender draws: is it the same face, plan, sketch, write, evaluate. Processor time,
medians and 95 % of a drag.
Needs a Python that has bpy.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import risorius.api as api
from places import OUT, shared_folder
from risorius.progress import run
from risorius.scene import mesh as meshes
from risorius.scene.bake.target import Target
from risorius.scene.jobs.inputs import Input
from risorius.scene.jobs.subjects import subject
from risorius.scene.live.held_faces import REST
from risorius.scene.live.live_face import LiveFace

from .solvers import blender_frame

#: Drags: from weak to strong, round the wheel, and of one muscle of a smile.
WORD, ANGLES, MUSCLE = "surprise", (70.3, 256.7), "depressor_anguli_oris_l"


def choices() -> dict[str, Callable[[float], tuple[api.Profile, dict[str, float]]]]:
    """What is chosen, with contractions set by hand, at a share 0..1 of each drag."""
    first, last = ANGLES
    return {
        "word": lambda share: (api.expression(WORD, activation=1.0 + 6.0 * share), {}),
        "wheel": lambda share: (api.expression(angle=first + share * (last - first), activation=5.0), {}),
        "muscle": lambda share: (api.expression("joy"), {MUSCLE: share}),
    }


def drag(face: LiveFace, target: Target, kind: str, steps: int) -> list[float]:
    """Processor seconds of each update of a drag."""
    times, chosen = [], choices()[kind]
    for share in np.linspace(0.0, 1.0, steps).tolist():
        begin = time.process_time()
        profile, by_hand = chosen(share)
        if not face.is_of(target, since=REST):
            raise SystemExit("the face has changed")
        asked = profile.frame(), profile.weights, by_hand
        pose = face.pose(asked[0], drive="natural", emotion=asked[1], contractions=asked[2], passing=True)
        face.show(target, pose.displacement)
        bpy.context.view_layer.update()
        times.append(time.process_time() - begin)
    return times


def measure(name: str, mesh: Path | None, points: Path | None, steps: int) -> dict[str, Any]:
    """Print and return the times of one head."""
    target = run(subject(Input(mesh, points))).target
    begin = time.perf_counter()
    face = LiveFace(target)
    run(face.prepare())
    ready = time.perf_counter() - begin
    begin = time.perf_counter()
    while face.has_more:  # what a window does while the user looks at the first expression
        face.go_on()
    more = time.perf_counter() - begin
    every = {kind: np.array(drag(face, target, kind, steps)) * 1e3 for kind in choices()}
    drags = {kind: {"median": float(np.median(t)), "most": float(np.percentile(t, 95))} for kind, t in every.items()}
    times = np.concatenate(list(every.values()))
    count = len(target.obj.data.vertices)
    print(f"{name}: {count} vertices, ready in {ready:.1f} s, explored in {more:.1f} s more")
    for kind, found in drags.items():
        print(f"  {kind:<16}{found['median']:7.1f} ms median, {found['most']:.1f} ms at 95 %")
    vertices, (corners, sizes) = meshes.rest_vertices(target.obj.data), meshes.polygon_arrays(target.obj.data)
    polygons = meshes.polygon_sequence(corners, sizes)
    for kind, title in (("CLOTH", "cloth"), ("SOFT_BODY", "soft body")):
        seconds = blender_frame(kind, vertices, polygons, 10) * 1e3
        ratio = seconds / np.median(times)
        print(f"  Blender's {title:<10}{seconds:7.1f} ms per frame, {ratio:.1f} updates", flush=True)
    return {"head": name, "vertices": count, "steps": steps, "drags": drags}


def main(argv: list[str]) -> None:
    """Measure."""
    parser = argparse.ArgumentParser(prog="bench_speed.py preview", description=__doc__)
    parser.add_argument("--mesh", type=Path, help="an npz file of a head")
    parser.add_argument("--points", type=Path, help="its feature points, JSON")
    parser.add_argument("--steps", type=int, default=40, help="updates per drag")
    parser.add_argument("--out", type=Path, default=OUT / "bench")
    arguments = parser.parse_args(argv)
    shared = shared_folder() / "heads"
    heads: list[tuple[str, Any, Any]] = [("default", None, None)]
    if arguments.mesh is not None:
        heads = [(arguments.mesh.stem, arguments.mesh, arguments.points)]
    elif (shared / "ict.npz").is_file():
        heads.append(("ict", shared / "ict.npz", shared / "ict.fp.json"))
    print(f"Blender {bpy.app.version_string}")
    rows = [measure(*head, arguments.steps) for head in heads]
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "preview.json").write_text(json.dumps(rows, indent=1))
