"""Time and memory of each phase as a head gets denser: 1,000 to 500,000 vertices, fitted as a power law.

The default head is thinned out (quadric error) or split (each polygon into quads about its middle) to every size; each
is measured in a process of its own. Processor time on one core; memory is the largest resident set of a phase. A step
is what runs between two moments at which a window could draw itself and see Esc.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import resource
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import risorius.api as api
from places import OUT
from risorius.physics.split import split

#: Vertices to which the default head is thinned out first (0: not at all), and how often it is split then.
SIZES = ((1000, 0), (3000, 0), (0, 0), (5208, 1), (0, 1), (5208, 2), (0, 2), (5208, 3))
#: Frames per second of the motion, and updates of the live preview.
FPS, PREVIEWS = 25.0, 5
#: So many sizes, the largest, tell how a phase grows.
LARGEST = 3
#: Which phases come once, and which for every frame.
ONCE = ("find the face", "read the mesh", "prepare", "first pose", "motion, once")
EACH = ("live preview", "motion, each frame", "compress")


@dataclass
class Phase:
    """What a phase took.

    Attributes
    ----------
    seconds : processor time, of one frame where it comes with each. memory : MB.
    longest, during : seconds of its longest step, and what was said meanwhile.
    """

    seconds: float
    longest: float
    during: str
    memory: float


class Watch:
    """Measures phases of work."""

    def __init__(self) -> None:
        self.phases: dict[str, Phase] = {}

    def run(self, name: str, work: Iterable[Any], frames: int = 1) -> Any:
        """Drive a work to its end; returns its result."""
        _forget_peak()
        begin = last = time.process_time()
        longest, text, steps = (0.0, ""), "", iter(work)
        while True:
            try:
                step = next(steps)
                ended = None
            except StopIteration as end:
                ended = end
            now = time.process_time()
            longest, last = max(longest, (now - last, text)), now
            if ended is not None:
                break
            text = getattr(step, "text", "")
        self.phases[name] = Phase((last - begin) / frames, *longest, _peak())
        return ended.value


def _forget_peak() -> None:
    """Let the kernel begin anew with the largest resident set, where it can (Linux)."""
    with contextlib.suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5")


def _peak() -> float:
    """Largest resident set since, MB."""
    status = Path("/proc/self/status")
    if status.is_file():
        (line,) = (line for line in status.read_text().splitlines() if line.startswith("VmHWM"))
        return float(line.split()[1]) / 1024.0
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def head_of(thinned: int, splits: int) -> tuple[Any, Any, dict[str, Any]]:
    """Vertices, polygons and feature points (as positions) of the default head at some size."""
    from fit.decimate import decimated
    from fit.heads import TrueHead

    made = api.build_default_head()
    points = {name: _place(made.vertices, source) for name, source in made.points.items()}
    head = TrueHead("default", made.vertices, made.polygons, points)
    if thinned:
        head = decimated(head, thinned)
    vertices, polygons = head.vertices, head.polygons
    for _ in range(splits):
        finer = split(polygons, len(vertices))
        vertices, polygons = np.asarray(finer.matrix @ vertices), finer.quads
    return vertices, polygons, points


def _place(vertices: Any, source: Any) -> Any:
    """(3,) where a feature point is that is given as a vertex or as a place."""
    return vertices[source] if isinstance(source, int | np.integer) else np.asarray(source, dtype=np.float64)


def cues() -> list[api.Cue]:
    """Joy, and surprise before it has gone."""
    return [
        api.Cue(api.expression("joy"), start=0.1, onset=0.4, apex=0.3, offset=0.5),
        api.Cue(api.expression("surprise"), start=0.8, onset=0.3, apex=0.3, offset=0.4),
    ]


def done(what: Any) -> Iterator[None]:
    """What is done in one go, as a work of one step; it returns what that does."""
    return what()
    yield


def previews(face: Any, count: int) -> Iterator[None]:
    """Updates of the live preview, from weak to strong."""
    sketcher = face.sketcher()
    for level in np.linspace(1.0, 7.0, count):
        profile = api.expression("joy", activation=float(level))
        sketcher.sketch(profile.frame(), emotion=profile.weights)
        yield


def gather(face: Any, frames: Iterable[Any], gathered: Any) -> Iterator[None]:
    """Simulate all frames of a motion, and gather them."""
    for positions in frames:
        gathered.add(positions - face.vertices)
        yield


def measured(thinned: int, splits: int) -> dict[str, Any]:
    """All phases of one size."""
    from risorius.scene.bake.compress import TOLERANCE, gathering, squeeze  # Blender's

    vertices, polygons, points = head_of(thinned, splits)
    watch = Watch()
    watch.run("find the face", api.find_points_steps(vertices, polygons))
    face = watch.run("read the mesh", api.Face.from_arrays_steps(vertices, polygons, points))
    watch.run("prepare", face.prepare())
    joy = api.expression("joy")
    watch.run("first pose", done(lambda: face.pose(joy.frame(), emotion=joy.weights)))
    watch.run("live preview", previews(face, PREVIEWS), PREVIEWS)
    frames = face.performance(cues(), FPS)
    count = len(api.sequence(cues(), fps=FPS))
    watch.run("motion, once", frames.prepare())
    gathered = gathering(len(vertices))
    watch.run("motion, each frame", gather(face, frames, gathered), count)
    packed = watch.run("compress", squeeze(gathered, tolerance=TOLERANCE), count)
    phases = {name: asdict(phase) for name, phase in watch.phases.items()}
    return {
        "vertices": len(vertices),
        "solved": face.anatomy.skin.vertex_count,
        "shape_keys": len(packed.shapes),
        "phases": phases,
    }


def thinning(splits: int = 1, words: Sequence[str] = ("joy", "surprise", "anger")) -> dict[str, Any]:
    """How far poses on a coarser skin are from those on all of it, as shares of the largest displacement.

    The default head, split, is posed both ways: its skin solved whole as it is, and thinned out as if it were denser.
    """
    from risorius.face import anatomy

    vertices, polygons, points = head_of(0, splits)
    usual, solved, poses = anatomy.MOST, [], []
    for most in (10**9, 1000):
        anatomy.MOST = most
        face = api.Face.from_arrays(vertices, polygons, points)
        profiles = [api.expression(word) for word in words]
        poses.append([face.pose(each.frame(), emotion=each.weights).positions for each in profiles])
        solved.append(face.anatomy.skin.vertex_count)
    anatomy.MOST = usual
    found: dict[str, Any] = {"vertices": len(vertices), "whole": solved[0], "coarse": solved[1], "words": {}}
    for word, whole, coarse in zip(words, *poses, strict=True):
        off = np.linalg.norm(coarse - whole, axis=1) / np.linalg.norm(whole - vertices, axis=1).max()
        rms = float(np.sqrt((off**2).mean()))
        found["words"][word] = {"worst": float(off.max()), "99 %": float(np.percentile(off, 99)), "rms": rms}
    return found


def exponent(sizes: Any, figures: Any) -> float:
    """Slope of a straight line through the logarithms: figures grow as sizes to this power."""
    return float(np.polyfit(np.log(sizes), np.log(np.maximum(figures, 1e-6)), 1)[0])


def fitted(rows: list[dict[str, Any]]) -> dict[str, dict[str, float]]:
    """Phase -> exponents of its time and its memory, over the largest sizes that were measured."""
    rows = rows[-LARGEST:]
    sizes = [row["vertices"] for row in rows]
    found = {}
    for name in rows[0]["phases"]:
        phases = [row["phases"][name] for row in rows]
        found[name] = {key: exponent(sizes, [phase[key] for phase in phases]) for key in ("seconds", "memory")}
    return found


def main(argv: list[str]) -> None:
    """Measure each size in a process of its own, and write the figures."""
    parser = argparse.ArgumentParser(prog="bench_speed.py growth", description=__doc__)
    parser.add_argument("--size", type=int, choices=range(len(SIZES)), help="one size only, as JSON")
    parser.add_argument("--most", type=int, default=len(SIZES), help="so many sizes, the smallest ones")
    parser.add_argument("--out", type=Path, default=OUT / "bench")
    arguments = parser.parse_args(argv)
    if arguments.size is not None:
        print(json.dumps(measured(*SIZES[arguments.size])))
        return
    rows = []
    for number in range(arguments.most):
        command = [sys.executable, sys.argv[0], "growth", "--size", str(number)]
        made = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
        rows.append(json.loads(made.stdout.splitlines()[-1]))
        tell(rows[-1])
    arguments.out.mkdir(parents=True, exist_ok=True)
    figures = {"sizes": rows, "exponents": fitted(rows), "thinning": thinning()}
    (arguments.out / "growth.json").write_text(json.dumps(figures, indent=1))
    for name, powers in fitted(rows).items():
        print(f"  {name:<20} time n^{powers['seconds']:.2f}, memory n^{powers['memory']:.2f}")


def tell(row: dict[str, Any]) -> None:
    """Print one size."""
    print(f"{row['vertices']} vertices, {row['solved']} solved, {row['shape_keys']} shape keys")
    for name, phase in row["phases"].items():
        times = f"{phase['seconds'] * 1e3:10.1f} ms, longest step {phase['longest'] * 1e3:7.0f} ms"
        print(f"  {name:<20}{times}, {phase['memory']:6.0f} MB", flush=True)
