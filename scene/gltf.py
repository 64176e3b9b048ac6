"""A face with its clips as glTF: each clip an animation with its own name, over all shape keys, on whole frames from 0.

What is exported is a copy: the user's objects, actions and NLA tracks stay as they are. Parents and armatures go with
it, so that the face stands in the file as it stands in the scene; the user's shape keys keep their values and drivers.
"""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np

from ..arrays import Floats
from ..errors import SceneError
from .bake import action as actions
from .bake import shape_keys
from .bake.tracks import CLIP_TAG, add_strip
from .blender_types import Action, Datablock, Key, Object, Scene
from .fcurves import key_curves, shift_keyframes
from .mesh import keys_of
from .pictures.film import refuse_unwritable_output

#: What objects are called that lend their names.
ASIDE = "Risorius Exporting"


@dataclass(frozen=True)
class Exported:
    """A glTF file and the names of the clips in it."""

    path: Path
    clips: tuple[str, ...]


def export_gltf(objects: Sequence[Object], path: str | Path, *, morph_normals: bool = False) -> Exported:
    """Write the objects of a face, the head first, with every clip that is baked on it.

    Parameters
    ----------
    path : the .glb (one file) or .gltf (with .bin and pictures beside it) to write.
    morph_normals : whether morph targets move the normals, too: folds are shaded right, and the file is larger.

    Raises
    ------
    SceneError : nothing is baked, the file cannot be written, this Blender has no glTF exporter, or its exporter left
        out the face or a clip. A file that was there is kept then.
    """
    path = Path(path)
    head = objects[0]
    if not shape_keys.has_own(head):
        raise SceneError(head.name, "has no baked expressions to export: bake one first")
    keys, clips = keys_of(head), clips_of(head)
    with _copies(objects, clips) as scene, _shown(scene) as view, bpy.context.temp_override(**view):
        write_gltf(
            path,
            {name for name in shape_keys.own_names_of(keys) if not keys.key_blocks[name].mute},
            clips,
            use_active_scene=True,
            export_animation_mode="NLA_TRACKS",
            export_anim_slide_to_zero=True,
            export_morph_normal=morph_normals,
        )
    return Exported(path, tuple(clips))


def write_gltf(path: Path, targets: Collection[str], clips: Collection[str] = (), **options: object) -> None:
    """Let Blender export the scene, and put what it wrote in place of what was there once all is in it.

    Parameters
    ----------
    path : the .glb or .gltf to write.
    targets, clips : names of the morph targets and of the animations that must be in it.
    options : of Blender's exporter.

    Raises
    ------
    SceneError : it cannot be written, this Blender has no glTF exporter, or its exporter left something out.
    """
    if not hasattr(bpy.ops.export_scene, "gltf"):
        raise SceneError("glTF", "this Blender's glTF exporter is off: enable the add-on glTF 2.0 format")
    refuse_unwritable_output(path)
    kind = "GLB" if path.suffix.lower() == ".glb" else "GLTF_SEPARATE"
    with tempfile.TemporaryDirectory(prefix="risorius-") as folder:
        made = Path(folder) / path.name
        try:
            bpy.ops.export_scene.gltf(filepath=str(made), export_format=kind, **options)
        except RuntimeError as problem:
            raise SceneError(str(path), f"could not be exported ({str(problem).strip()[-200:]})") from problem
        _refuse_incomplete(made, path, targets, clips)
        for file in sorted(made.parent.rglob("*")):
            if file.is_file():
                place = path.parent / file.relative_to(made.parent)
                place.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file, place)


def _refuse_incomplete(made: Path, path: Path, targets: Collection[str], clips: Collection[str]) -> None:
    """Refuse a file `made` for `path` that holds no mesh, or not every morph target and clip."""
    data = made.read_bytes()
    if data[:4] == b"glTF":
        data = data[20 : 20 + int.from_bytes(data[12:16], "little")]
    document = json.loads(data)
    meshes = document.get("meshes", [])
    if not meshes:
        raise SceneError(str(path), "holds no mesh: Blender's exporter left the face out; export it with File > Export")
    there = {name for mesh in meshes for name in mesh.get("extras", {}).get("targetNames", [])}
    animated = {animation.get("name") for animation in document.get("animations", [])}
    for kind, wanted, found in (("shape keys", targets, there), ("clips", clips, animated)):
        missing = ", ".join(sorted(set(wanted) - found))
        if missing:
            problem = f"lacks the {kind} {missing}: Blender's exporter left them out; export it with File > Export"
            raise SceneError(str(path), problem)


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
        for obj in objects:
            _play_out_drivers(scene, copies[obj], moved)
        scene.frame_start, scene.frame_end = 0, int(max(action.frame_end for action in moved.values()))
        with _named(copies):
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
def _named(copies: dict[Object, Object]) -> Iterator[None]:
    """Lend copies and their meshes the names of what they are copies of, which step aside meanwhile.

    What is of another file keeps its name: a copy in this file may bear the same.
    """
    pairs: list[tuple[Datablock, Datablock]] = list(copies.items())
    pairs += [(obj.data, copy.data) for obj, copy in copies.items() if copy.data != obj.data]
    names = [original.name for original, _ in pairs]
    try:
        for original, _ in pairs:
            _rename(original, ASIDE)
        for (_, copy), name in zip(pairs, names, strict=True):
            copy.name = name
        yield
    finally:
        for _, copy in pairs:
            copy.name = ASIDE
        for (original, _), name in zip(pairs, names, strict=True):
            _rename(original, name)


def _rename(datablock: Datablock, name: str) -> None:
    """Give a datablock of this file another name."""
    if datablock.library is None:
        datablock.name = name


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


def _play_out_drivers(scene: Scene, copy: Object, clips: dict[str, Action]) -> None:
    """Under an armature, give driven keys the values that their drivers give them in each clip, frame by frame.

    There Blender's exporter takes the animation of shape keys from the armature as soon as one key has a driver, and
    leaves our clips out.
    """
    keys, parent = copy.data.shape_keys, copy.parent
    animation = None if keys is None else keys.animation_data
    if keys is None or animation is None or parent is None or parent.type != "ARMATURE" or not animation.drivers:
        return
    driven = [block.name for block in keys.key_blocks if animation.drivers.find(actions.data_path(block.name))]
    played = {}
    for track in animation.nla_tracks:
        track.mute = True
    for track in animation.nla_tracks:
        action = clips[track.name]
        frames = np.arange(int(action.frame_end) + 1, dtype=np.float64)
        track.mute = False
        played[action] = frames, _driven_values(scene, copy, driven, frames)
        track.mute = True
    for track in animation.nla_tracks:
        track.mute = False
    for driver in list(animation.drivers):
        animation.drivers.remove(driver)
    for action, (frames, values) in played.items():
        for name, column in zip(driven, values.T, strict=True):
            actions.write_curve(action, name, actions.Curve(frames, column, linear=True))


def _driven_values(scene: Scene, obj: Object, names: Sequence[str], frames: Floats) -> Floats:
    """(frames, names) values of some shape keys, as they are evaluated."""
    values = np.empty((len(frames), len(names)))
    for row, frame in zip(values, frames, strict=True):
        scene.frame_set(int(frame))
        keys = obj.evaluated_get(scene.view_layers[0].depsgraph).data.shape_keys
        assert keys is not None
        row[:] = [keys.key_blocks[name].value for name in names]
    return values


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
