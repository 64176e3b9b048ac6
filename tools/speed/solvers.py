"""Speed of the skin's solvers, beside Blender's own cloth and soft body on the same mesh where bpy is importable.

Without --mesh it takes the skin of the shared ict head, or a grid of that size where there is none. Everything is
measured in one run, on one core; times are medians.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from places import shared_folder
from risorius.physics import mesh
from risorius.physics.equilibrium import EquilibriumSolver
from risorius.physics.implicit import ImplicitSolver
from risorius.physics.skin import Skin, State
from risorius.physics.tissue import tissue

from .xpbd import PINS, frame_seconds, sheet

FPS = 25.0


def read_skin(path: Path) -> tuple[Any, list[list[int]]]:
    """Vertices and polygons of the skin (label 0) of a head stored as vertices, loops, face_sizes, labels."""
    data = np.load(path)
    starts = np.cumsum(data["face_sizes"]) - data["face_sizes"]
    polygons = [data["loops"][a : a + n] for a, n in zip(starts, data["face_sizes"], strict=True)]
    skin = data["labels"] == 0 if "labels" in data else np.ones(len(data["vertices"]), dtype=bool)
    number = np.cumsum(skin) - 1
    kept = [number[polygon].tolist() for polygon in polygons if skin[polygon].all()]
    return data["vertices"][skin].astype(np.float64), kept


def grid(side: int = 105, size: float = 0.3) -> tuple[Any, list[list[int]]]:
    """A bulging sheet of quads about as fine as a head."""
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, side + 1), np.linspace(-0.5, 0.5, side + 1))
    vertices = size * np.stack([x.ravel(), y.ravel(), 0.3 * np.cos(3 * x).ravel() * np.cos(3 * y).ravel()], axis=1)
    corner = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    return vertices, np.stack([corner, corner + 1, corner + side + 2, corner + side + 1], axis=1).tolist()


def pulls(vertices: Any, polygons: Any) -> Any:
    """Six pulls of 15 mm radius, as muscles would, in N; about 5 mm of motion."""
    rng, areas = np.random.default_rng(0), mesh.vertex_areas(vertices, polygons)
    load = np.zeros_like(vertices)
    for centre in vertices[rng.integers(len(vertices), size=6)]:
        window = np.exp(-((vertices - centre) ** 2).sum(axis=1) / 0.015**2)
        load += rng.normal(size=3) / np.sqrt(3) * (window * areas)[:, None]
    return load * tissue().anchor_per_area * 0.02


def timed(work: Callable[[], Any], repeat: int) -> float:
    """Median seconds of some calls."""
    times = []
    for _ in range(repeat):
        begin = time.perf_counter()
        work()
        times.append(time.perf_counter() - begin)
    return statistics.median(times)


def measure(name: str, vertices: Any, polygons: Any, bending: float | None, frames: int) -> float:
    """Print one tissue's times; seconds per implicit frame."""
    begin = time.perf_counter()
    skin = Skin.from_mesh(vertices, polygons, tissue(), bending=bending)
    built = time.perf_counter()
    rest, motion = EquilibriumSolver(skin, tolerance=1e-5), ImplicitSolver(skin, 1 / FPS)
    factored = (time.perf_counter() - built) / 2
    load = pulls(vertices, polygons)
    found = rest.solve(load)
    moved = np.linalg.norm(found.positions - vertices, axis=1).max()
    print(f"{name}: {len(vertices)} vertices, {len(skin.springs.i)} springs, at most {moved * 1e3:.1f} mm of motion")
    print(f"  assemble          {(built - begin) * 1e3:8.1f} ms")
    print(f"  factor            {factored * 1e3:8.1f} ms")
    print(f"  forces and energy {timed(lambda: skin.energy_and_force(found.positions), 20) * 1e3:8.2f} ms")
    equilibrium = timed(lambda: rest.solve(load), 3)
    print(f"  equilibrium       {equilibrium * 1e3:8.1f} ms  ({found.iterations} iterations, to 0.01 mm)")
    state, times, iterations = State.at_rest(vertices), [], []
    for frame in range(frames):
        rise = np.sin(np.pi * frame / frames) ** 2
        begin = time.perf_counter()
        state = motion.step(state, rise * load)
        times.append(time.perf_counter() - begin)
        iterations.append(0 if motion.last is None else motion.last.iterations)
    typical = statistics.median(times)
    print(f"  implicit frame    {typical * 1e3:8.1f} ms  ({statistics.mean(iterations):.1f} iterations)", flush=True)
    return typical


def blender_frame(kind: str, vertices: Any, polygons: Any, frames: int) -> float:
    """Processor seconds per frame of Blender's cloth or soft body with its default settings on the same mesh."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    thing = sheet(vertices, polygons)
    modifier = thing.modifiers.new("physics", kind)
    if kind == "CLOTH":
        modifier.settings.vertex_group_mass = PINS
    else:
        modifier.settings.vertex_group_goal = PINS
    return frame_seconds(thing, frames)


def main(argv: list[str]) -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="bench_speed.py solvers", description=__doc__)
    parser.add_argument("--mesh", help="an npz file of a head, or `grid`")
    parser.add_argument("--frames", type=int, default=50)
    arguments = parser.parse_args(argv)
    default = shared_folder() / "heads" / "ict.npz"
    path = arguments.mesh or (str(default) if default.is_file() else "grid")
    vertices, polygons = grid() if path == "grid" else read_skin(Path(path))
    print(f"mesh: {Path(path).name}")
    typical = measure("default tissue", vertices, polygons, None, arguments.frames)
    measure("bare membrane (the paper's skin)", vertices, polygons, 0.0, arguments.frames)
    try:
        import bpy
    except ImportError:
        print("Blender's cloth and soft body: not measured, bpy is not importable by this Python")
        return
    for kind, name in (("CLOTH", "cloth"), ("SOFT_BODY", "soft body")):
        seconds = blender_frame(kind, vertices, polygons, min(arguments.frames, 20))
        print(
            f"Blender {bpy.app.version_string} {name}: {seconds * 1e3:.1f} ms per frame, "
            f"{seconds / typical:.1f} times our implicit frame",
            flush=True,
        )
