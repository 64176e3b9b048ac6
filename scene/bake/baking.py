"""Baking: shape keys and keyframes from a face's poses and motions.

Everything is computed before anything is written, so an error or a cancelled bake leaves the scene as it was.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...arrays import Floats
from ...errors import ParameterError, SceneError
from ...face.mesh.parts import Part
from ...progress import Progress, Work
from ..blender_types import Action, Mesh, Object, Scene
from ..creases import marks as crease_marks
from ..faces import FaceSource, face_of, read_face
from ..mesh import keys_of
from ..refusals import own_mesh, refuse_unwritable
from . import action as actions
from . import shape_keys
from .compress import TOLERANCE, compress
from .motion import Motion
from .notes import Note, write_note
from .remarks import remarks

if TYPE_CHECKING:
    from ...api import EmotionShares
    from ...face.products.creases import Creases

#: A piece that moves less than this everywhere gets no shape keys, metres.
STILL = 1e-7


@dataclass(frozen=True)
class ClipTiming:
    """When an expression happens: seconds of onset, apex and offset from the frame `start` on, at `fps`."""

    onset: float
    apex: float
    offset: float
    start: float = 1.0
    fps: float = 25.0

    def __post_init__(self) -> None:
        for name in ("onset", "apex", "offset"):
            if not (np.isfinite(getattr(self, name)) and getattr(self, name) >= 0.0):
                raise ParameterError(name, "must be zero or more seconds", getattr(self, name))
        if not self.fps > 0.0:
            raise ParameterError("fps", "must be above zero", self.fps)

    def curve(self, peak: float) -> actions.Curve:
        """Zero, up to `peak`, held, and back to zero."""
        steps = np.array([0.0, self.onset, self.apex, self.offset]) * self.fps
        frames = self.start + np.cumsum(np.maximum(steps, [0.0, 1.0, 0.0, 1.0]))
        values = np.array([0.0, peak, peak, 0.0])
        distinct = np.concatenate([[True], np.diff(frames) > 1e-6])
        return actions.Curve(frames[distinct], values[distinct])


@dataclass(frozen=True)
class BakeResult:
    """What a bake has written.

    Attributes
    ----------
    clip, action : the clip's name, and its action's.
    keys : names of its shape keys.
    error : largest distance of any vertex from the computed motion, metres.
    frame_range : first and last frame.
    achieved : (68,) FAPs measured on an expression; None for a motion.
    remarks : what the user should know.
    """

    clip: str
    action: str
    keys: tuple[str, ...]
    error: float
    frame_range: tuple[float, float]
    achieved: Floats | None = None
    remarks: tuple[str, ...] = ()


@dataclass(frozen=True)
class Target:
    """Where to bake: the head, the objects of its other parts, and whether shared meshes may be made its own."""

    obj: Object
    companions: Mapping[Part, Object] | None = None
    make_single_user: bool = False

    def objects(self) -> list[Object]:
        """The head and the objects of its other parts."""
        return [self.obj, *(other for other in (self.companions or {}).values() if other is not None)]

    def source(self) -> FaceSource:
        """Read the face, refusing what must not be written to."""
        for member in self.objects():
            refuse_unwritable(member, make_single_user=self.make_single_user)
        return read_face(self.obj, companions=self.companions)


def bake_expression(
    target: Target,
    frame: Floats,
    *,
    clip: str,
    timing: ClipTiming,
    peak: float = 1.0,
    drive: str = "natural",
    emotion: EmotionShares | None = None,
    contractions: Mapping[str, float] | None = None,
    creases: bool | None = None,
    note: Note | None = None,
) -> Work[BakeResult]:
    """Bake one expression as one shape key at its apex, with keyframes along onset, apex and offset.

    Parameters
    ----------
    frame : (68,) FAPs; NaN where the expression is silent.
    clip : name of the shape key and of the clip; a clip of this name is replaced.
    peak : the key's value at the apex.
    drive, emotion, contractions : as for `Face.pose`.
    creases : whether the head gets creases (`creases.settle`); None: where a material of it draws them.
    note : what is noted on the action (`notes.py`).

    Raises
    ------
    SceneError, ModelError, SolverError : nothing has been changed then.
    """
    yield Progress(0.0, "Reading the face")
    source = target.source()
    yield Progress(0.1, "Placing the muscles")
    face = face_of(source)
    yield Progress(0.5, f"Solving the skin for {clip}")
    pose = face.pose(frame, drive=drive, emotion=emotion, contractions=contractions)
    yield Progress(0.95, "Writing the shape key")
    shapes = (np.asarray(pose.positions) - source.vertices)[None]
    marks = crease_marks.prepare(source, creases)
    action, keys, said = write_baked(
        target, source, clip, [clip], shapes, [timing.curve(peak)], slider_min=0.0, creases=marks, note=note
    )
    return BakeResult(
        clip, action.name, keys, 0.0, actions.frames_of(action), np.asarray(pose.achieved), remarks(source.head) + said
    )


def bake_motion(
    target: Target,
    motion: Motion,
    *,
    clip: str,
    start: float = 1.0,
    fps: float | None = None,
    drive: str = "natural",
    tolerance: float = TOLERANCE,
    creases: bool | None = None,
    note: Note | None = None,
) -> Work[BakeResult]:
    """Simulate a motion and bake it, compressed to as few shape keys as keep every vertex within `tolerance`.

    Parameters
    ----------
    motion : expressions in time or a FAP stream (`motion.py`).
    clip : name of the clip, and of its shape keys with a number; a clip of this name is replaced.
    start : first frame in Blender's timeline.
    fps : frames per second of the motion; by default the scene's.
    drive : as for `Face.simulate`.
    tolerance : metres.
    creases, note : as for `bake_expression`.

    Raises
    ------
    SceneError, ModelError, SolverError : nothing has been changed then.
    """
    rate = fps if fps is not None else scene_fps()
    count = motion.frame_count(rate)
    yield Progress(0.0, "Reading the face")
    source = target.source()
    yield Progress(0.02, "Placing the muscles")
    face = face_of(source)
    displacements = np.empty((count, *source.vertices.shape))
    for index, positions in enumerate(motion.positions(face, rate, drive)):
        displacements[index] = positions - source.vertices
        yield Progress(0.1 + 0.75 * (index + 1) / count, f"Simulating frame {index + 1} of {count}")
    yield Progress(0.87, "Compressing the motion to shape keys")
    packed = compress(displacements, tolerance=tolerance)
    if len(packed.shapes) == 0:
        raise SceneError(source.head.name, "nothing moves in this motion: increase its activation or its duration")
    yield Progress(0.97, "Writing the shape keys")
    names = [f"{clip} {number + 1:02d}" for number in range(len(packed.shapes))]
    times = start + np.arange(count, dtype=np.float64)
    curves = [actions.Curve(times, weights, linear=True) for weights in packed.weights.T]
    marks = crease_marks.prepare(source, creases)
    action, keys, said = write_baked(
        target, source, clip, names, packed.shapes, curves, slider_min=-1.0, creases=marks, note=note
    )
    said = remarks(source.head) + said
    return BakeResult(clip, action.name, keys, packed.error, actions.frames_of(action), None, said)


def write_baked(
    target: Target,
    source: FaceSource,
    clip: str,
    names: list[str],
    displacements: Floats,
    curves: list[actions.Curve],
    *,
    slider_min: float,
    creases: Creases | None,
    note: Note | None = None,
) -> tuple[Action, tuple[str, ...], tuple[str, ...]]:
    """Write shape keys (K, V, 3 displacements, metres) on all pieces, and their clip; nothing can fail from here on."""
    if target.make_single_user:
        for obj in source.objects:
            own_mesh(obj)
    head = source.pieces[0]
    moving = [p for p in source.pieces if p is head or np.abs(displacements[:, p.slice]).max(initial=0.0) > STILL]
    members = [obj.data for obj in source.objects]
    free = shape_keys.free_names(names, members, clip)
    retired = {name for mesh in members for name in shape_keys.read_own(mesh).clips.get(clip, ())}
    face = _settle(members)
    for piece in source.pieces:
        if piece not in moving:
            shape_keys.remove_keys(piece.obj, [clip])
            continue
        shapes = {name: piece.local_positions(d) for name, d in zip(free, displacements, strict=True)}
        face = shape_keys.write_keys(piece.obj, clip, shapes, slider_min=slider_min, face=face).face
    datablocks = [keys_of(piece.obj) for piece in moving]
    action = actions.write_clip(
        face,
        clip,
        f"{source.head.name} {clip}",
        dict(zip(free, curves, strict=True)),
        keys=datablocks,
        retired=retired,
        silent={name for mesh in members for name in shape_keys.read_own(mesh).names},
    )
    if note is not None:
        write_note(action, note)
    crease_marks.settle(source, creases)
    said = {actions.play(datablock, action) for datablock in datablocks}
    return action, free, tuple(sorted(remark for remark in said if remark))


def _settle(members: list[Mesh]) -> str:
    """The face's name; a duplicated face gets one of its own, and the clips that only it plays."""
    face, old = shape_keys.settle_face(members)
    if face != old:
        actions.rename_face(old, face, [mesh.shape_keys for mesh in members if mesh.shape_keys is not None])
    return face


def clear(target: Target, *, clips: list[str] | None = None) -> tuple[str, ...]:
    """Remove what has been baked on the face: all clips, or those named; keys, actions and tracks.

    Returns
    -------
    Names of the removed shape keys.

    Raises
    ------
    SceneError : the object must not be written to.
    """
    members = target.objects()
    for member in members:
        refuse_unwritable(member, make_single_user=True)
    records = [shape_keys.read_own(member.data) for member in members]
    going = list(dict.fromkeys(clip for record in records for clip in record.clips)) if clips is None else clips
    face = _settle([member.data for member in members])
    removed: list[str] = []
    for clip in going:
        names = {name for record in records for name in record.clips.get(clip, ())}
        datablocks = [member.data.shape_keys for member in members if member.data.shape_keys is not None]
        actions.remove_clip(face, clip, keys=datablocks, key_names=names)
        for member in members:
            shape_keys.remove_keys(member, [clip])
        removed += sorted(names)
    if not shape_keys.has_own(target.obj):
        crease_marks.remove(target.obj)
    return tuple(removed)


def scene_fps(scene: Scene | None = None) -> float:
    """Frames per second of the scene."""
    render = (scene or bpy.context.scene).render
    return float(render.fps) / float(render.fps_base)
