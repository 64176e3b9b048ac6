"""A face with its clips as glTF: each clip an animation with its own name, over all shape keys.

What is exported is a copy: the user's objects, actions and NLA tracks stay as they are.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import bpy

from ..errors import SceneError
from .bake import action as actions
from .bake import shape_keys
from .bake.tracks import CLIP_TAG, add_strip
from .blender_types import Action, Key, Object, Scene
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
    SceneError : nothing is baked, the file cannot be written, or this Blender has no glTF exporter.
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
    return Exported(path, tuple(clips))


def clips_of(head: Object) -> dict[str, Action]:
    """Clip name -> action of every clip that is baked on a head."""
    own = actions.own_actions(shape_keys.own_face(head.data))
    return {str(action[CLIP_TAG]): action for action in own}


@contextmanager
def _copies(objects: Sequence[Object], clips: dict[str, Action]) -> Iterator[Scene]:
    """A scene of copies whose shape keys hold each clip on an NLA track of its name; removed on leaving."""
    scene = bpy.data.scenes.new("Risorius Export")
    made: list[Object] = []
    try:
        source = bpy.context.scene
        scene.render.fps, scene.render.fps_base = source.render.fps, source.render.fps_base
        scene.unit_settings.scale_length = source.unit_settings.scale_length
        names = {}
        for obj in objects:
            copy = obj.copy()
            copy.data = obj.data.copy()
            made.append(copy)
            names[copy] = obj.name
            _strip_modifiers(copy)
            _lay_out(copy.data.shape_keys, clips)
            scene.collection.objects.link(copy)
        lengths = [action.frame_range for action in clips.values()]
        scene.frame_start = int(min(start for start, _ in lengths))
        scene.frame_end = int(max(end for _, end in lengths)) + 1
        with _named(names):
            yield scene
    finally:
        bpy.data.scenes.remove(scene)
        for copy in made:
            mesh = copy.data
            bpy.data.objects.remove(copy)
            bpy.data.meshes.remove(mesh)


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
    if keys.animation_data is not None:
        keys.animation_data_clear()
    animation = keys.animation_data_create()
    for name, action in clips.items():
        track = animation.nla_tracks.new()
        track.name = name
        add_strip(track, action)
    for block in keys.key_blocks:
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
