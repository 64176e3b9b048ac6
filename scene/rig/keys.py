"""The shape keys of a face as controls: what each does is measured on the meshes, never guessed from its name."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats
from ...errors import SceneError
from ...progress import Progress, Work, part_of
from ..blender_types import Driver, Key, ShapeKey
from ..faces import FaceSource, Piece
from ..fcurves import SMALL, played_curves
from ..shape_mix import data_path, key_change, own_keys, resting_values
from .bones import DRIVEN
from .channels import Channel, Place
from .driven import Driven, driven_controls
from .rig import Control, Rig
from .sampling import evaluation

#: A slider whose range goes no farther than this from 0 has no room.
ROOM = 0.005
#: Why a key of another object is left alone that something else drives.
ELSEWHERE = "is not driven by the head's key of its name alone: let that drive it, or remove its driver"


def key_rig(source: FaceSource) -> Work[Rig]:
    """The shape keys that the objects of a face have; keys of one name on several objects are one control.

    Keys that are muted, locked or part of the resting face are left alone, and so are Risorius' own. A key that is
    driven by that of its name on the head counts with it; of other keys that are driven, what drives them is a control
    (`driven`).

    Raises
    ------
    SceneError : absolute keys on the head.
    """
    entries: list[Control] = []
    effects: list[Floats] = []
    left_alone = _absolute(source)
    driven: list[tuple[str, Key]] = []
    names = _names(source)
    for number, name in enumerate(names):
        yield Progress(0.5 * number / len(names), f"Measuring {name}")
        first, *others = [(piece, keys.key_blocks[name]) for piece, keys in _keyed(source) if name in keys.key_blocks]
        why = _reason(*first)
        if why == DRIVEN:
            driven.append((name, _datablock(first[0])))
            continue
        if why is not None:
            left_alone[name] = why
            continue
        reasons = [(member, _reason(*member)) for member in others]
        following = [member for member, _ in reasons if _follows(*member, _datablock(first[0]))]
        free = [first, *(member for member, reason in reasons if reason is None)]
        for member, reason in reasons:
            if reason is not None and member not in following:
                left_alone[f"{name} on {member[0].obj.name}"] = ELSEWHERE if reason == DRIVEN else reason
        entries.append(Control(_channel(name, free)))
        effects.append(_effect(source, [*free, *following]))
    found = (yield from part_of(driven_controls(source, driven), 0.5, 1.0)) if driven else Driven()
    driving = {entry.channel.place for entry in found.entries}
    plain = [number for number, entry in enumerate(entries) if entry.channel.place not in driving]
    kept = (*(entries[number] for number in plain), *found.entries)
    every = np.array([*(effects[number] for number in plain), *found.effects])
    evaluate = evaluation(source) if found.entries else None
    left_alone |= found.left_alone
    return Rig(source, kept, every.reshape(-1, *source.vertices.shape), left_alone, evaluate)


def _absolute(source: FaceSource) -> dict[str, str]:
    """Objects with absolute keys, which nobody can mix -> why they are left alone."""
    remedy = "has absolute shape keys: turn on Relative in the Shape Keys panel"
    names = [str(p.obj.name) for p in source.pieces if p.obj.data.shape_keys and not p.obj.data.shape_keys.use_relative]
    if source.head.name in names:
        raise SceneError(source.head.name, remedy)
    return dict.fromkeys(names, remedy)


def _keyed(source: FaceSource) -> list[tuple[Piece, Key]]:
    """The pieces that have relative shape keys."""
    every = [(piece, piece.obj.data.shape_keys) for piece in source.pieces]
    return [(piece, keys) for piece, keys in every if keys is not None and keys.use_relative]


def _names(source: FaceSource) -> list[str]:
    """Names of the user's keys, the head's first, each once."""
    names: dict[str, None] = {}
    for _, keys in _keyed(source):
        own = set(own_keys(keys).names)
        names.update(dict.fromkeys(k.name for k in keys.key_blocks if k != keys.reference_key and k.name not in own))
    return list(names)


def _drivers(piece: Piece, key: ShapeKey) -> list[Driver]:
    """What gives a key its value."""
    animation = _datablock(piece).animation_data
    if animation is None:
        return []
    return [curve.driver for curve in animation.drivers if curve.data_path == data_path(key.name)]


def _follows(piece: Piece, key: ShapeKey, leader: Key) -> bool:
    """Whether a key gets its value from that of its name among other keys, and from nothing else."""
    read = [t for driver in _drivers(piece, key) for variable in driver.variables for t in variable.targets]
    return bool(read) and all(t.id == leader and t.data_path == data_path(key.name) for t in read)


def _reason(piece: Piece, key: ShapeKey) -> str | None:
    """Why a key is left alone; None where it can be used."""
    if _drivers(piece, key):
        return DRIVEN
    if key.mute:
        return "is muted: turn it on in the list of shape keys"
    if getattr(key, "lock_shape", False):
        return "is locked: unlock it in the list of shape keys"
    if is_locked(piece, key):
        return "its F-curve is locked: unlock it in the Graph Editor"
    if abs(resting_values(piece.obj.data).get(key.name, 0.0)) > SMALL:
        return "is part of the resting face: set it to 0 to use it"
    if max(key.slider_max, -key.slider_min) < ROOM:
        return "has no room in its slider's range: raise Range Max"
    return None


def is_locked(piece: Piece, key: ShapeKey) -> bool:
    """Whether the user has locked the F-curve that animates a key."""
    keys = piece.obj.data.shape_keys
    animation = None if keys is None else keys.animation_data
    curves = None if animation is None else played_curves(animation)
    curve = None if curves is None else curves.find(data_path(key.name))
    return curve is not None and curve.lock


def _channel(name: str, members: list[tuple[Piece, ShapeKey]]) -> Channel:
    """The channel of a key, and of those of its name on other objects, within the range that all of them have."""
    places = list(dict.fromkeys(Place(_datablock(piece), data_path(name)) for piece, _ in members))
    low = max(min(key.slider_min, 0.0) for _, key in members)
    high = min(max(key.slider_max, 0.0) for _, key in members)
    return Channel(name, places[0], low, high, twins=tuple(places[1:]))


def _datablock(piece: Piece) -> Key:
    """The shape keys of a piece that has some."""
    keys = piece.obj.data.shape_keys
    assert keys is not None
    return keys


def _effect(source: FaceSource, members: list[tuple[Piece, ShapeKey]]) -> Floats:
    """(V, 3) what keys of one name do to the joined vertices, metres."""
    effect = np.zeros_like(source.vertices)
    for piece, key in members:
        effect[piece.slice] = piece.shown(key_change(piece.obj.data, key))
    return effect
