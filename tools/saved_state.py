"""What Risorius left in a Blender file, as plain values: asked of a file that any version saved, by any version.

Nothing of Risorius is imported, so that an earlier version can ask this, too.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import bpy
import numpy as np

#: Decimals of what is compared: single precision, of values of about one.
DECIMALS = 5


def saved_state() -> dict[str, Any]:
    """Of the open file: every mesh with its shape keys, what plays on it and its settings, and every action."""
    return {
        "objects": {obj.name: object_state(obj) for obj in bpy.data.objects if obj.type == "MESH"},
        "actions": {action.name: action_state(action) for action in bpy.data.actions},
        "scene": settings(bpy.context.scene.risorius),
        "materials": sorted(material.name for material in bpy.data.materials),
        "sounds": sorted(sound.name for sound in bpy.data.sounds),
    }


def object_state(obj: Any) -> dict[str, Any]:
    """One mesh."""
    keys = obj.data.shape_keys
    return {
        "keys": {block.name: moved(keys, block) for block in keys.key_blocks} if keys else {},
        "played": {} if keys is None else played(keys.animation_data),
        "settings": settings(obj.risorius),
        "groups": [group.name for group in obj.vertex_groups],
        "materials": [material and material.name for material in obj.data.materials],
        "own": sorted(name for name in obj.keys() if not name.startswith("risorius")),  # noqa: SIM118
        "vertices": len(obj.data.vertices),
        "points": str(obj.data.get("risorius_points", ""))[:1],
    }


def moved(keys: Any, block: Any) -> list[float]:
    """How far a shape key moves the mesh, in millimetres: in all, and at most."""
    places = np.zeros((2, 3 * len(block.data)))
    keys.reference_key.data.foreach_get("co", places[0])
    block.data.foreach_get("co", places[1])
    ways = 1000.0 * np.abs(places[1] - places[0])
    return [round(float(ways.sum()), 1), round(float(ways.max()), 3)]


def played(animation: Any) -> dict[str, Any]:
    """What plays on shape keys."""
    if animation is None:
        return {}
    tracks = [
        [track.name, track.mute, [[s.name, s.action.name, s.frame_start, s.frame_end] for s in track.strips]]
        for track in animation.nla_tracks
    ]
    return {"action": animation.action.name if animation.action else None, "tracks": tracks}


def action_state(action: Any) -> dict[str, Any]:
    """An action: its frames and markers, and each curve's value at five frames."""
    start, end = action.frame_range
    frames = np.linspace(start, end, 5)
    return {
        "frames": [start, end],
        "markers": [[marker.name, marker.frame] for marker in action.pose_markers],
        "curves": {
            f"{curve.data_path}[{curve.array_index}]": [round(curve.evaluate(frame), DECIMALS) for frame in frames]
            for curve in curves(action)
        },
    }


def curves(action: Any) -> Iterator[Any]:
    """The curves of an action, in every Blender."""
    if hasattr(action, "fcurves"):
        yield from action.fcurves
        return
    for layer in action.layers:
        for strip in layer.strips:
            for bag in strip.channelbags:
                yield from bag.fcurves


def settings(group: Any) -> dict[str, Any]:
    """The settings of a group, those of the groups in it and of lists, as plain values."""
    found: dict[str, Any] = {}
    for prop in group.bl_rna.properties:
        if prop.identifier == "rna_type":
            continue
        value = getattr(group, prop.identifier)
        if prop.type == "COLLECTION":
            found[prop.identifier] = [settings(item) for item in value]
        elif isinstance(value, bpy.types.ID):
            found[prop.identifier] = value.name
        elif prop.type == "POINTER":
            found[prop.identifier] = None if value is None else settings(value)
        elif getattr(prop, "is_array", False):
            found[prop.identifier] = [round(float(number), DECIMALS) for number in value]
        else:
            found[prop.identifier] = _plain(value)
    return found


def _plain(value: Any) -> Any:
    """A value as JSON has it."""
    if isinstance(value, float):
        return round(value, DECIMALS)
    return sorted(value) if isinstance(value, set) else value
