"""Speech on a face: into a .blend, or as a film, with its sound."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ...errors import FormatError
from ...progress import Report, Work, part_of, run
from .. import bake
from ..bake.motion import FapMotion
from ..pictures import film
from ..pictures.look import Look
from .destination import NEW_KEYS, Destination
from .files import Made
from .inputs import Input
from .labelling import Labels, refuse_unwritable_labels
from .subjects import subject
from .words import engine_of
from .writing import saved_or_filmed

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
    if sound is not None and not os.path.isfile(sound):
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
    refuse_unwritable_labels(labels, out)
    film.refuse_unwritable_output(out)
    face = yield from part_of(subject(asked, creases=bool(creases)), 0.0, 0.05)
    saying = yield from part_of(say(bake.scene_fps()), 0.05, 0.1)
    face = replace(face, remarks=face.remarks + saying.assumed)
    motion = FapMotion(saying.stream.frames, saying.emotions, planned=True)
    baked = yield from part_of(destination.motion(face, motion, saying.stream.name, creases), 0.1, 0.4)
    filming = saved_or_filmed(out, face, baked, look, motion=motion, sound=sound, labels=labels, meant=saying)
    return (yield from part_of(filming, 0.4, 1.0))
