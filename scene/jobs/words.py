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
from ..bake.performance import ARCHETYPES, PAUSE, cues_of, line_up, pose_all
from ..pictures import film
from ..pictures.look import Engine, Look
from .files import Made, save
from .inputs import Input
from .sheet import write_apexes
from .stage import cover, dress
from .subjects import Subject, subject

if TYPE_CHECKING:
    from ...api import Cue

#: Pixels of a picture on the contact sheet.
SHEET_SIZE = 640
#: Puts the face of a job into a file.
Load = Callable[[], Work[Subject]]


def bake_file(
    out: str | Path,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    object_name: str | None = None,
    words: Sequence[str] = ARCHETYPES,
    fps: float | None = None,
    dynamic: bool = False,
    creases: bool | None = None,
    progress: Report | None = None,
) -> Made:
    """Bake words onto a face and save the .blend.

    Parameters
    ----------
    out : the .blend to write.
    mesh, points, object_name, fps : see `inputs.Input`.
    words : shown one after another.
    dynamic : simulate one motion through all words, instead of one shape key per word.
    creases : whether the skin wrinkles where it is squeezed; by default on the default head only. Cycles and EEVEE draw
        it, in the default head's material and those given to meshes that bring none.
    progress : called with each step.

    Raises
    ------
    RisoriusError : nothing has been written then.
    """
    load = partial(subject, Input.of(mesh, points, object_name, fps), creases=bool(creases))
    return run(_bake_file(Path(out), load, words, dynamic, creases), progress)


def render_film(
    out: str | Path,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    object_name: str | None = None,
    words: Sequence[str] = ARCHETYPES,
    engine: str = "WORKBENCH",
    fps: float | None = None,
    creases: bool | None = None,
    progress: Report | None = None,
) -> Made:
    """Simulate words on a face and write the film (.mp4). Parameters as in `bake_file` and `demo`."""
    look = Look(engine=_engine(engine))
    load = partial(subject, Input.of(mesh, points, object_name, fps), creases=bool(creases))
    return run(_render_film(Path(out), load, words, look, creases), progress)


def demo(
    out_dir: str | Path,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    object_name: str | None = None,
    words: Sequence[str] = ARCHETYPES,
    engine: str = "WORKBENCH",
    fps: float | None = None,
    creases: bool | None = None,
    progress: Report | None = None,
) -> Made:
    """One film of all words with onset, apex and offset, the .blend it is from, and a contact sheet of the apexes.

    Parameters
    ----------
    out_dir : folder for risorius.mp4, risorius.blend and risorius.png; made where missing.
    mesh, points, object_name, fps : see `inputs.Input`.
    words : shown one after another.
    engine : "WORKBENCH", "EEVEE" or "CYCLES".
    creases : as for `bake_file`.
    progress : called with each step.

    Raises
    ------
    RisoriusError : names the file, the word, the point or the object, and the remedy.
    """
    load = partial(subject, Input.of(mesh, points, object_name, fps), creases=bool(creases))
    return run(_demo(Path(out_dir), load, words, Look(engine=_engine(engine)), creases), progress)


def _engine(name: str) -> Engine:
    """The engine of that name."""
    try:
        return Engine(name.upper())
    except ValueError:
        raise ParameterError("engine", f"must be one of {', '.join(Engine)}", name) from None


def _begin(outputs: Sequence[Path], load: Load, words: Sequence[str]) -> Work[Subject]:
    """Refuse what cannot be written or shown, then put the face into its file."""
    for path in outputs:
        film.refuse_unwritable_output(path)
    cues_of(words)
    return (yield from part_of(load(), 0.0, 0.05))


def _move(face: Subject, words: Sequence[str], creases: bool | None) -> Work[tuple[list[Cue], bake.BakeResult]]:
    """Simulate all words as one motion, from the scene's first frame on."""
    from ... import api

    cues = cues_of(words)
    end = max(cue.start + cue.duration for cue in cues)
    rest = api.Cue(api.expression("neutral"), start=end, onset=0.0, apex=PAUSE, offset=0.0)
    motion, start = CueMotion([*cues, rest]), bpy.context.scene.frame_start
    result = yield from bake.bake_motion(face.target, motion, clip="performance", start=start, creases=creases)
    return cues, result


def _bake_file(out: Path, load: Load, words: Sequence[str], dynamic: bool, creases: bool | None = None) -> Work[Made]:
    """See `bake_file`."""
    face = yield from _begin([out], load, words)
    if dynamic:
        _, moved = yield from part_of(_move(face, words, creases), 0.05, 0.95)
        results, last = [moved], moved.frame_range[1]
    else:
        cues, start = cues_of(words), bpy.context.scene.frame_start
        posing = pose_all(face.target, cues, bake.scene_fps(), creases, first_frame=start)
        results = yield from part_of(posing, 0.05, 0.95)
        last = line_up(face.target, results)
    said = cover(face, last)
    dress(face, Look())
    save(out)
    remarks = tuple(dict.fromkeys(remark for result in results for remark in result.remarks))
    return Made(
        blend=out,
        face=face.obj.name,
        shape_keys=sum(len(result.keys) for result in results),
        error_mm=round(max(result.error for result in results) * 1000.0, 4),
        remarks=face.remarks + remarks + said,
    )


def _render_film(out: Path, load: Load, words: Sequence[str], look: Look, creases: bool | None = None) -> Work[Made]:
    """See `render_film`."""
    face = yield from _begin([out], load, words)
    _, moved = yield from part_of(_move(face, words, creases), 0.05, 0.4)
    rendered = yield from part_of(filming(face, moved, out, look), 0.4, 1.0)
    remarks = face.remarks + moved.remarks + rendered.remarks
    return Made(film=rendered.path, face=face.obj.name, frames=rendered.frame_count, remarks=remarks)


def filming(face: Subject, moved: bake.BakeResult, out: Path, look: Look) -> Work[film.FilmResult]:
    """Film what was baked."""
    start, end = (int(frame) for frame in moved.frame_range)
    return film.render_film(face.shown(), out, start=start, end=end, look=look)


def _demo(out: Path, load: Load, words: Sequence[str], look: Look, creases: bool | None = None) -> Work[Made]:
    """See `demo`."""
    blend, movie, sheet = (out / f"risorius.{suffix}" for suffix in ("blend", "mp4", "png"))
    face = yield from _begin([blend, movie, sheet], load, words)
    cues, moved = yield from part_of(_move(face, words, creases), 0.05, 0.35)
    rendered = yield from part_of(filming(face, moved, movie, look), 0.35, 0.9)
    yield Progress(0.91, "Composing the contact sheet")
    write_apexes(face.shown(), cues, replace(look, width=SHEET_SIZE, height=SHEET_SIZE, fine=True), sheet)
    yield Progress(0.99, "Saving the .blend")
    said = cover(face, moved.frame_range[1])
    dress(face, look)
    save(blend)
    return Made(
        blend=blend,
        film=movie,
        sheet=sheet,
        face=face.obj.name,
        frames=rendered.frame_count,
        shape_keys=len(moved.keys),
        error_mm=round(moved.error * 1000.0, 4),
        remarks=face.remarks + moved.remarks + rendered.remarks + said,
    )
