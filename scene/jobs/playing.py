"""Playing a FAP stream on a face: into a .blend, or as a film."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import bpy

from ...errors import ParameterError
from ...progress import Progress, Report, Work, part_of, run
from .. import bake
from ..bake.motion import FapMotion
from ..bake.performance import FIRST_FRAME
from ..pictures import film
from ..pictures.framing import framing_of
from ..pictures.furniture import furnish
from ..pictures.look import Engine, Look
from .files import Made, empty_file, save
from .subjects import subject

if TYPE_CHECKING:
    from ...api import FapStream

#: What a file's name must end in to be a .blend; anything else is a film.
BLEND = ".blend"


def play_stream(
    out: str | Path,
    stream: FapStream,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    engine: str = "WORKBENCH",
    creases: bool | None = None,
    progress: Report | None = None,
) -> Made:
    """Bake a stream onto a face with its muscles, at the stream's rate, and save the .blend or the film (.mp4).

    Visemes and expressions are expanded; FAPs that no frame states are left to anatomy. Fill the stream first
    (`FapStream.filled`) where it states FAPs now and then only. Other parameters as for `words.bake_file`.

    Raises
    ------
    RisoriusError : nothing has been written then.
    """
    if engine.upper() not in list(Engine):
        raise ParameterError("engine", f"must be one of {', '.join(Engine)}", engine)
    return run(_play(Path(out), stream, mesh, points, Engine(engine.upper()), creases), progress)


def _play(
    out: Path,
    stream: FapStream,
    mesh: str | Path | None,
    points: str | Path | None,
    engine: Engine,
    creases: bool | None,
) -> Work[Made]:
    """See `play_stream`."""
    film.refuse_unwritable_output(out)
    motion = FapMotion(stream.expanded())
    empty_file(stream.fps)
    yield Progress(0.0, "Loading the face")
    obj = subject(mesh, points, creases=bool(creases))
    saves = out.suffix.lower() == BLEND
    clip = stream.name.split("\\")[-1].strip() or "stream"
    work = bake.bake_motion(bake.Target(obj), motion, clip=clip, start=FIRST_FRAME, fps=stream.fps, creases=creases)
    moved = yield from part_of(work, 0.02, 0.95 if saves else 0.4)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = (int(frame) for frame in moved.frame_range)
    if saves:
        furnish(scene, framing_of(obj), Look(engine=engine))
        save(out)
        error = round(moved.error * 1000.0, 4)
        return Made(blend=out, shape_keys=len(moved.keys), error_mm=error, remarks=moved.remarks)
    look = Look(engine=engine)
    filming = film.render_film([obj], out, start=scene.frame_start, end=scene.frame_end, look=look)
    rendered = yield from part_of(filming, 0.4, 1.0)
    return Made(film=rendered.path, frames=rendered.frame_count, remarks=moved.remarks + rendered.remarks)
