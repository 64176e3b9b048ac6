"""Films of a face: PNG frames, then an MP4 by Blender's own encoder."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import bpy

from ...errors import SceneError
from ...files import scratch_folder
from ...progress import Progress, Work, part_of
from ..blender_types import Object, Scene
from ..sounds import add_sound
from .following import FollowingCamera
from .framing import framing_of
from .look import Camera, Look, unstamp, usable_engine
from .seen import look_ahead, refuse_hidden
from .studio import render_frame, studio

#: Looks at a studio's scene at a frame that has been rendered.
Watch: TypeAlias = Callable[[Scene, int], None]
#: The share of looking at the frames before they are rendered.
LOOKING = 0.05


@dataclass(frozen=True)
class FilmResult:
    """A rendered film: the MP4 where one was asked for, its number of frames, the PNG folder where kept, remarks."""

    path: Path | None
    frame_count: int
    frames: Path | None = None
    remarks: tuple[str, ...] = ()


def refuse_unwritable_output(path: Path) -> None:
    """Refuse an output file that cannot be written, before anything is rendered; missing folders are made.

    Raises
    ------
    SceneError : names the path and the remedy.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.is_dir():
            raise IsADirectoryError(21, "is a folder")
        with tempfile.NamedTemporaryFile(dir=path.parent, prefix=".risorius-"):
            pass
        if path.exists():
            with path.open("r+b"):
                pass
    except OSError as problem:
        raise SceneError(
            str(path), f"cannot be written ({problem.strerror or problem}): choose a folder you may write to"
        ) from problem


def render_film(
    objects: Sequence[Object],
    path: str | Path | None,
    *,
    start: int,
    end: int,
    look: Look | None = None,
    frames: str | Path | None = None,
    sound: str | Path | None = None,
    watch: Watch | None = None,
) -> Work[FilmResult]:
    """Render the face of ``objects[0]``, well framed and lit, as an MP4; the portrait camera goes where the face goes.

    Parameters
    ----------
    objects : the face's objects, the head first.
    path : the MP4 to write; an older one is replaced only once the new one is complete. None: pictures only.
    start, end : first and last frame of the timeline.
    frames : a folder to keep the PNG frames in; by default they are thrown away.
    sound : a sound file that begins with the first frame.
    watch : called with the studio's scene and each frame once that is rendered.

    Raises
    ------
    SceneError : an output that cannot be written, no frames, a face that renders do not show, or an engine that is not
        there.
    """
    look = look or Look()
    film = Path(path) if path is not None else None
    kept = Path(frames) if frames is not None else None
    if film is None and kept is None:
        raise SceneError("Video", "neither video nor images are to be written: choose one of them")
    if end < start:
        raise SceneError("Video", f"has no frames: its end {end} is before its start {start}")
    for output in (film, kept / "0001.png" if kept is not None else None):
        if output is not None:
            refuse_unwritable_output(output)
    _, remark = usable_engine(look.engine)
    with scratch_folder() as temporary:
        folder = kept if kept is not None else temporary
        pictures, said = yield from render_frames(objects, folder, start=start, end=end, look=look, watch=watch)
        if film is not None:
            yield Progress(0.95, "Encoding the video")
            shutil.copyfile(encode(pictures, temporary / "film.mp4", look=look, sound=sound), film)
    return FilmResult(film, len(pictures), kept, ((remark,) if remark else ()) + said)


def render_frames(
    objects: Sequence[Object], folder: Path, *, start: int, end: int, look: Look, watch: Watch | None = None
) -> Work[tuple[list[Path], tuple[str, ...]]]:
    """Render frames `start` to `end` as numbered PNGs into `folder`; also returns remarks on what they do not show."""
    pictures = []
    count, is_portrait = end - start + 1, look.camera is Camera.FACE
    framing = framing_of(objects[0])
    with studio(objects, framing, look) as scene:
        said = refuse_hidden(objects, scene)
        ahead = look_ahead(objects[0], scene, start, end, camera=not is_portrait)
        said += yield from part_of(ahead, 0.0, LOOKING)
        yield Progress(LOOKING, "; ".join(said) or "Rendering")
        camera = FollowingCamera(scene, objects[0], framing) if is_portrait else None
        for index, frame in enumerate(range(start, end + 1)):
            if camera is not None:
                camera.go_to(frame)
            pictures.append(render_frame(scene, frame, folder))
            if watch is not None:
                watch(scene, frame)
            done = LOOKING + (0.95 - LOOKING) * (index + 1) / count
            yield Progress(done, f"Rendering frame {index + 1} of {count}")
    return pictures, said


def encode(
    pictures: Sequence[Path],
    path: Path,
    *,
    look: Look,
    fps: tuple[int, float] | None = None,
    sound: str | Path | None = None,
) -> Path:
    """Encode numbered pictures of one folder, and a sound, as an H.264 MP4 with Blender's sequencer.

    Raises
    ------
    SceneError : this Blender wrote no film.
    """
    source = bpy.context.scene.render
    rate = fps or (source.fps, source.fps_base)
    scene = bpy.data.scenes.new("Risorius Encoder")
    try:
        _sequence(scene, pictures)
        render = scene.render
        if sound is not None:
            add_sound(scene, sound, frame=1)
            render.ffmpeg.audio_codec = "AAC"
        unstamp(render)
        render.fps, render.fps_base = rate
        render.resolution_x, render.resolution_y, render.resolution_percentage = look.width, look.height, 100
        scene.view_settings.view_transform = "Standard"
        settings = render.image_settings
        if hasattr(settings, "media_type"):
            settings.media_type = "VIDEO"
        settings.file_format = "FFMPEG"
        render.ffmpeg.format, render.ffmpeg.codec = "MPEG4", "H264"
        render.ffmpeg.constant_rate_factor, render.ffmpeg.ffmpeg_preset = "HIGH", "GOOD"
        render.use_sequencer, render.use_compositing, render.use_file_extension = True, False, False
        render.filepath = str(path)
        bpy.ops.render.render(animation=True, scene=scene.name)
    finally:
        bpy.data.scenes.remove(scene)
    if not path.is_file() or path.stat().st_size == 0:
        raise SceneError(str(path), "no video was encoded: this Blender may lack FFmpeg; write images instead")
    return path


def _sequence(scene: Scene, pictures: Sequence[Path]) -> None:
    """Put the pictures on the scene's timeline as one strip, which grows with every picture."""
    editor = scene.sequence_editor_create()
    strips = editor.strips if hasattr(editor, "strips") else editor.sequences
    strip = strips.new_image("Film", str(pictures[0]), 1, 1)
    for picture in pictures[1:]:
        strip.elements.append(picture.name)
    scene.frame_start, scene.frame_end = 1, len(pictures)
