"""Verbs that need Blender: bake, render, demo."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import RisoriusError
from .kept import kept_by_jobs
from .options import (
    Verbs,
    add_creases,
    add_engine,
    add_film,
    add_onto,
    add_scene,
    add_timing,
    add_words,
    onto_options,
    refuse_ending,
    scene_options,
    timing_options,
    verb,
)
from .progress import ShowProgress
from .result import Result, UsageError

if TYPE_CHECKING:
    from ..scene.jobs.destination import Destination
    from ..scene.jobs.labelling import Labels

NEEDS_BLENDER = (
    "this command needs Blender: run it as `blender --command risorius ...`, or `pip install bpy` into this Python"
)


def add_film_verbs(verbs: Verbs) -> None:
    """Add bake, render and demo to the verbs."""
    bake = verb(verbs, "bake", _bake)
    add_words(bake)
    add_timing(bake)
    add_scene(bake)
    add_onto(bake)
    _add_rate(bake)
    add_creases(bake)
    bake.add_argument("--dynamic", action="store_true", help="simulate the motion instead of posing the apex")
    bake.add_argument("--out", type=Path, required=True, help="the .blend file to write")

    render = verb(verbs, "render", _render)
    add_words(render)
    add_timing(render)
    add_film(render)
    _add_rate(render)
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
    refuse_ending(arguments.out, ".blend")
    onto = onto_options(arguments, moves=arguments.dynamic)
    return _made("bake_file", arguments, onto, **timing_options(arguments), dynamic=arguments.dynamic)


def _render(arguments: argparse.Namespace) -> Result:
    """Render expressions as a video."""
    refuse_ending(arguments.out, ".mp4")
    onto = onto_options(arguments)
    labels = labels_of(arguments)
    return _made("render_film", arguments, onto, **timing_options(arguments), engine=arguments.engine, labels=labels)


def _demo(arguments: argparse.Namespace) -> Result:
    """Make a video, a .blend file and a contact sheet of the six emotions."""
    return _made("demo", arguments, engine=arguments.engine)


@contextlib.contextmanager
def needing_blender() -> Iterator[None]:
    """Around imports of jobs: say what to do where there is no Blender around.

    Raises
    ------
    RisoriusError : there is none.
    """
    try:
        yield
    except ModuleNotFoundError as missing:
        if missing.name in ("bpy", "mathutils"):
            raise RisoriusError(NEEDS_BLENDER) from None
        raise


def destination_of(onto: Mapping[str, Any]) -> Destination:
    """Where a bake goes, from `onto_options`."""
    with needing_blender():
        from ..scene.jobs.destination import Destination
    return Destination.of(**onto)


def labels_of(arguments: argparse.Namespace, out: Path | None = None) -> Labels | None:
    """The labels of `add_labels` beside a video `out`; None where none are wanted."""
    out = arguments.out if out is None else out
    if arguments.labels is None:
        for name in ("label_images", "licence"):
            if getattr(arguments, name):
                raise UsageError(f"--{name.replace('_', '-')} needs --labels")
        return None
    if out.suffix.lower() != ".mp4":
        raise UsageError("--labels needs a video (.mp4): labels tell what its frames show")
    with needing_blender():
        from ..scene.jobs.labelling import Labels
    return Labels(arguments.labels, arguments.label_images, arguments.licence)


def _job_options(arguments: argparse.Namespace) -> dict[str, Any]:
    """The options that all jobs share."""
    shared = {**scene_options(arguments), "fps": arguments.fps, "creases": arguments.creases}
    words = {"words": tuple(arguments.words)} if arguments.words else {}
    return {**shared, **words, "progress": ShowProgress()}


@contextlib.contextmanager
def in_blender() -> Iterator[None]:
    """Around a job: standard output is for its result alone, and the faces that it prepares are kept."""
    with silent_blender(), kept_by_jobs():
        yield


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


def _made(job: str, arguments: argparse.Namespace, onto: Mapping[str, Any] | None = None, **options: object) -> Result:
    """Run a job, and name the files that it has written."""
    with needing_blender():
        from ..scene.jobs import words
    run = getattr(words, job)
    if onto is not None:
        options["destination"] = destination_of(onto)
    with in_blender():
        made = dict(run(arguments.out, **_job_options(arguments), **options))
    return Result(made, lines_of(made))


def lines_of(made: Mapping[str, Any]) -> list[str]:
    """What a job has made, a line each; every clip on a rig and every remark has a line of its own."""
    lines = [f"{key}: {value}" for key, value in made.items() if key not in ("clips", "remarks")]
    lines += [_clip_line(clip) for clip in made.get("clips", ())]
    return lines + [f"note: {remark}" for remark in made.get("remarks", ())]


def _clip_line(clip: Mapping[str, Any]) -> str:
    """A clip on a rig: when it plays, and how much it moves."""
    first, last = clip["frames"]
    return f"clip: {clip['clip']}, frames {first:.0f} to {last:.0f}, {len(clip['controls'])} controls"
