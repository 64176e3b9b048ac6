"""The first pose of a head that was never seen before, and of one whose face is kept: processor time, cold.

Each is measured in a process of its own, in which nothing has been worked out before; what Python loads is not counted.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import risorius.api as api
from places import OUT

from .growth import Watch, done
from .motion import mesh_of

#: Which heads.
HEADS = ("default", "ict.npz")
#: How often a kept face is measured; the least is what it takes.
TRIES = 3


def shown(face: api.Face) -> Any:
    """A first pose."""
    joy = api.expression("joy")
    return face.pose(joy.frame(), emotion=joy.weights)


def of_new(name: str) -> dict[str, Any]:
    """Seconds of reading, preparing and posing a head, and its longest step."""
    vertices, polygons, points = mesh_of(name)
    watch = Watch()
    face = watch.run("read", api.Face.from_arrays_steps(vertices, polygons, points))
    watch.run("prepare", face.prepare())
    watch.run("pose", done(lambda: shown(face)))
    found: dict[str, Any] = {phase: each.seconds for phase, each in watch.phases.items()}
    return {"vertices": len(vertices), **found, "longest": max(each.longest for each in watch.phases.values())}


def of_kept(name: str, folder: Path) -> dict[str, float]:
    """Seconds of a head whose face is in a folder: from its mesh to what Blender shows first, and then to its pose."""
    vertices, polygons, points = mesh_of(name)
    begin = time.process_time()
    face = api.KeptFaces(folder).face(vertices, polygons, points)
    if not face.is_from_file:
        raise SystemExit(f"the face of {name} was not kept")
    done(lambda: face.prepare())
    read, joy = time.process_time(), api.expression("joy")
    face.sketcher().sketch(joy.frame(), emotion=joy.weights, passing=True)
    sketched = time.process_time()
    shown(face)
    posed = time.process_time()
    return {"kept_read": read - begin, "kept_sketch": sketched - read, "kept_pose": posed - sketched}


def measured(name: str) -> dict[str, Any]:
    """One head, new and kept."""
    with tempfile.TemporaryDirectory() as folder:
        kept = api.KeptFaces(Path(folder))
        kept.keep(kept.face(*mesh_of(name)))
        tries = [in_a_process(name, folder) for _ in range(TRIES)]
    return {"head": name, **in_a_process(name), **min(tries, key=lambda each: sum(each.values()))}


def in_a_process(name: str, folder: str = "") -> dict[str, Any]:
    """Figures of a head that is new to a process, or kept in a folder."""
    command = [sys.executable, sys.argv[0], "first", "--head", name, "--kept", folder]
    made = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
    found: dict[str, Any] = json.loads(made.stdout.splitlines()[-1])
    return found


def main(argv: list[str]) -> None:
    """Measure each head in processes of its own, and write the figures."""
    parser = argparse.ArgumentParser(prog="bench_speed.py first", description=__doc__)
    parser.add_argument("--head", help="one head only, as JSON")
    parser.add_argument("--kept", default="", help="a folder in which its face is kept; without it the head is new")
    parser.add_argument("--out", type=Path, default=OUT / "bench")
    arguments = parser.parse_args(argv)
    if arguments.head:
        kept = Path(arguments.kept) if arguments.kept else None
        print(json.dumps(of_new(arguments.head) if kept is None else of_kept(arguments.head, kept)))
        return
    rows = [measured(name) for name in HEADS]
    for row in rows:
        print(", ".join(f"{key} {value:.3f}" if isinstance(value, float) else f"{value}" for key, value in row.items()))
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "first.json").write_text(json.dumps(rows, indent=1))
