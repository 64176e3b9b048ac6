"""Writing what was computed: shape keys on all objects of a face, and the clip that moves them; taking them away."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...arrays import Floats
from ..blender_types import Action, Mesh
from ..creases import marks as crease_marks
from ..faces import FaceSource, face_of
from ..mesh import keys_of
from ..refusals import own_mesh, refuse_unwritable
from . import action as actions
from . import shape_keys, tracks
from .notes import Note, write_note
from .target import Target

if TYPE_CHECKING:
    from ...face.products.creases import Creases

#: A piece of a life-size face that moves less than this everywhere gets no shape keys, metres.
STILL = 1e-7


@dataclass(frozen=True)
class Written:
    """A clip's action, the names of its shape keys, and what the user should know."""

    action: Action
    keys: tuple[str, ...]
    remarks: tuple[str, ...]


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
) -> Written:
    """Write a clip and its shape keys on all pieces of a face, in place of those it had.

    Nothing fails once writing has begun.

    Parameters
    ----------
    names, displacements, curves : of its shape keys; displacements (K, V, 3), metres.
    slider_min : lowest value of the keys; the highest is 1.
    creases : of the head, or None to take them away.
    note : what is noted on the action.

    Raises
    ------
    SceneError : an object was changed since it was read.
    """
    target.refuse_changed(source)
    if target.make_single_user:
        for obj in source.objects:
            own_mesh(obj)
    head, least = source.pieces[0], STILL * face_of(source).scale
    moving = [piece for piece in source.pieces if piece is head or piece.moves(displacements, least)]
    members = [obj.data for obj in source.objects]
    free = shape_keys.free_names(names, members, clip)
    retired = {name for mesh in members for name in shape_keys.read_own(mesh).clips.get(clip, ())}
    face = _settle(members)
    for piece in source.pieces:
        if piece not in moving:
            shape_keys.remove_keys(piece.obj, [clip])
            continue
        shapes = {name: piece.key_positions(d) for name, d in zip(free, displacements, strict=True)}
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
    said = {remark for datablock in datablocks for remark in tracks.play(datablock, action)}
    return Written(action, free, tuple(sorted(said)) + shape_keys.shortened(clip))


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
