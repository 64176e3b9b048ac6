"""A face with its clips as glTF: each clip an animation with its own name, over all shape keys, on whole frames from 0.

What is exported is a copy: the user's objects, actions and NLA tracks stay as they are. Parents and armatures go with
it, so that the face stands in the file as it stands in the scene; the user's shape keys keep their values and drivers.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np

from ..errors import SceneError
from .bake import action as actions
from .bake import shape_keys
from .bake.tracks import CLIP_TAG, add_strip
from .blender_types import Action, Key, Object, Scene
from .fcurves import key_curves, shift_keyframes
from .pictures.film import refuse_unwritable_output


@dataclass(frozen=True)
class Exported:
    """A glTF file and the names of the clips in it."""

    path: Path
    clips: tuple[str, ...]


def export_gltf(objects: Sequence[Object], path: str | Path) -> Exported:
    """Write the objects of a face, the head first, with every clip that is baked on it.

    Parameters
    ----------
    path : the .glb (one file) or .gltf (with .bin and pictures beside it) to write.

    Raises
    ------
    SceneError : nothing is baked, the file cannot be written, this Blender has no glTF exporter, or its exporter left
        out the face or a clip.
    """
    path = Path(path)
    head = objects[0]
    if not shape_keys.has_own(head):
        raise SceneError(head.name, "has no baked expressions to export: bake one first")
    if not hasattr(bpy.ops.export_scene, "gltf"):
        raise SceneError("glTF", "this Blender's glTF exporter is off: enable the add-on glTF 2.0 format")
    refuse_unwritable_output(path)
    clips = clips_of(head)
    with _copies(objects, clips) as scene, _shown(scene) as view:
        try:
            with bpy.context.temp_override(**view):
                bpy.ops.export_scene.gltf(
                    filepath=str(path),
                    export_format="GLB" if path.suffix.lower() == ".glb" else "GLTF_SEPARATE",
                    use_active_scene=True,
                    export_animation_mode="NLA_TRACKS",
                    export_anim_slide_to_zero=True,
                    export_morph_normal=False,
                )
        except RuntimeError as problem:
            raise SceneError(str(path), f"could not be exported ({str(problem).strip()[-200:]})") from problem
    _refuse_incomplete(path, clips)
    return Exported(path, tuple(clips))


def _refuse_incomplete(path: Path, clips: dict[str, Action]) -> None:
    """Refuse a file that holds no mesh, or not every clip."""
    data = path.read_bytes()
    if data[:4] == b"glTF":
        data = data[20 : 20 + int.from_bytes(data[12:16], "little")]
    document = json.loads(data)
    missing = sorted(set(clips) - {animation.get("name") for animation in document.get("animations", [])})
    if not document.get("meshes"):
        raise SceneError(str(path), "holds no mesh: Blender's exporter left the face out; export it with File > Export")
    if missing:
        raise SceneError(str(path), f"lacks the clips {', '.join(missing)}: Blender's exporter left them out")


def clips_of(head: Object) -> dict[str, Action]:
    """Clip name -> action of every clip that is baked on a head."""
    own = actions.own_actions(shape_keys.own_face(head.data))
    return {str(action[CLIP_TAG]): action for action in own}


@contextmanager
def _copies(objects: Sequence[Object], clips: dict[str, Action]) -> Iterator[Scene]:
    """A scene of copies whose shape keys hold each clip on an NLA track of its name; removed on leaving."""
    scene = bpy.data.scenes.new("Risorius Export")
    copies: dict[Object, Object] = {}
    moved = {name: _from_zero(action) for name, action in clips.items()}
    try:
        source = bpy.context.scene
        scene.render.fps, scene.render.fps_base = source.render.fps, source.render.fps_base
        scene.unit_settings.scale_length = source.unit_settings.scale_length
        copies |= {obj: obj.copy() for obj in [*objects, *_carriers(objects)]}
        for copy in copies.values():
            scene.collection.objects.link(copy)
            copy.parent = None if copy.parent is None else copies[copy.parent]
            for modifier in copy.modifiers:
                if modifier.type == "ARMATURE" and modifier.object is not None:
                    modifier.object = copies[modifier.object]
        for obj in objects:
            copies[obj].data = obj.data.copy()
            _strip_modifiers(copies[obj])
            _lay_out(copies[obj].data.shape_keys, moved)
        names = {copy: obj.name for obj, copy in copies.items()}
        scene.frame_start, scene.frame_end = 0, int(max(action.frame_end for action in moved.values()))
        with _named(names):
            yield scene
    finally:
        bpy.data.scenes.remove(scene)
        meshes = [copy.data for obj, copy in copies.items() if obj in objects and copy.data != obj.data]
        for copy in copies.values():
            bpy.data.objects.remove(copy)
        for mesh in meshes:
            bpy.data.meshes.remove(mesh)
        for action in moved.values():
            bpy.data.actions.remove(action)


def _from_zero(action: Action) -> Action:
    """A copy of a clip that begins at frame 0 and ends on a whole frame: glTF knows no time before its beginning."""
    copy = action.copy()
    start, end = actions.frames_of(action)
    for curve in key_curves(copy):
        shift_keyframes(curve, -start)
    copy.use_frame_range = True
    copy.frame_start, copy.frame_end = 0.0, float(max(np.ceil(end - start - 1e-4), 1.0))
    return copy


def _carriers(objects: Sequence[Object]) -> list[Object]:
    """What carries some objects: their parents and armatures, and what carries those."""
    found: list[Object] = []
    waiting = list(objects)
    while waiting:
        obj = waiting.pop()
        rigs = [modifier.object for modifier in obj.modifiers if modifier.type == "ARMATURE"]
        new = [other for other in dict.fromkeys((obj.parent, *rigs)) if other is not None]
        new = [other for other in new if other not in found and other not in objects]
        found += new
        waiting += new
    return found


@contextmanager
def _named(names: dict[Object, str]) -> Iterator[None]:
    """Lend copies the names of what they are copies of, which step aside meanwhile."""
    originals = {copy: bpy.data.objects[name] for copy, name in names.items()}
    try:
        for copy, name in names.items():
            originals[copy].name = f"{name} (exporting)"
            copy.name = name
        yield
    finally:
        for copy, name in names.items():
            copy.name = f"{name} (copy)"
            originals[copy].name = name


def _strip_modifiers(copy: Object) -> None:
    """Only armatures go with morph targets; others would change the vertices that these move."""
    for modifier in [modifier for modifier in copy.modifiers if modifier.type != "ARMATURE"]:
        copy.modifiers.remove(modifier)


def _lay_out(keys: Key | None, clips: dict[str, Action]) -> None:
    """Put every clip on an NLA track of its own name."""
    if keys is None:
        return
    animation = keys.animation_data or keys.animation_data_create()
    animation.action = None
    for track in list(animation.nla_tracks):
        animation.nla_tracks.remove(track)
    for name, action in clips.items():
        track = animation.nla_tracks.new()
        track.name = name
        add_strip(track, action)
    own = shape_keys.own_names_of(keys)
    for block in keys.key_blocks:
        if block.name in own:
            block.value = 0.0


@contextmanager
def _shown(scene: Scene) -> Iterator[dict[str, object]]:
    """What to override so that operators see `scene`: the exporter asks the window, where there is one."""
    window = bpy.context.window
    if window is None:
        yield {"scene": scene, "view_layer": scene.view_layers[0]}
        return
    before = window.scene
    window.scene = scene
    try:
        yield {"window": window, "scene": scene, "view_layer": scene.view_layers[0]}
    finally:
        window.scene = before
