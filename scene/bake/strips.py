"""Baking a timeline as strips: a shape key, an action and an NLA strip per clip, to be moved about by hand.

Clips that overlap lie on several tracks and add up; their curves hold what is left to each by the rules of blending.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import bpy

from ...arrays import Floats
from ...progress import Progress, Work, Writing, part_of
from ..blender_types import Action, Key, NlaTrack
from ..creases import marks as crease_marks
from ..faces import FaceSource, face_steps
from . import action as actions
from . import shape_keys
from .baking import BakeResult
from .notes import BakeKind, Note, read_notes
from .remarks import remarks, unmet_remarks
from .target import Target
from .tracks import FACE_TAG, TRACK_NAME, add_strip, is_own
from .writing import Written, clear, write_baked

if TYPE_CHECKING:
    from ...api import EmotionShares, Pose
    from ...face.products.creases import Creases


@dataclass(frozen=True, eq=False)
class ClipShape:
    """One clip of a timeline.

    Attributes
    ----------
    clip : its name. faps : (68,) FAPs at its apex; NaN where silent. curve : how much of it shows, frame by frame.
    settings : digest of what it is baked from. emotion, contractions : as for `Face.pose`.
    """

    clip: str
    faps: Floats
    curve: actions.Curve
    settings: str = ""
    emotion: EmotionShares | None = None
    contractions: Mapping[str, float] = field(default_factory=dict)


def bake_strips(
    target: Target, shapes: Sequence[ClipShape], *, drive: str = "natural", creases: bool | None = None
) -> Work[BakeResult]:
    """Bake each clip as a shape key with an action of its own, and lay their strips on NLA tracks.

    Strips baked before whose clips are gone from the timeline are removed.

    Raises
    ------
    SceneError, ModelError, SolverError : nothing has been changed then.
    """
    yield Progress(0.0, "Reading the face")
    source = target.source()
    yield Progress(0.05, "Placing the muscles")
    face = yield from part_of(face_steps(source), 0.05, 0.06)
    yield from part_of(face.prepare(), 0.06, 0.2)
    poses: list[Pose] = []
    for number, shape in enumerate(shapes):
        yield Progress(0.2 + 0.75 * number / len(shapes), f"Solving the skin for {shape.clip}")
        poses.append(face.pose(shape.faps, drive=drive, emotion=shape.emotion, contractions=shape.contractions))
    marks = crease_marks.prepare(source, creases)
    yield Writing(0.95, "Writing the shape keys")
    said = {*remarks(source.head, face), *target.remarks()}
    written = [
        _write(target, source, shape, pose.positions - face.vertices, marks)
        for shape, pose in zip(shapes, poses, strict=True)
    ]
    _remove_gone(target, [shape.clip for shape in shapes])
    for datablock in _datablocks(target):
        line_up(datablock, [baked.action for baked in written])
    for shape, pose, baked in zip(shapes, poses, written, strict=True):
        said.update(baked.remarks, unmet_remarks(pose.unmet, shape.clip))
    starts, ends = zip(*(actions.frames_of(baked.action) for baked in written), strict=True)
    return BakeResult(
        ", ".join(shape.clip for shape in shapes),
        ", ".join(baked.action.name for baked in written),
        tuple(key for baked in written for key in baked.keys),
        0.0,
        (min(starts), max(ends)),
        None,
        tuple(sorted(said)),
    )


def _write(target: Target, source: FaceSource, shape: ClipShape, moved: Floats, marks: Creases | None) -> Written:
    """Write the shape key and the action of one clip; `moved` (V, 3) in metres."""
    return write_baked(
        target,
        source,
        shape.clip,
        [shape.clip],
        moved[None],
        [shape.curve],
        slider_min=0.0,
        creases=marks,
        note=Note(BakeKind.STRIP, shape.settings, ((shape.clip, float(shape.curve.frames[0])),)),
    )


def _remove_gone(target: Target, clips: Iterable[str]) -> None:
    """Remove strips of clips that are no longer there."""
    notes = read_notes(shape_keys.own_face(target.obj.data))
    gone = [clip for clip, note in notes.items() if note.kind is BakeKind.STRIP and clip not in set(clips)]
    if gone:
        clear(target, clips=gone)


def _datablocks(target: Target) -> list[Key]:
    """Shape key datablocks of the face's meshes."""
    return [member.data.shape_keys for member in target.objects() if member.data.shape_keys is not None]


def line_up(keys: Key, clips: Sequence[Action]) -> None:
    """Lay actions on own NLA tracks of a shape key datablock, one below the other where they overlap, and play them.

    A user's own action stays where it is and plays on top.
    """
    animation = keys.animation_data or keys.animation_data_create()
    if animation.action is not None and FACE_TAG in animation.action:
        animation.action = None
    for track in [track for track in animation.nla_tracks if is_own(track)]:
        animation.nla_tracks.remove(track)
    tracks: list[NlaTrack] = []
    for action in sorted(clips, key=lambda clip: float(clip.frame_start)):
        free = (each for each in tracks if each.strips[-1].frame_end <= action.frame_start)
        place = next(free, None)
        if place is None:
            place = animation.nla_tracks.new()
            place.name = TRACK_NAME
            tracks.append(place)
        strip = add_strip(place, action)
        strip.blend_type = "REPLACE" if place == tracks[0] else "ADD"
    bpy.context.view_layer.update()
