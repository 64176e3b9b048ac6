"""Playing a FAP stream on a face: into a .blend, or as a film."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import bpy

from ...errors import ParameterError
from ...progress import Report, Work, part_of, run
from .. import bake
from ..bake.motion import FapMotion, at_rate
from ..pictures import film
from ..pictures.look import Engine, Look
from .files import Made, save
from .inputs import Input
from .stage import cover, dress
from .subjects import subject
from .words import filming

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
    object_name: str | None = None,
    engine: str = "WORKBENCH",
    creases: bool | None = None,
    progress: Report | None = None,
) -> Made:
    """Bake a stream onto a face with its muscles and save the .blend or the film (.mp4).

    It plays at the stream's rate; in a user's .blend, at that file's. Visemes and expressions are expanded; FAPs that
    no frame states are left to anatomy. Fill the stream first (`FapStream.filled`) where it states FAPs now and then
    only. Other parameters as for `words.bake_file`.

    Raises
    ------
    RisoriusError : nothing has been written then.
    """
    if engine.upper() not in list(Engine):
        raise ParameterError("engine", f"must be one of {', '.join(Engine)}", engine)
    is_blend = mesh is not None and Path(mesh).suffix.lower() == BLEND
    asked = Input.of(mesh, points, object_name, None if is_blend else stream.fps)
    return run(_play(Path(out), stream, asked, Engine(engine.upper()), creases), progress)


def _play(out: Path, stream: FapStream, asked: Input, engine: Engine, creases: bool | None) -> Work[Made]:
    """See `play_stream`."""
    film.refuse_unwritable_output(out)
    frames = stream.expanded()
    FapMotion(frames)  # refuses a stream without frames before anything is loaded
    face = yield from part_of(subject(asked, creases=bool(creases)), 0.0, 0.05)
    motion = FapMotion(at_rate(frames, stream.fps, bake.scene_fps()))
    saves = out.suffix.lower() == BLEND
    clip = stream.name.split("\\")[-1].strip() or "stream"
    baking = bake.bake_motion(face.target, motion, clip=clip, start=bpy.context.scene.frame_start, creases=creases)
    moved = yield from part_of(baking, 0.05, 0.95 if saves else 0.4)
    look = Look(engine=engine)
    if saves:
        said = cover(face, moved.frame_range[1])
        dress(face, look)
        save(out)
        return Made(
            blend=out,
            face=face.obj.name,
            shape_keys=len(moved.keys),
            error_mm=round(moved.error * 1000.0, 4),
            remarks=face.remarks + moved.remarks + said,
        )
    rendered = yield from part_of(filming(face, moved, out, look), 0.4, 1.0)
    remarks = face.remarks + moved.remarks + rendered.remarks
    return Made(film=rendered.path, face=face.obj.name, frames=rendered.frame_count, remarks=remarks)
