"""Jobs from words: a .blend, a film, a contact sheet."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ...errors import ParameterError
from ...mpeg4 import Liveliness
from ...progress import Progress, Report, Work, part_of, run
from ..bake.motion import CueMotion
from ..bake.performance import ARCHETYPES, PAUSE, cues_of
from ..pictures import film
from ..pictures.look import Engine, Look
from .destination import NEW_KEYS, Baked, Destination
from .files import Made
from .inputs import Input
from .labelling import Labels, refuse_unwritable_labels
from .sheet import write_apexes
from .subjects import Subject, subject
from .writing import filming, save_baked, saved_or_filmed

if TYPE_CHECKING:
    from ...api import Cue, Timing

#: Pixels of a picture on the contact sheet.
SHEET_SIZE = 640
#: What the demo's face does besides its expressions: blinks, small motions of head and eyes, as usual at rest.
ALIVE = Liveliness.usual(seed=4)
#: Puts the face of a job into a file.
Load = Callable[[], Work[Subject]]


def bake_file(
    out: str | Path,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    object_name: str | None = None,
    words: Sequence[str] = ARCHETYPES,
    activation: float | None = None,
    timing: Timing | None = None,
    destination: Destination = NEW_KEYS,
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
    activation, timing : as for `performance.cues_of`.
    destination : which shape keys or controls are keyed.
    dynamic : simulate one motion through all words, instead of one pose per word.
    creases : whether the skin wrinkles where it is squeezed; by default on the default head only. Cycles and EEVEE draw
        it, in the default head's material and those given to meshes that bring none.
    progress : called with each step.

    Raises
    ------
    RisoriusError : nothing has been written then.
    """
    load = partial(subject, Input.of(mesh, points, object_name, fps), creases=bool(creases))
    cues = cues_of(words, activation=activation, timing=timing)
    return run(_bake_file(Path(out), load, cues, destination, dynamic, creases), progress)


def render_film(
    out: str | Path,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    object_name: str | None = None,
    words: Sequence[str] = ARCHETYPES,
    activation: float | None = None,
    timing: Timing | None = None,
    destination: Destination = NEW_KEYS,
    engine: str = "WORKBENCH",
    fps: float | None = None,
    creases: bool | None = None,
    labels: Labels | None = None,
    progress: Report | None = None,
) -> Made:
    """Simulate words on a face and write the film (.mp4), and labels. Parameters as in `bake_file` and `demo`."""
    look = Look(engine=engine_of(engine))
    load = partial(subject, Input.of(mesh, points, object_name, fps), creases=bool(creases))
    cues = cues_of(words, activation=activation, timing=timing)
    return run(_render_film(Path(out), load, cues, destination, look, creases, labels), progress)


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

    The face blinks, looks about and moves its head a little; the contact sheet shows no blink.

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
    return run(_demo(Path(out_dir), load, cues_of(words), Look(engine=engine_of(engine)), creases), progress)


def engine_of(name: str) -> Engine:
    """The engine of that name."""
    try:
        return Engine(name.upper())
    except ValueError:
        raise ParameterError("engine", f"must be one of {', '.join(Engine)}", name) from None


def _begin(outputs: Sequence[Path], load: Load) -> Work[Subject]:
    """Refuse what cannot be written, then put the face into its file."""
    for path in outputs:
        film.refuse_unwritable_output(path)
    return (yield from part_of(load(), 0.0, 0.05))


def _move(
    face: Subject,
    cues: Sequence[Cue],
    destination: Destination,
    creases: bool | None,
    liveliness: Liveliness | None = None,
) -> Work[Baked]:
    """Simulate all cues as one motion, from the scene's first frame on."""
    return (yield from destination.motion(face, in_time(cues, liveliness), "performance", creases))


def in_time(cues: Sequence[Cue], liveliness: Liveliness | None = None) -> CueMotion:
    """Cues as one motion that ends at rest."""
    from ... import api

    end = max(cue.start + cue.duration for cue in cues)
    rest = api.Cue(api.expression("neutral"), start=end, onset=0.0, apex=PAUSE, offset=0.0)
    return CueMotion([*cues, rest], liveliness=liveliness)


def _bake_file(
    out: Path, load: Load, cues: Sequence[Cue], destination: Destination, dynamic: bool, creases: bool | None = None
) -> Work[Made]:
    """See `bake_file`."""
    face = yield from _begin([out], load)
    baking = _move(face, cues, destination, creases) if dynamic else destination.expressions(face, cues, creases)
    baked = yield from part_of(baking, 0.05, 0.95)
    return save_baked(out, face, baked, Look())


def _render_film(
    out: Path,
    load: Load,
    cues: Sequence[Cue],
    destination: Destination,
    look: Look,
    creases: bool | None = None,
    labels: Labels | None = None,
) -> Work[Made]:
    """See `render_film`."""
    refuse_unwritable_labels(labels, out)
    face = yield from _begin([out], load)
    motion = in_time(cues)
    baked = yield from part_of(destination.motion(face, motion, "performance", creases), 0.05, 0.4)
    return (yield from part_of(saved_or_filmed(out, face, baked, look, motion=motion, labels=labels), 0.4, 1.0))


def _demo(out: Path, load: Load, cues: Sequence[Cue], look: Look, creases: bool | None = None) -> Work[Made]:
    """See `demo`."""
    blend, movie, sheet = (out / f"risorius.{suffix}" for suffix in ("blend", "mp4", "png"))
    face = yield from _begin([blend, movie, sheet], load)
    baked = yield from part_of(_move(face, cues, NEW_KEYS, creases, ALIVE), 0.05, 0.35)
    rendered = yield from part_of(filming(face, baked, movie, look), 0.35, 0.9)
    yield Progress(0.91, "Composing the contact sheet")
    write_apexes(face.shown(), cues, replace(look, width=SHEET_SIZE, height=SHEET_SIZE, fine=True), sheet, ALIVE)
    yield Progress(0.99, "Saving the .blend")
    made = save_baked(blend, face, baked, look)
    remarks = tuple(dict.fromkeys(made.remarks + rendered.remarks))
    return replace(made, film=movie, sheet=sheet, frames=rendered.frame_count, remarks=remarks)
