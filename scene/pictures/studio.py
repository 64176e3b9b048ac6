"""A scene of its own to picture a face in: camera, light and render settings that are not the user's.

The user's scene is never changed: the face's objects are linked into a new scene beside a camera and lights, and
the whole is removed afterwards, whatever happens.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path

import bpy

from ...errors import SceneError
from ..as_read import is_there
from ..blender_types import LayerCollection, Object, Scene
from ..creases.marks import unmeasured
from ..passing import passing, passing_scene
from .framing import Framing
from .furniture import Furniture, discard, furnish
from .look import Camera, Look, apply_look


@contextmanager
def studio(objects: Sequence[Object], framing: Framing, look: Look) -> Iterator[Scene]:
    """A temporary scene that shows `objects`, ready to render; removed on leaving with all that was made for it.

    Raises
    ------
    SceneError : the engine is not available, or the scene's own camera is wanted and there is none.
    """
    made: Furniture | None = None
    scene = passing_scene("Risorius Studio")
    try:
        source = bpy.context.scene
        scene.unit_settings.scale_length = source.unit_settings.scale_length
        scene.frame_set(source.frame_current)
        scene.render.fps, scene.render.fps_base = source.render.fps, source.render.fps_base
        if look.camera is Camera.SCENE:
            _borrow(scene, source, look)
        else:
            for obj in objects:
                scene.collection.objects.link(obj)
            made = _passing(furnish(scene, framing, look))
        draws_wrinkles = scene.render.engine != "BLENDER_WORKBENCH"
        with nullcontext() if draws_wrinkles else unmeasured(objects):
            yield scene
    finally:
        if is_there(scene):  # undo takes it away with all that was made for it
            bpy.data.scenes.remove(scene)
            if made is not None:
                discard(made)


def _passing(made: Furniture) -> Furniture:
    """Mark what goes when the picture is done."""
    for obj in (made.camera, *made.lights):
        passing(passing(obj).data)
    passing(made.world)
    return made


def _borrow(scene: Scene, source: Scene, look: Look) -> None:
    """Show all that the user's scene shows, through its own camera."""
    if source.camera is None:
        raise SceneError(source.name, "has no camera: add one (Add > Camera), or set Camera to Portrait")
    for obj in source.collection.objects:
        scene.collection.objects.link(obj)
    for collection in source.collection.children:
        scene.collection.children.link(collection)
    _take_over(bpy.context.view_layer.layer_collection, scene.view_layers[0].layer_collection)
    for marker in source.timeline_markers:  # those that switch cameras
        if marker.camera is not None:
            scene.timeline_markers.new(marker.name, frame=marker.frame).camera = marker.camera
    apply_look(scene, look)
    scene.camera, scene.world = source.camera, source.world
    for name in ("view_transform", "look", "exposure", "gamma"):
        setattr(scene.view_settings, name, getattr(source.view_settings, name))


def _take_over(ours: LayerCollection, theirs: LayerCollection) -> None:
    """Let a view layer leave out what another leaves out."""
    there = {layer.collection.name: layer for layer in ours.children}
    for layer in theirs.children:
        like = there.get(layer.collection.name)
        if like is None:
            continue
        layer.exclude, layer.holdout, layer.indirect_only = like.exclude, like.holdout, like.indirect_only
        _take_over(like, layer)


def render_frame(scene: Scene, frame: int, folder: Path) -> Path:
    """Render one frame of a studio scene to a numbered PNG in `folder`.

    As an animation of one frame: a still is rendered without evaluating shape keys anew in a scene that no window
    shows, and would show the resting face.
    """
    scene.frame_start = scene.frame_end = frame
    scene.render.filepath = str(folder / "####.png")
    path = Path(scene.render.frame_path(frame=frame))
    bpy.ops.render.render(animation=True, scene=scene.name)
    if not path.is_file():
        raise SceneError(str(path), "was not written: choose a folder you may write to")
    return path
