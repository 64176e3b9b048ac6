"""Whole jobs for the command line: from words to a .blend, a film, a contact sheet.

A job starts from an empty file, so it refuses to run in a Blender with a window, where it would throw away what is
open.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

from ...arrays import Floats
from ...errors import ParameterError, SceneError
from ..bake import baking as bake
from ..bake.motion import CueMotion
from ..bake.performance import ARCHETYPES, FIRST_FRAME, PAUSE, cues_of, line_up, pose_all
from ..faces import face_of, read_face
from ..mesh import key_vertices
from ..pictures import film
from ..pictures.contact_sheet import Exhibit, exhibit_values, write_sheet
from ..pictures.framing import framing_of
from ..pictures.studio import Engine, Look, furnish, render_frame, studio
from ..progress import Progress, Work, part_of, run
from .subjects import subject

if TYPE_CHECKING:
    from ...api import Cue

#: Pixels of a picture on the contact sheet.
SHEET_SIZE = 640
Report = Callable[[Progress], None]


@dataclass(frozen=True)
class Made:
    """What a job has written; ``dict(made)`` names it all."""

    blend: Path | None = None
    film: Path | None = None
    sheet: Path | None = None
    frames: int = 0
    shape_keys: int = 0
    error_mm: float = 0.0
    remarks: tuple[str, ...] = ()

    def __iter__(self) -> Iterator[tuple[str, Any]]:
        """Name and value of everything there is."""
        for field in fields(self):
            value = getattr(self, field.name)
            if value not in (None, ()):
                yield field.name, value


DemoResult = Made


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
    return run(_bake_file(Path(out), mesh, points, words, fps, dynamic, creases), progress)


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
    return run(_render_film(Path(out), mesh, points, words, look, fps, creases), progress)


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
    return run(_demo(Path(out_dir), mesh, points, words, Look(engine=_engine(engine)), fps, creases), progress)


def _engine(name: str) -> Engine:
    """The engine of that name."""
    try:
        return Engine(name.upper())
    except ValueError:
        raise ParameterError("engine", f"must be one of {', '.join(Engine)}", name) from None


def empty_file(fps: float) -> None:
    """An empty file with this frame rate."""
    if not bpy.app.background:
        remedy = "run it from the command line (blender --command risorius)"
        raise SceneError("This job", f"starts from an empty file: {remedy}")
    if not (np.isfinite(fps) and 1.0 <= fps <= 240.0):
        raise ParameterError("fps", "must be between 1 and 240", fps)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    render = bpy.context.scene.render
    render.fps = max(1, round(fps))
    render.fps_base = render.fps / fps


def _move(obj: Any, words: Sequence[str], fps: float, creases: bool | None) -> Work[tuple[list[Cue], bake.BakeResult]]:
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
    out: Path, mesh: Any, points: Any, words: Sequence[str], fps: float, dynamic: bool, creases: bool | None = None
) -> Work[Made]:
    """See `bake_file`."""
    film.refuse_unwritable_output(out)
    cues = cues_of(words)
    empty_file(fps)
    yield Progress(0.0, "Loading the face")
    obj = subject(mesh, points, creases=bool(creases))
    if dynamic:
        _, moved = yield from part_of(_move(obj, words, fps, creases), 0.05, 0.95)
        results = [moved]
    else:
        target = bake.Target(obj)
        results = yield from part_of(pose_all(target, cues, fps, creases), 0.05, 0.95)
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = FIRST_FRAME, line_up(target, results)
    furnish(bpy.context.scene, framing_of(obj), Look())
    save(out)
    keys = sum(len(result.keys) for result in results)
    error = max(result.error for result in results)
    return Made(blend=out, shape_keys=keys, error_mm=round(error * 1000.0, 4), remarks=results[-1].remarks)


def _render_film(
    out: Path, mesh: Any, points: Any, words: Sequence[str], look: Look, fps: float, creases: bool | None = None
) -> Work[Made]:
    """See `render_film`."""
    film.refuse_unwritable_output(out)
    cues_of(words)
    empty_file(fps)
    yield Progress(0.0, "Loading the face")
    obj = subject(mesh, points, creases=bool(creases))
    _, moved = yield from part_of(_move(obj, words, fps, creases), 0.02, 0.4)
    scene = bpy.context.scene
    work = film.render_film([obj], out, start=scene.frame_start, end=scene.frame_end, look=look)
    rendered = yield from part_of(work, 0.4, 1.0)
    return Made(film=rendered.path, frames=rendered.frame_count, remarks=moved.remarks + rendered.remarks)


def _demo(
    out: Path, mesh: Any, points: Any, words: Sequence[str], look: Look, fps: float, creases: bool | None = None
) -> Work[Made]:
    """See `demo`."""
    blend, movie, sheet = (out / f"risorius.{suffix}" for suffix in ("blend", "mp4", "png"))
    for path in (blend, movie, sheet):
        film.refuse_unwritable_output(path)
    cues_of(words)
    empty_file(fps)
    yield Progress(0.0, "Loading the face")
    obj = subject(mesh, points, creases=bool(creases))
    cues, moved = yield from part_of(_move(obj, words, fps, creases), 0.02, 0.35)
    scene = bpy.context.scene
    work = film.render_film([obj], movie, start=scene.frame_start, end=scene.frame_end, look=look)
    rendered = yield from part_of(work, 0.35, 0.9)
    yield Progress(0.91, "Composing the contact sheet")
    _write_sheet(obj, cues, fps, replace(look, width=SHEET_SIZE, height=SHEET_SIZE, fine=True), sheet)
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


def apex_frame(cue: Cue, fps: float) -> int:
    """The frame at the end of a cue's apex, when the face has settled."""
    return FIRST_FRAME + int(np.floor((cue.start + cue.onset + cue.apex) * fps))


def _write_sheet(obj: Any, cues: Sequence[Cue], fps: float, look: Look, path: Path) -> None:
    """Picture each cue's apex, with what was asked against what the baked face shows."""
    with tempfile.TemporaryDirectory(prefix="risorius-") as name:
        with studio([obj], framing_of(obj), look) as scene:
            pictures = [render_frame(scene, apex_frame(cue, fps), Path(name)) for cue in cues]
        write_sheet(_exhibits(obj, cues, fps, pictures), path)


def _exhibits(obj: Any, cues: Sequence[Cue], fps: float, pictures: Sequence[Path]) -> list[Exhibit]:
    """The pictured apexes with their values."""
    from ... import api

    source = read_face(obj)
    face = face_of(source)
    labels = [f"F{fap.number} {fap.name}" for fap in api.FAPS.values()]
    exhibits = []
    for cue, picture in zip(cues, pictures, strict=True):
        moved = _played(obj, source.pieces[0].to_metres[:3, :3], apex_frame(cue, fps))
        values = exhibit_values(labels, cue.profile.frame(), face.measure(source.vertices + moved))
        caption = f"activation {cue.profile.activation:.1f}"
        exhibits.append(Exhibit(str(cue.profile.word), caption, picture, values))
    return exhibits


def _played(obj: Any, to_metres: Floats, frame: int) -> Floats:
    """(V, 3) displacement that the shape keys make at a frame, metres."""
    bpy.context.scene.frame_set(frame)
    blocks = obj.data.shape_keys.key_blocks
    basis = key_vertices(blocks[0])
    moved = sum((block.value * (key_vertices(block) - basis) for block in blocks[1:]), np.zeros_like(basis))
    displacement: Floats = moved @ to_metres.T
    return displacement


def save(path: Path) -> None:
    """Save the open file.

    Raises
    ------
    SceneError : it could not be written.
    """
    bpy.context.scene.frame_set(bpy.context.scene.frame_start)
    try:
        bpy.ops.wm.save_as_mainfile(filepath=str(path.resolve()), compress=True, check_existing=False)
    except RuntimeError as problem:
        raise SceneError(str(path), f"could not be saved ({problem}): choose another folder") from problem
