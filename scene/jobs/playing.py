"""Playing a FAP stream on a face: into a .blend, or as a film."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ...mpeg4 import bridged
from ...progress import Report, Work, part_of, run
from .. import bake
from ..bake.motion import FapMotion, at_rate
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
    from ...api import FapStream


def play_stream(
    out: str | Path,
    stream: FapStream,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    object_name: str | None = None,
    destination: Destination = NEW_KEYS,
    engine: str = "WORKBENCH",
    creases: bool | None = None,
    inertia: bool = False,
    labels: Labels | None = None,
    progress: Report | None = None,
) -> Made:
    """Bake a stream by a face's muscles and save the .blend or the film (.mp4).

    It plays at the stream's rate; in a user's .blend, at that file's. Visemes and expressions are expanded; FAPs that
    no frame states are left to anatomy, and unknown frames are bridged, which is remarked. Fill the stream first
    (`FapStream.filled`) where it states FAPs now and then only. Each frame is shown as it is, or with `inertia` skin
    and jaw follow it with theirs. Other parameters as for `words.bake_file`.

    Raises
    ------
    RisoriusError : nothing has been written then.
    """
    asked = Input.of(mesh, points, object_name)
    if not asked.is_scene:
        asked = replace(asked, fps=stream.fps)
    look = Look(engine=engine_of(engine))
    return run(_play(Path(out), stream, asked, destination, look, creases, inertia, labels), progress)


def _play(
    out: Path,
    stream: FapStream,
    asked: Input,
    destination: Destination,
    look: Look,
    creases: bool | None,
    inertia: bool,
    labels: Labels | None,
) -> Work[Made]:
    """See `play_stream`."""
    refuse_unwritable_labels(labels, out)
    film.refuse_unwritable_output(out)
    played = bridged(stream.expanded(), stream.fps)
    FapMotion(played.frames)  # refuses a stream without frames before anything is loaded
    face = yield from part_of(subject(asked, creases=bool(creases)), 0.0, 0.05)
    motion = FapMotion(at_rate(played.frames, stream.fps, bake.scene_fps()), inertia=inertia)
    face = replace(face, remarks=face.remarks + played.said)
    clip = stream.name.split("\\")[-1].strip() or "stream"
    baked = yield from part_of(destination.motion(face, motion, clip, creases), 0.05, 0.4)
    return (
        yield from part_of(
            saved_or_filmed(out, face, baked, look, motion=motion, labels=labels, meant=stream), 0.4, 1.0
        )
    )
