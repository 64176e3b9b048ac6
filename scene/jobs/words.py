"""Jobs from words: a .blend, a film, a contact sheet."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import bpy

from ...errors import ParameterError
from ...progress import Progress, Report, Work, part_of, run
from .. import bake
from ..bake.motion import CueMotion
from ..bake.performance import ARCHETYPES, FIRST_FRAME, PAUSE, cues_of, line_up, pose_all
from ..blender_types import Object
from ..pictures import film
from ..pictures.framing import framing_of
from ..pictures.furniture import furnish
from ..pictures.look import Engine, Look
from .files import Made, empty_file, save
from .sheet import write_apexes
from .subjects import subject

if TYPE_CHECKING:
    from ...api import Cue

#: Pixels of a picture on the contact sheet.
SHEET_SIZE = 640
#: Puts the face of a job into the file.
Load = Callable[[], Object]


def bake_file(
    out: str | Path,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    words: Sequence[str] = ARCHETYPES,
    fps: float = 25.0,
    dynamic: bool = False,
    creases: bool | None = None,
    progress: Report | None = None,
) -> Made:
    """Bake words onto a face and save the .blend.

    Parameters
    ----------
    out : the .blend to write.
    mesh, points : see `subjects.subject`.
    words : shown one after another.
    dynamic : simulate one motion through all words, instead of one shape key per word.
    creases : whether the skin wrinkles where it is squeezed; by default on the default head only. Cycles and EEVEE draw
        it, in the default head's material and those given to meshes that bring none.
    progress : called with each step.

    Raises
    ------
    RisoriusError : nothing has been written then.
    """
    load = partial(subject, mesh, points, creases=bool(creases))
    return run(_bake_file(Path(out), load, words, fps, dynamic, creases), progress)


def render_film(
    out: str | Path,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    words: Sequence[str] = ARCHETYPES,
    engine: str = "WORKBENCH",
    fps: float = 25.0,
    creases: bool | None = None,
    progress: Report | None = None,
) -> Made:
    """Simulate words on a face and write the film (.mp4). Parameters as in `bake_file` and `demo`."""
    look = Look(engine=_engine(engine))
    load = partial(subject, mesh, points, creases=bool(creases))
    return run(_render_film(Path(out), load, words, look, fps, creases), progress)


def demo(
    out_dir: str | Path,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    words: Sequence[str] = ARCHETYPES,
    engine: str = "WORKBENCH",
    fps: float = 25.0,
    creases: bool | None = None,
    progress: Report | None = None,
) -> Made:
    """One film of all words with onset, apex and offset, the .blend it is from, and a contact sheet of the apexes.

    Parameters
    ----------
    out_dir : folder for risorius.mp4, risorius.blend and risorius.png; made where missing.
    mesh, points : see `subjects.subject`.
    words : shown one after another.
    engine : "WORKBENCH", "EEVEE" or "CYCLES".
    fps : frames per second.
    creases : as for `bake_file`.
    progress : called with each step.

    Raises
    ------
    RisoriusError : names the file, the word, the point or the object, and the remedy.
    """
    load = partial(subject, mesh, points, creases=bool(creases))
    return run(_demo(Path(out_dir), load, words, Look(engine=_engine(engine)), fps, creases), progress)


def _engine(name: str) -> Engine:
    """The engine of that name."""
    try:
        return Engine(name.upper())
    except ValueError:
        raise ParameterError("engine", f"must be one of {', '.join(Engine)}", name) from None


def _begin(outputs: Sequence[Path], load: Load, words: Sequence[str], fps: float) -> Work[Object]:
    """Refuse what cannot be written or shown, then put the face into an empty file."""
    for path in outputs:
        film.refuse_unwritable_output(path)
    cues_of(words)
    empty_file(fps)
    yield Progress(0.0, "Loading the face")
    return load()


def _move(
    obj: Object, words: Sequence[str], fps: float, creases: bool | None
) -> Work[tuple[list[Cue], bake.BakeResult]]:
    """Simulate all words as one motion."""
    from ... import api

    cues = cues_of(words)
    end = max(cue.start + cue.duration for cue in cues)
    rest = api.Cue(api.expression("neutral"), start=end, onset=0.0, apex=PAUSE, offset=0.0)
    motion = CueMotion([*cues, rest])
    result = yield from bake.bake_motion(
        bake.Target(obj), motion, clip="performance", start=FIRST_FRAME, fps=fps, creases=creases
    )
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = (int(frame) for frame in result.frame_range)
    return cues, result


def _bake_file(
    out: Path, load: Load, words: Sequence[str], fps: float, dynamic: bool, creases: bool | None = None
) -> Work[Made]:
    """See `bake_file`."""
    obj = yield from _begin([out], load, words, fps)
    if dynamic:
        _, moved = yield from part_of(_move(obj, words, fps, creases), 0.05, 0.95)
        results = [moved]
    else:
        target = bake.Target(obj)
        results = yield from part_of(pose_all(target, cues_of(words), fps, creases), 0.05, 0.95)
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = FIRST_FRAME, line_up(target, results)
    furnish(bpy.context.scene, framing_of(obj), Look())
    save(out)
    keys = sum(len(result.keys) for result in results)
    error = max(result.error for result in results)
    return Made(blend=out, shape_keys=keys, error_mm=round(error * 1000.0, 4), remarks=results[-1].remarks)


def _render_film(
    out: Path, load: Load, words: Sequence[str], look: Look, fps: float, creases: bool | None = None
) -> Work[Made]:
    """See `render_film`."""
    obj = yield from _begin([out], load, words, fps)
    _, moved = yield from part_of(_move(obj, words, fps, creases), 0.02, 0.4)
    scene = bpy.context.scene
    work = film.render_film([obj], out, start=scene.frame_start, end=scene.frame_end, look=look)
    rendered = yield from part_of(work, 0.4, 1.0)
    return Made(film=rendered.path, frames=rendered.frame_count, remarks=moved.remarks + rendered.remarks)


def _demo(
    out: Path, load: Load, words: Sequence[str], look: Look, fps: float, creases: bool | None = None
) -> Work[Made]:
    """See `demo`."""
    blend, movie, sheet = (out / f"risorius.{suffix}" for suffix in ("blend", "mp4", "png"))
    obj = yield from _begin([blend, movie, sheet], load, words, fps)
    cues, moved = yield from part_of(_move(obj, words, fps, creases), 0.02, 0.35)
    scene = bpy.context.scene
    work = film.render_film([obj], movie, start=scene.frame_start, end=scene.frame_end, look=look)
    rendered = yield from part_of(work, 0.35, 0.9)
    yield Progress(0.91, "Composing the contact sheet")
    write_apexes(obj, cues, fps, replace(look, width=SHEET_SIZE, height=SHEET_SIZE, fine=True), sheet)
    yield Progress(0.99, "Saving the .blend")
    furnish(scene, framing_of(obj), look)
    save(blend)
    return Made(
        blend=blend,
        film=movie,
        sheet=sheet,
        frames=rendered.frame_count,
        shape_keys=len(moved.keys),
        error_mm=round(moved.error * 1000.0, 4),
        remarks=moved.remarks + rendered.remarks,
    )
