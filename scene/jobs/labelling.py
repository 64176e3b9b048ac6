"""The truth beside what a job renders: a folder of tables, pictures, a schema and a data card (`labels`).

    labelling = begin(Labels(Path("joy-labels")), face, motion, start=1)
    ... each time a frame has been rendered in a studio: labelling.look(scene, frame)
    labelling.write(look)

or, for a motion that is baked and a studio that stands: `write_labels`.
"""

from __future__ import annotations

import platform
from collections.abc import Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ...resources import version
from ..bake.motion import CueMotion, FapMotion
from ..bake.timing import scene_fps
from ..blender_types import Scene
from ..faces import FaceSource, face_of
from ..pictures.look import Look
from .files import BLEND
from .labelled_motion import felt_of, told_motion
from .subjects import Subject

if TYPE_CHECKING:
    from ...api import FapStream, Saying
    from ...labels.record import Record
    from ..labels.stage import Stage

#: Whose the default head is.
OWN_LICENCE = "GPL-3.0-or-later (Risorius); its measures: MIT, USC Institute for Creative Technologies"


@dataclass(frozen=True)
class Labels:
    """Which labels go where.

    Attributes
    ----------
    folder : what is written; earlier labels there are replaced.
    pictures : areas, objects, depth and normals of every n-th frame, from the first on; 0: none.
    licence : of the head, for the data card.
    facts : what else the data card is to say: name -> text or figures.
    """

    folder: Path
    pictures: int = 0
    licence: str = ""
    facts: Mapping[str, object] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.pictures < 0:
            raise ParameterError("pictures", "must be 0 or more: of every n-th frame", self.pictures)


class Labelling:
    """Labels of one motion in the making: nothing is seen of them until `write`."""

    def __init__(self, labels: Labels, source: FaceSource, record: Record, facts: Mapping[str, object]) -> None:
        from ...labels.frames import Subject as Labelled
        from ...labels.package import Draft

        self._labels, self._source, self._record, self._facts = labels, source, record, facts
        self._labelled, self._objects = Labelled.of(face_of(source)), list[str]()
        self._draft = Draft(labels.folder)

    def look(self, scene: Scene, number: int) -> None:
        """Take in what a scene shows at a frame of the timeline, through its camera.

        Raises
        ------
        SceneError : a panoramic camera, or a modifier that makes another mesh of the face.
        FormatError : a picture cannot be written.
        """
        from ...labels.frames import Frame
        from ...labels.pictures import depth_step
        from ..labels.lens import view_of
        from ..labels.rendered import as_rendered
        from ..labels.stage import stage_of

        if scene.frame_current != number:
            scene.frame_set(number)
        scene.view_layers[0].update()
        with as_rendered(scene):
            stage = stage_of(scene, self._source.pieces, self._objects)
            measured = self._labelled.face.measure(self._metric(scene, stage))
            view = view_of(scene)
        frame = Frame(self._labelled, view, stage.world, measured, stage.shown)
        every = self._labels.pictures
        if not every or len(self._record) % every:
            self._record.add(number, frame)
            return
        name = f"{number:05d}.png"
        for kind, pixels in frame.pictures():
            self._draft.add_picture(kind, name, pixels)
        self._record.add(number, frame, picture=name, depth_step=depth_step(frame.drawn.depth))

    def _metric(self, scene: Scene, stage: Stage) -> Floats:
        """(V, 3) the face's own vertices, metres: not smoothed by what divides them, as its neutral face is not."""
        from ..labels.rendered import undivided
        from ..labels.stage import stage_of

        pieces = self._source.pieces
        with undivided(scene, [piece.obj for piece in pieces]) as is_other:
            local = stage_of(scene, pieces).local if is_other else stage.local
        places = [local[each.slice] @ each.to_metres[:3, :3].T + each.to_metres[:3, 3] for each in pieces]
        return np.concatenate(places)

    def write(self, look: Look) -> Path:
        """Write it all; returns the folder.

        Raises
        ------
        FormatError : the folder cannot be written; what was there before is as it was.
        """
        from ...labels.card import Card

        facts = {
            **self._facts,
            "picture": _told(look),
            "frames": len(self._record),
            "frames_per_second": self._record.fps,
            "objects": self._objects,
            **self._labels.facts,
        }
        self._draft.finish(self._record.tables(), Card.of(**facts))
        return self._labels.folder

    def discard(self) -> None:
        """Give it up; nothing has been written then."""
        self._draft.discard()


def refuse_unwritable_labels(labels: Labels | None, out: Path) -> None:
    """Refuse labels of what is no film, or in a folder that cannot be written or holds something else, before any work.

    `out` : the file that the job writes.
    """
    from ...labels.package import Draft

    if labels is None:
        return
    if out.suffix.lower() == BLEND:
        raise ParameterError("labels", "need a film (.mp4): they tell what its frames show", str(out))
    Draft(labels.folder).discard()


def remarks_on_labels() -> tuple[str, ...]:
    """What the user should know of labels that are written here."""
    from ...labels.tables import parquet_problem

    problem = parquet_problem()
    return () if problem is None else (problem,)


def begin(
    labels: Labels,
    face: Subject,
    motion: CueMotion | FapMotion,
    *,
    start: int,
    meant: Saying | FapStream | None = None,
    drive: str = "natural",
) -> Labelling:
    """Begin labels of a motion that is baked on a face.

    Parameters
    ----------
    motion : what was baked. start : frame of the timeline at which it begins.
    meant : the speech or the stream that the motion is. drive : with which it was baked.

    Raises
    ------
    FormatError : a folder that cannot be written, or holds something else.
    """
    from ... import api
    from ...labels.record import Record

    fps, source = scene_fps(), face.target.source()
    whose = face_of(source)
    if isinstance(motion, CueMotion):
        efforts = api.performance_efforts(
            whose, motion.cues, fps, drive=drive, contractions=motion.contractions, liveliness=motion.liveliness
        )
    else:
        efforts = api.stream_efforts(
            whose, motion.stream, drive=drive, emotions=motion.emotions, planned=motion.planned
        )
    record = Record(felt_of(motion, meant, fps), efforts, start, fps)
    told = {**told_motion(motion, meant), "drive": drive}
    facts = {"made_with": _made_with(), "head": _head(face, source, labels), "motion": told}
    return Labelling(labels, source, record, facts)


def _told(look: Look) -> dict[str, object]:
    """A look as the data card tells it."""
    return {
        "engine": str(look.engine),
        "width": look.width,
        "height": look.height,
        "camera": str(look.camera).lower(),
        "yaw_degrees": round(float(np.degrees(look.yaw)), 6),
        "pitch_degrees": round(float(np.degrees(look.pitch)), 6),
        "roll_degrees": round(float(np.degrees(look.roll)), 6),
        "lens_mm": look.lens,
        "background": list(look.background if look.backdrop is None else look.backdrop),
        "light": look.lighting.strength,
        "light_yaw_degrees": round(float(np.degrees(look.lighting.yaw)), 6),
    }


def _made_with() -> dict[str, object]:
    """Versions of all that had a hand in it."""
    import scipy

    return {
        "risorius": version(),
        "blender": bpy.app.version_string,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "system": f"{platform.system()} {platform.machine()}",
    }


def _head(face: Subject, source: FaceSource, labels: Labels) -> dict[str, object]:
    """Whose head it is."""
    path = face.file
    own = path is None and not face.in_own_scene
    return {
        "name": face.obj.name,
        "file": ("built by Risorius" if own else "") if path is None else path.name,
        "sha256": "" if path is None else sha256(path.read_bytes()).hexdigest(),
        "vertices": len(source.vertices),
        "licence": labels.licence or (OWN_LICENCE if own else ""),
    }
