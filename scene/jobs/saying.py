"""Speech on a face: into a .blend, or as a film, with its sound."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import bpy

from ...errors import FormatError
from ...progress import Report, Work, part_of, run
from .. import bake
from ..bake.motion import FapMotion
from ..pictures import film
from ..pictures.look import Look
from ..sounds import add_sound
from .destination import NEW_KEYS, Destination
from .files import Made
from .inputs import Input
from .labelling import Labels, refuse_unwritable_labels
from .playing import BLEND
from .subjects import subject
from .words import engine_of, film_baked, save_baked

if TYPE_CHECKING:
    from collections.abc import Callable

    from ...api import Saying


def say_file(
    out: str | Path,
    say: Callable[[float], Work[Saying]],
    *,
    sound: str | Path | None = None,
    fps: float | None = None,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    object_name: str | None = None,
    destination: Destination = NEW_KEYS,
    engine: str = "WORKBENCH",
    creases: bool | None = None,
    labels: Labels | None = None,
    progress: Report | None = None,
) -> Made:
    """Bake speech by a face's muscles and save the .blend or the film (.mp4).

    Parameters
    ----------
    say : makes the speech at a frame rate, that of the scene: `api.say_steps`.
    sound : a sound file that begins with the speech; in a .blend it goes to the sequencer.
    fps, mesh, points, object_name : see `inputs.Input`. Others as for `words.bake_file`.

    Raises
    ------
    RisoriusError : nothing has been written then.
    """
    if sound is not None and not Path(sound).is_file():
        raise FormatError(sound, "does not exist: check the path of the sound")
    asked, look = Input.of(mesh, points, object_name, fps), Look(engine=engine_of(engine))
    return run(_say(Path(out), say, asked, destination, look, creases, sound, labels), progress)


def _say(
    out: Path,
    say: Callable[[float], Work[Saying]],
    asked: Input,
    destination: Destination,
    look: Look,
    creases: bool | None,
    sound: str | Path | None,
    labels: Labels | None,
) -> Work[Made]:
    """See `say_file`."""
    refuse_unwritable_labels(labels)
    film.refuse_unwritable_output(out)
    face = yield from part_of(subject(asked, creases=bool(creases)), 0.0, 0.05)
    saying = yield from part_of(say(bake.scene_fps()), 0.05, 0.1)
    face = replace(face, remarks=face.remarks + saying.assumed)
    saves = out.suffix.lower() == BLEND
    motion = FapMotion(saying.stream.frames, saying.emotions, planned=True)
    baked = yield from part_of(
        destination.motion(face, motion, saying.stream.name, creases), 0.1, 0.95 if saves else 0.4
    )
    if saves:
        if sound is not None:
            (moved,) = baked.results
            add_sound(bpy.context.scene, sound, frame=int(moved.frame_range[0]))
        return save_baked(out, face, baked, look)
    filming = film_baked(out, face, baked, look, motion=motion, sound=sound, labels=labels, saying=saying)
    return (yield from part_of(filming, 0.4, 1.0))
