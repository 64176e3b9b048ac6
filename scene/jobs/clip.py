"""One clip with all that is asked of it: still, film, .blend, .glb, stream and labels of the same motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...errors import RisoriusError
from ...progress import Progress, Work, part_of, run
from .. import bake
from ..faces import face_of, keep_steps, keep_where
from ..gltf import export_gltf
from ..materials import Colour
from ..pictures.film import Watch, render_film, render_frames
from ..pictures.following import FollowingCamera
from ..pictures.framing import framing_of
from ..pictures.look import Engine as Engine
from ..pictures.look import Lighting as Lighting
from ..pictures.look import Look as Look
from ..pictures.studio import studio
from ..sounds import add_sound
from .files import save
from .inputs import Input
from .labelling import Labelling, Labels, begin, remarks_on_labels
from .shown import Shown, ShownAt
from .skin_colour import colour_skin
from .stage import cover, dress
from .subjects import Subject, subject

if TYPE_CHECKING:
    from ...api import Cue

#: Output -> name of its file, or of its folder.
NAMES: Mapping[str, str] = MappingProxyType(
    {
        "still": "still.png",
        "film": "film.mp4",
        "blend": "clip.blend",
        "glb": "clip.glb",
        "fap": "clip.fap",
        "labels": "labels",
    }
)
#: An expression that is no stronger than this does not show.
FAINT = 1e-3
#: Those that show a motion.
MOVING = {"film", "blend", "glb"}


@dataclass(frozen=True, eq=False)
class Clip:
    """What is to be made.

    Attributes
    ----------
    name : of the clip in .blend, .glb and stream.
    face : whose face.
    shown : what it shows.
    outputs : of `NAMES`.
    look : how it is pictured.
    sound : a sound that begins with the motion.
    skin : colour of the skin, linear RGB; None: its own.
    still_at : seconds of the still; None: where most shows.
    creases, drive, max_keys : as for `bake_motion`.
    remarks : what is to be said of it.
    label_pictures, licence, facts : as for `Labels`; of a still alone, areas, depth and normals are written always.
    """

    name: str
    face: Input
    shown: ShownAt
    outputs: tuple[str, ...]
    look: Look
    sound: Path | None = None
    skin: Colour | None = None
    still_at: float | None = None
    creases: bool | None = None
    drive: str = "natural"
    max_keys: int | None = None
    label_pictures: int = 0
    licence: str = ""
    facts: Mapping[str, object] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()

    @property
    def is_still(self) -> bool:
        """Whether all that is shown is one frame."""
        return "still" in self.outputs and not MOVING & set(self.outputs)

    @property
    def is_posed(self) -> bool:
        """Whether the pose of the apex is enough, without the motion to it."""
        looks = MOVING | {"labels"}
        return self.still_at is None and (self.is_still or not looks & set(self.outputs))


@dataclass(frozen=True)
class MadeClip:
    """What was made: the name of each file or folder, the frames of the motion, what is to be said.

    `contents`: digests of what is in files whose bytes differ from time to time. `blender`: its version.
    """

    files: Mapping[str, str]
    frames: int
    remarks: tuple[str, ...] = ()
    contents: Mapping[str, str] = field(default_factory=dict)
    blender: str = ""


def keep_heads(folder: Path) -> None:
    """Keep heads that were prepared for a clip in a folder, for the next process."""
    keep_where(lambda: folder)


def make_clip(folder: Path, clip: Clip) -> Work[MadeClip]:
    """Make all outputs of a clip in a folder.

    Raises
    ------
    RisoriusError : names what is wrong; files may have been written by then.
    """
    face = yield from part_of(subject(clip.face, creases=bool(clip.creases)), 0.0, 0.05)
    if clip.skin is not None:
        colour_skin(face.obj, clip.skin)
    shown = clip.shown(bake.scene_fps())
    if "glb" in clip.outputs and not shown.moves:
        raise RisoriusError("a face that rests has no motion for a .glb: leave glb out, or let the face move")
    said = clip.remarks + face.remarks + shown.remarks
    said += yield from part_of(_bake(face, shown, clip), 0.05, 0.4)
    if shown.moves and set(clip.outputs) != {"fap"}:
        yield Progress(0.4, "Keeping the prepared head")
        run(keep_steps(face_of(face.target.source())))
    first = bpy.context.scene.frame_start
    last = first + len(shown.frames) - 1
    at = first + _still_frame(shown, clip)
    pictured = yield from part_of(_picture(folder, face, shown, clip, at), 0.4, 0.9)
    yield Progress(0.9, "Saving")
    _save(folder, face, shown, clip, last)
    files = {output: NAMES[output] for output in clip.outputs}
    return MadeClip(files, len(shown.frames), tuple(dict.fromkeys(said + pictured)), blender=bpy.app.version_string)


def _still_frame(shown: Shown, clip: Clip) -> int:
    """The frame of the still, counted from 0."""
    wanted = shown.apex if clip.still_at is None else round(clip.still_at * bake.scene_fps())
    if wanted >= len(shown.frames):
        seconds = (len(shown.frames) - 1) / bake.scene_fps()
        raise RisoriusError(f"still_at is {clip.still_at:g} s, but the motion ends at {seconds:g} s: set it earlier")
    return wanted


def _bake(face: Subject, shown: Shown, clip: Clip) -> Work[tuple[str, ...]]:
    """Bake what is shown; returns remarks. A face that rests, or that nobody sees, stays as it is."""
    if not shown.moves or set(clip.outputs) == {"fap"}:
        return ()
    if shown.cue is not None and clip.is_posed:
        return (yield from _pose(face, shown, shown.cue, clip))
    result = yield from bake.bake_motion(
        face.target,
        shown.motion,
        clip=clip.name,
        start=bpy.context.scene.frame_start,
        drive=clip.drive,
        max_keys=clip.max_keys,
        creases=clip.creases,
    )
    return (*result.told, *result.remarks)


def _pose(face: Subject, shown: Shown, cue: Cue, clip: Clip) -> Work[tuple[str, ...]]:
    """Bake the pose of the apex alone, which all frames show then; returns remarks."""
    fps, first = bake.scene_fps(), bpy.context.scene.frame_start
    strength = float(cue.strength(np.array([shown.apex / fps]))[0])
    if strength < FAINT:
        return ()
    result = yield from bake.bake_expression(
        face.target,
        shown.frames[shown.apex] / strength,
        clip=clip.name,
        timing=bake.ClipTiming(0.0, (len(shown.frames) + 2) / fps, 0.0, start=first - 2.0, fps=fps),
        peak=strength,
        drive=clip.drive,
        emotion=cue.profile.weights,
        creases=clip.creases,
    )
    return (*result.told, *result.remarks)


def _labelled(folder: Path, face: Subject, shown: Shown, clip: Clip, first: int) -> Labelling | None:
    """Labels of what is shown, where they are wanted."""
    if "labels" not in clip.outputs:
        return None
    every = 1 if clip.is_still else clip.label_pictures
    labels = Labels(folder / NAMES["labels"], every, clip.licence, {"clip": clip.name, **clip.facts})
    return begin(labels, face, shown.motion, start=first, meant=shown.meant, drive=clip.drive)


def _picture(folder: Path, face: Subject, shown: Shown, clip: Clip, at: int) -> Work[tuple[str, ...]]:
    """Render film and still, and write labels of the frames of the film, or else of the still; returns remarks."""
    wanted, said = set(clip.outputs), tuple[str, ...]()
    first = bpy.context.scene.frame_start
    last = first + len(shown.frames) - 1
    labelling = _labelled(folder, face, shown, clip, first)
    try:
        watch = None if labelling is None else labelling.look
        if "film" in wanted:
            filming = render_film(
                face.shown(),
                folder / NAMES["film"],
                start=first,
                end=last,
                look=clip.look,
                sound=clip.sound,
                watch=watch,
            )
            said += (yield from part_of(filming, 0.0, 0.8)).remarks
        elif watch is not None and not clip.is_still:
            yield from part_of(_look_at(face, clip, first, last, watch), 0.0, 0.8)
        if "still" in wanted:
            look = replace(clip.look, fine=True)
            drawing = render_frames(
                face.shown(), folder, start=at, end=at, look=look, watch=watch if clip.is_still else None
            )
            pictures, remarks = yield from part_of(drawing, 0.8, 0.9)
            pictures[0].rename(folder / NAMES["still"])
            said += remarks
        if labelling is not None:
            labelling.write(clip.look)
            said += remarks_on_labels()
    finally:
        if labelling is not None:
            labelling.discard()
    return said


def _look_at(face: Subject, clip: Clip, first: int, last: int, watch: Watch) -> Work[None]:
    """Show each frame to `watch` as the camera would see it, without drawing it."""
    framing = framing_of(face.obj)
    with studio(face.shown(), framing, clip.look) as scene:
        camera = FollowingCamera(scene, face.obj, framing)
        for frame in range(first, last + 1):
            camera.go_to(frame)
            watch(scene, frame)
            yield Progress((frame - first) / (last - first + 1), f"Labelling frame {frame - first + 1}")


def _save(folder: Path, face: Subject, shown: Shown, clip: Clip, last: int) -> None:
    """Write stream, .glb and .blend."""
    from ... import api

    wanted = set(clip.outputs)
    if "fap" in wanted:
        told = api.FapStream(shown.frames, fps=bake.scene_fps(), name=clip.name)
        api.write_stream(folder / NAMES["fap"], told)
    if "glb" in wanted:
        export_gltf(face.target.objects(), folder / NAMES["glb"], morph_normals=True)
    if "blend" in wanted:
        if clip.sound is not None:
            add_sound(bpy.context.scene, clip.sound, frame=bpy.context.scene.frame_start, packed=True)
        cover(face, last)
        dress(face, clip.look)
        save(folder / NAMES["blend"])
