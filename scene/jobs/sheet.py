"""The contact sheet of a job: each expression at its apex, with what was asked and what the baked face shows."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...arrays import Floats
from ...files import scratch_folder
from ...mpeg4 import Liveliness
from ..bake.performance import FIRST_FRAME
from ..bake.timing import scene_fps
from ..blender_types import Object
from ..faces import face_of, read_face
from ..mesh import key_vertices, keys_of
from ..pictures.contact_sheet import Exhibit, exhibit_values, write_sheet
from ..pictures.following import FollowingCamera
from ..pictures.framing import framing_of
from ..pictures.look import Look
from ..pictures.studio import render_frame, studio

if TYPE_CHECKING:
    from ...api import Cue


def apex_frame(cue: Cue, fps: float, first: int = FIRST_FRAME, closure: Floats | None = None) -> int:
    """The frame at the end of a cue's apex, when the face has settled; the motion begins at frame `first`.

    `closure` (T,): how far blinks close the lids; the last frame of the apex without one is taken, if there is any.
    """
    begin, end = (int(np.floor(seconds * fps)) for seconds in (cue.start + cue.onset, cue.start + cue.onset + cue.apex))
    if closure is not None:
        open_eyed = np.flatnonzero(closure[begin : end + 1] == 0.0)
        end = begin + int(open_eyed[-1]) if len(open_eyed) else end
    return first + end


def write_apexes(
    shown: Sequence[Object], cues: Sequence[Cue], look: Look, path: Path, liveliness: Liveliness | None = None
) -> None:
    """Picture each cue's apex on objects, the head first, with what was asked against what the baked face shows.

    `liveliness`: what the face did besides; its blinks are kept out of the pictures.
    """
    first, fps = bpy.context.scene.frame_start, scene_fps()
    count = int(np.ceil(max(cue.start + cue.duration for cue in cues) * fps)) + 1
    closure = (liveliness or Liveliness()).over(count, fps).closure
    frames = [apex_frame(cue, fps, first, closure) for cue in cues]
    framing = framing_of(shown[0])
    with scratch_folder() as name:
        pictures = []
        with studio(shown, framing, look) as scene:
            camera = FollowingCamera(scene, shown[0], framing)
            for frame in frames:
                camera.go_to(frame)
                pictures.append(render_frame(scene, frame, name))
        write_sheet(_exhibits(shown[0], cues, frames, pictures), path)


def _exhibits(obj: Object, cues: Sequence[Cue], frames: Sequence[int], pictures: Sequence[Path]) -> list[Exhibit]:
    """The pictured apexes with their values."""
    from ... import api

    source = read_face(obj)
    face = face_of(source)
    labels = [f"F{fap.number} {fap.name}" for fap in api.FAPS.values()]
    exhibits = []
    for cue, frame, picture in zip(cues, frames, pictures, strict=True):
        moved = _played(obj, source.pieces[0].to_metres[:3, :3], frame)
        values = exhibit_values(labels, cue.profile.frame(), face.measure(source.vertices + moved))
        caption = f"activation {cue.profile.activation:.1f}"
        exhibits.append(Exhibit(str(cue.profile.word), caption, picture, values))
    return exhibits


def _played(obj: Object, to_metres: Floats, frame: int) -> Floats:
    """(V, 3) displacement that the shape keys make at a frame, metres."""
    bpy.context.scene.frame_set(frame)
    blocks = keys_of(obj).key_blocks
    basis = key_vertices(blocks[0])
    moved = sum((block.value * (key_vertices(block) - basis) for block in blocks[1:]), np.zeros_like(basis))
    displacement: Floats = moved @ to_metres.T
    return displacement
