"""Verbs that need Blender: bake, render, demo."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

from ..errors import RisoriusError
from .options import Verbs, add_creases, add_engine, add_scene, add_words, scene_options, verb
from .progress import ShowProgress
from .result import Result

NEEDS_BLENDER = (
    "this command needs Blender: run it as `blender --command risorius ...`, or `pip install bpy` into this Python"
)


def add_film_verbs(verbs: Verbs) -> None:
    """Add bake, render and demo to the verbs."""
    bake = verb(verbs, "bake", _bake)
    add_words(bake)
    add_scene(bake)
    _add_rate(bake)
    add_creases(bake)
    bake.add_argument("--dynamic", action="store_true", help="simulate the motion instead of posing the apex")
    bake.add_argument("--out", type=Path, required=True, help="the .blend file to write")

    render = verb(verbs, "render", _render)
    add_words(render)
    add_scene(render)
    _add_rate(render)
    add_engine(render)
    add_creases(render)
    render.add_argument("--out", type=Path, required=True, help="the .mp4 file to write")

    demo = verb(verbs, "demo", _demo)
    add_words(demo, nargs="*")
    add_scene(demo)
    _add_rate(demo)
    add_engine(demo)
    add_creases(demo)
    demo.add_argument("--out", type=Path, default=Path("out"), help="the output folder (default: out)")


def _add_rate(parser: argparse.ArgumentParser) -> None:
    """How fast the scene plays."""
    parser.add_argument("--fps", type=float, help="frames per second (default: those of a .blend, else 25)")


def _bake(arguments: argparse.Namespace) -> Result:
    """Bake expressions onto a face and save a .blend file."""
    return _made("bake_file", arguments, dynamic=arguments.dynamic)


def _render(arguments: argparse.Namespace) -> Result:
    """Render expressions as a video."""
    return _made("render_film", arguments, engine=arguments.engine)


def _demo(arguments: argparse.Namespace) -> Result:
    """Make a video, a .blend file and a contact sheet of the six emotions."""
    return _made("demo", arguments, engine=arguments.engine)


def _jobs() -> ModuleType:
    """The jobs that need Blender; imported only here."""
    try:
        from ..scene.jobs import words
    except ModuleNotFoundError as missing:
        if missing.name in ("bpy", "mathutils"):
            raise RisoriusError(NEEDS_BLENDER) from None
        raise
    return words


def _job_options(arguments: argparse.Namespace) -> dict[str, Any]:
    """The options that all jobs share."""
    shared = {**scene_options(arguments), "fps": arguments.fps, "creases": arguments.creases}
    words = {"words": tuple(arguments.words)} if arguments.words else {}
    return {**shared, **words, "progress": ShowProgress()}


@contextlib.contextmanager
def silent_blender() -> Iterator[None]:
    """Keep what Blender prints for every frame it saves off standard output, at the level where it writes."""
    sys.stdout.flush()
    kept = os.dup(1)
    try:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), 1)
        yield
    finally:
        sys.stdout.flush()
        os.dup2(kept, 1)
        os.close(kept)


def _made(job: str, arguments: argparse.Namespace, **options: object) -> Result:
    """Run a job, and name the files that it has written."""
    run = getattr(_jobs(), job)
    with silent_blender():
        made = dict(run(arguments.out, **_job_options(arguments), **options))
    return Result(made, lines_of(made))


def lines_of(made: Mapping[str, Any]) -> list[str]:
    """What a job has made, a line each; every remark has a line of its own."""
    lines = [f"{key}: {value}" for key, value in made.items() if key != "remarks"]
    return lines + [f"note: {remark}" for remark in made.get("remarks", ())]
