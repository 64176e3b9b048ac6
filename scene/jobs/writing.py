"""What a job writes of what it has baked: a .blend, or a film with its labels."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import bpy

from ...progress import Work
from ..bake.motion import CueMotion, FapMotion
from ..pictures import film
from ..pictures.look import Look
from ..sounds import add_sound
from .destination import Baked
from .files import BLEND, Made, save
from .labelling import Labels, begin, remarks_on_labels
from .stage import cover, dress
from .subjects import Subject

if TYPE_CHECKING:
    from ...api import FapStream, Saying


def save_baked(out: Path, face: Subject, baked: Baked, look: Look) -> Made:
    """Furnish a scene of our own, save the .blend, and tell what is in it."""
    said = cover(face, baked.last)
    dress(face, look)
    save(out)
    return Made(
        blend=out,
        face=face.obj.name,
        shape_keys=baked.new_keys,
        error_mm=baked.error_mm,
        bytes=out.stat().st_size,
        clips=baked.reports,
        remarks=face.remarks + baked.remarks + said,
    )


def saved_or_filmed(
    out: Path,
    face: Subject,
    baked: Baked,
    look: Look,
    *,
    motion: CueMotion | FapMotion,
    sound: str | Path | None = None,
    labels: Labels | None = None,
    meant: Saying | FapStream | None = None,
) -> Work[Made]:
    """What was baked as one motion, as the .blend or the film that `out` names, and what is there.

    Parameters
    ----------
    motion : what was baked; `meant` : the speech or the stream that it is.
    sound : goes into the film, or to the sequencer of the .blend.
    labels : to write beside a film.
    """
    if out.suffix.lower() == BLEND:
        if sound is not None:
            (moved,) = baked.results
            add_sound(bpy.context.scene, sound, frame=int(moved.frame_range[0]))
        return save_baked(out, face, baked, look)
    if labels is None:
        rendered = yield from filming(face, baked, out, look, sound)
    else:
        start = int(baked.results[0].frame_range[0])
        labelling = begin(labels, face, motion, start=start, meant=meant)
        try:
            rendered = yield from filming(face, baked, out, look, sound, labelling.look)
            labelling.write(look)
        finally:
            labelling.discard()
    return Made(
        film=rendered.path,
        labels=None if labels is None else labels.folder,
        face=face.obj.name,
        frames=rendered.frame_count,
        clips=baked.reports,
        remarks=face.remarks + baked.remarks + rendered.remarks + (() if labels is None else remarks_on_labels()),
    )


def filming(
    face: Subject,
    baked: Baked,
    out: Path,
    look: Look,
    sound: str | Path | None = None,
    watch: film.Watch | None = None,
) -> Work[film.FilmResult]:
    """Render what was baked as one motion."""
    (moved,) = baked.results
    start, end = (int(frame) for frame in moved.frame_range)
    return film.render_film(face.shown(), out, start=start, end=end, look=look, sound=sound, watch=watch)
