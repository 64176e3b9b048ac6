"""Speed of the live preview as a slider is dragged, beside Blender's own cloth and soft body on the same head.

Without --mesh it takes the default head, and the shared ict head where there is one. One update is everything from the
changed choice to the mesh that Blender draws: plan, sketch, write, evaluate. Processor time, medians and 95 % of a
drag.
Needs a Python that has bpy.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import risorius.api as api
from places import shared_folder
from risorius.progress import run
from risorius.scene import mesh as meshes
from risorius.scene.bake.target import Target
from risorius.scene.jobs.inputs import Input
from risorius.scene.jobs.subjects import subject
from risorius.scene.live.live_face import LiveFace

from .solvers import blender_frame

#: Drags: from weak to strong, and round the wheel.
WORD, ANGLES = "surprise", (70.3, 256.7)


def drag(face: LiveFace, target: Target, steps: int) -> list[float]:
    """Processor seconds of each update of two drags."""
    profiles = [api.expression(WORD, activation=float(level)) for level in np.linspace(1.0, 7.0, steps)]
    profiles += [api.expression(angle=float(angle), activation=5.0) for angle in np.linspace(*ANGLES, steps)]
    times = []
    for profile in profiles:
        begin = time.process_time()
        pose = face.pose(profile.frame(), drive="natural", emotion=profile.weights)
        face.show(target, pose.displacement)
        bpy.context.view_layer.update()
        times.append(time.process_time() - begin)
    return times


def measure(name: str, mesh: Path | None, points: Path | None, steps: int) -> None:
    """Print the times of one head."""
    target = run(subject(Input(mesh, points))).target
    begin = time.perf_counter()
    face = LiveFace(target)
    run(face.prepare())
    ready = time.perf_counter() - begin
    begin = time.perf_counter()
    while face.has_more:  # what a window does while the user looks at the first expression
        face.go_on()
    more = time.perf_counter() - begin
    times = np.array(drag(face, target, steps)) * 1e3
    count = len(target.obj.data.vertices)
    print(f"{name}: {count} vertices, ready in {ready:.1f} s, explored in {more:.1f} s more")
    print(f"  update          {np.median(times):7.1f} ms median, {np.percentile(times, 95):.1f} ms at 95 %")
    vertices, (corners, sizes) = meshes.rest_vertices(target.obj.data), meshes.polygon_arrays(target.obj.data)
    polygons = meshes.polygon_sequence(corners, sizes)
    for kind, title in (("CLOTH", "cloth"), ("SOFT_BODY", "soft body")):
        seconds = blender_frame(kind, vertices, polygons, 10) * 1e3
        ratio = seconds / np.median(times)
        print(f"  Blender's {title:<10}{seconds:7.1f} ms per frame, {ratio:.1f} updates", flush=True)


def main(argv: list[str]) -> None:
    """Measure."""
    parser = argparse.ArgumentParser(prog="bench_speed.py preview", description=__doc__)
    parser.add_argument("--mesh", type=Path, help="an npz file of a head")
    parser.add_argument("--points", type=Path, help="its feature points, JSON")
    parser.add_argument("--steps", type=int, default=40, help="updates per drag")
    arguments = parser.parse_args(argv)
    shared = shared_folder() / "heads"
    heads: list[tuple[str, Any, Any]] = [("default head", None, None)]
    if arguments.mesh is not None:
        heads = [(arguments.mesh.stem, arguments.mesh, arguments.points)]
    elif (shared / "ict.npz").is_file():
        heads.append(("ict", shared / "ict.npz", shared / "ict.fp.json"))
    print(f"Blender {bpy.app.version_string}")
    for head in heads:
        measure(*head, arguments.steps)
