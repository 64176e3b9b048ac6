"""What a glTF file is made of: copies of a face in a scene of their own, with each clip on an NLA track of its name.

Clips are those of new shape keys, and those on the controls that the character has. The user's objects, actions and NLA
tracks stay as they are. Parents and armatures go with the face, so that it stands in the file as it stands in the
scene; the user's shape keys keep their values and drivers.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace

import bpy
import numpy as np

from ..arrays import Floats
from .bake import action as actions
from .bake import shape_keys
from .bake.tracks import CLIP_TAG, add_strip
from .blender_types import Action, AnimData, Datablock, Key, Object, Scene
from .fcurves import curves_for, curves_of, shift_keyframes
from .rig import layers
from .rig.clips import rig_clips
from .rig.rig_copy import needed_objects, point_to_copies
from .shape_mix import moving_keys
from .traces import clear_traces

#: What objects are called that lend their names.
ASIDE = "Risorius Exporting"


@dataclass(frozen=True, eq=False)
class Clip:
    """One clip of a face: which action each datablock plays, and the names of the shape keys that it moves."""

    actions: dict[Datablock, Action]
    keys: tuple[str, ...] = ()

    @property
    def frames(self) -> tuple[float, float]:
        """First and last frame."""
        spans = [actions.frames_of(action) for action in self.actions.values()]
        return min(first for first, _ in spans), max(last for _, last in spans)


def clips_of(head: Object) -> dict[str, Action]:
    """Clip name -> action of every clip of new shape keys that is baked on a head."""
    own = actions.own_actions(shape_keys.own_face(head.data))
    return {str(action[CLIP_TAG]): action for action in own}


def all_clips(objects: Sequence[Object]) -> dict[str, Clip]:
    """Clip name -> clip of all that is baked on a face; the head comes first.

    A clip on the rig that has the name of one of new shape keys is told apart by its name.
    """
    keyed = [obj.data.shape_keys for obj in objects if obj.type == "MESH" and obj.data.shape_keys is not None]
    found = {name: Clip(dict.fromkeys(keyed, action)) for name, action in clips_of(objects[0]).items()}
    for name, members in sorted(rig_clips(objects[0]).items(), key=lambda clip: clip[1][0].frame_start):
        playing = {owner: action for action in members for owner in layers.players(action)}
        if playing:
            found[name if name not in found else f"{name} on the rig"] = Clip(playing, _keyed_names(playing))
    return found


def silent_clips(head: Object) -> tuple[str, ...]:
    """Names of clips on the rig of a head that nothing plays any more."""
    return tuple(name for name, members in rig_clips(head).items() if not any(map(layers.players, members)))


def _keyed_names(playing: Mapping[Datablock, Action]) -> tuple[str, ...]:
    """Names of the shape keys that actions key."""
    names: dict[str, None] = {}
    for owner, action in playing.items():
        if owner.id_type == "KEY":
            blocks = owner.key_blocks  # type: ignore[attr-defined]
            names |= dict.fromkeys(b.name for b in blocks if curves_of(action, actions.data_path(b.name)))
    return tuple(names)


def is_baked(head: Object | None) -> bool:
    """Whether there is any clip on a face."""
    return head is not None and (shape_keys.has_own(head) or bool(rig_clips(head)))


@contextmanager
def laid_out(objects: Sequence[Object], clips: Mapping[str, Clip]) -> Iterator[Scene]:
    """A scene of copies that hold each clip on an NLA track of its name; removed on leaving.

    What a rig depends on and what is not to be in the file itself is hidden from renders in it.
    """
    scene = bpy.data.scenes.new("Risorius Export")
    copies: dict[Object, Object] = {}
    moved = {name: _from_zero(clip) for name, clip in clips.items()}
    try:
        source = bpy.context.scene
        scene.render.fps, scene.render.fps_base = source.render.fps, source.render.fps_base
        scene.unit_settings.scale_length = source.unit_settings.scale_length
        carried, rigs = [*objects, *_carriers(objects)], _rigs(clips)
        beside = [obj for obj in needed_objects([*objects, *rigs]) if obj not in carried] if rigs else []
        copies |= {obj: obj.copy() for obj in [*carried, *beside]}
        for obj, copy in copies.items():
            scene.collection.objects.link(copy)
            copy.hide_render = obj in beside
            copy.parent = None if copy.parent is None else copies[copy.parent]
            for modifier in copy.modifiers:
                if modifier.type == "ARMATURE" and modifier.object is not None:
                    modifier.object = copies[modifier.object]
        for obj in objects:
            copies[obj].data = obj.data.copy()
            _strip_modifiers(copies[obj])
            _lay_out_keys(obj, copies[obj], moved)
        keyed = [keys for obj in objects if (keys := copies[obj].data.shape_keys) is not None]
        clear_traces(keyed, {name for keys in keyed for name in shape_keys.own_names_of(keys)})
        if rigs:
            _lay_out_rigs(rigs, copies, moved)
        for obj in objects:
            _play_out_drivers(scene, obj, copies, moved)
            _hold_others(obj.data.shape_keys, copies[obj].data.shape_keys, moved)
        scene.frame_start, scene.frame_end = 0, int(max(clip.frames[1] for clip in moved.values()))
        with _named(copies):
            yield scene
    finally:
        bpy.data.scenes.remove(scene)
        meshes = [copy.data for obj, copy in copies.items() if obj in objects and copy.data != obj.data]
        for copy in copies.values():
            bpy.data.objects.remove(copy)
        for mesh in meshes:
            bpy.data.meshes.remove(mesh)
        for action in (action for clip in moved.values() for action in clip.actions.values()):
            bpy.data.actions.remove(action)


def _rigs(clips: Mapping[str, Clip]) -> list[Object]:
    """The objects that clips play on: armatures, as a rule."""
    owners = dict.fromkeys(owner for clip in clips.values() for owner in clip.actions)
    return [owner for owner in owners if isinstance(owner, bpy.types.Object)]


def _from_zero(clip: Clip) -> Clip:
    """A copy of a clip that begins at frame 0 and ends on a whole frame: glTF knows no time before its beginning."""
    start, end = clip.frames
    copies: dict[Datablock, Action] = {}
    for owner, action in clip.actions.items():
        copies[owner] = copy = action.copy()
        for curve in curves_for(copy, owner.id_type):
            shift_keyframes(curve, -start)
        copy.use_frame_range = True
        copy.frame_start, copy.frame_end = 0.0, float(max(np.ceil(end - start - 1e-4), 1.0))
    return replace(clip, actions=copies)


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


def _lay_out_keys(obj: Object, copy: Object, clips: Mapping[str, Clip]) -> None:
    """Put every clip that plays on the shape keys of an object on an NLA track of its copy's own."""
    original, keys = obj.data.shape_keys, copy.data.shape_keys
    if original is None or keys is None:
        return
    animation = keys.animation_data or keys.animation_data_create()
    animation.action = None
    for track in list(animation.nla_tracks):
        animation.nla_tracks.remove(track)
    moving = {*shape_keys.own_names_of(keys), *moving_keys(obj.data)}
    for name, clip in clips.items():
        if original in clip.actions:
            _add_track(animation, name, clip.actions[original], keys.id_type)
            moving |= set(clip.keys)
    for block in keys.key_blocks:
        if block.name in moving:
            block.value = 0.0


def _lay_out_rigs(rigs: Sequence[Object], copies: Mapping[Object, Object], clips: Mapping[str, Clip]) -> None:
    """Let the copies of rigs depend on copies, at rest, with the clips that play on each on NLA tracks of its own."""
    twins: dict[Datablock, Datablock] = dict(copies.items())
    for obj, copy in copies.items():
        if obj.type == "MESH" and obj.data.shape_keys is not None and copy.data.shape_keys is not None:
            twins[obj.data.shape_keys] = copy.data.shape_keys
    for twin in twins.values():
        point_to_copies(twin, twins)
    for obj in rigs:
        animation = copies[obj].animation_data or copies[obj].animation_data_create()
        animation.action = None
        for track in [track for track in animation.nla_tracks if layers.is_own(track)]:
            animation.nla_tracks.remove(track)
        for name, clip in clips.items():
            if obj in clip.actions:
                layers.put_at_rest(copies[obj], clip.actions[obj])
                _add_track(animation, name, clip.actions[obj], obj.id_type)


def _add_track(animation: AnimData, name: str, action: Action, id_type: str) -> None:
    """An NLA track with a clip. The exporter takes a strip that is combined for a part of the track below it."""
    track = animation.nla_tracks.new()
    track.name = name
    add_strip(track, action, id_type)


def _hold_others(original: Key | None, keys: Key | None, clips: Mapping[str, Clip]) -> None:
    """Key the shape keys that a clip does not move at what they are: Blender's exporter takes others for 0 in it."""
    if original is None or keys is None:
        return
    animation = keys.animation_data
    for action in (clip.actions[original] for clip in clips.values() if original in clip.actions):
        for block in keys.key_blocks:
            path = actions.data_path(block.name)
            driven = animation is not None and animation.drivers.find(path) is not None
            if block != keys.reference_key and not block.mute and not driven and not curves_of(action, path):
                still = actions.Curve(np.zeros(1), np.array([block.value]), linear=True)
                actions.write_curve(action, block.name, still)


def _play_out_drivers(scene: Scene, obj: Object, copies: Mapping[Object, Object], clips: Mapping[str, Clip]) -> None:
    """Give driven keys the values that their drivers give them in each clip, frame by frame, where a rig is about.

    Under an armature, Blender's exporter takes the animation of shape keys from the armature as soon as one key has a
    driver, and leaves our clips out. And a clip on a rig may move keys by their drivers alone.
    """
    copy, original = copies[obj], obj.data.shape_keys
    keys, parent = copy.data.shape_keys, copy.parent
    animation = None if keys is None else keys.animation_data
    if original is None or keys is None or animation is None or not animation.drivers:
        return
    if not _rigs(clips) and (parent is None or parent.type != "ARMATURE"):
        return
    driven = [block.name for block in keys.key_blocks if animation.drivers.find(actions.data_path(block.name))]
    played = {}
    for name, clip in clips.items():
        frames = np.arange(int(clip.frames[1]) + 1, dtype=np.float64)
        with _alone(copies, name):
            played[name] = frames, _driven_values(scene, copy, driven, frames)
    for driver in list(animation.drivers):
        animation.drivers.remove(driver)
    for name, (frames, values) in played.items():
        action = clips[name].actions.get(original)
        if action is None:
            action = _new_action(name, clips[name])
            clips[name].actions[original] = action
            _add_track(animation, name, action, keys.id_type)
        for key_name, column in zip(driven, values.T, strict=True):
            actions.write_curve(action, key_name, actions.Curve(frames, column, linear=True))


def _new_action(name: str, clip: Clip) -> Action:
    """An empty action as long as a clip."""
    action: Action = bpy.data.actions.new(name)
    action.use_frame_range = True
    action.frame_start, action.frame_end = clip.frames
    return action


@contextmanager
def _alone(copies: Mapping[Object, Object], name: str) -> Iterator[None]:
    """Let only the NLA tracks of a name play."""
    owners: list[Datablock] = list(copies.values())
    owners += [copy.data.shape_keys for copy in copies.values() if copy.type == "MESH" and copy.data.shape_keys]
    tracks = [track for owner in owners if owner.animation_data for track in owner.animation_data.nla_tracks]
    muted = [track.mute for track in tracks]
    for track in tracks:
        track.mute = track.name != name
    try:
        yield
    finally:
        for track, mute in zip(tracks, muted, strict=True):
            track.mute = mute


def _driven_values(scene: Scene, obj: Object, names: Sequence[str], frames: Floats) -> Floats:
    """(frames, names) values of some shape keys, as they are evaluated."""
    values = np.empty((len(frames), len(names)))
    for row, frame in zip(values, frames, strict=True):
        scene.frame_set(int(frame))
        keys = obj.evaluated_get(scene.view_layers[0].depsgraph).data.shape_keys
        assert keys is not None
        row[:] = [keys.key_blocks[name].value for name in names]
    return values
