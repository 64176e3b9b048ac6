"""Shape keys with drivers: what is keyed is what drives them, never the key, whose value a driver would overwrite.

That is a custom property, a channel of a bone or an object, or any other number of the face and its rig. Where this is
driven itself, what drives it is keyed. What keying it does to the face is measured through the drivers.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

import bpy
import numpy as np

from ...arrays import Floats
from ...progress import Work, part_of
from ..blender_types import Datablock, DriverCurve, DriverTarget, DriverVariable, Key, Object, ShapeKey
from ..faces import FaceSource, face_steps
from ..shape_mix import data_path
from .bones import AXES, LOCKED, axis_candidate, plain_candidate, property_candidate, refusal, unit_of
from .channels import Place
from .rig import Control
from .rig_copy import RigCopy, rig_copy
from .sampling import Candidate, Kind, sampled

#: What a driver's variable of kind TRANSFORMS reads, by the first part of its name.
TRANSFORMS = {"LOC": Kind.LOCATION, "ROT": Kind.ROTATION, "SCALE": Kind.SCALE}
ATTRIBUTES = {
    "location": Kind.LOCATION,
    "rotation_euler": Kind.ROTATION,
    "rotation_quaternion": Kind.ROTATION,
    "rotation_axis_angle": Kind.ROTATION,
    "scale": Kind.SCALE,
}
#: So many drivers are followed, one driven by the next.
DEEP = 6


@dataclass(frozen=True, eq=False)
class Driven:
    """The controls that drive shape keys, what each does (K, V, 3), and the keys that nothing can be keyed for."""

    entries: tuple[Control, ...] = ()
    effects: Sequence[Floats] = ()
    left_alone: dict[str, str] = field(default_factory=dict)


def driver_of(owner: Datablock, path: str, index: int = 0) -> DriverCurve | None:
    """What drives a number."""
    animation = owner.animation_data
    drivers = animation.drivers if animation is not None else ()
    return next((d for d in drivers if d.data_path == path and d.array_index == index), None)


def driven_controls(source: FaceSource, keys: Sequence[tuple[str, Key]]) -> Work[Driven]:
    """The controls that drive shape keys, each given by its name and the datablock that it is in."""
    left: dict[str, str] = {}
    behind: dict[str, list[Candidate]] = {}
    face = yield from part_of(face_steps(source), 0.0, 0.1)
    scale = face.scale
    with rig_copy(source) as copy:
        follow = _Follow(copy, scale)
        for name, owner in keys:
            found = follow.behind(owner, data_path(name), 0)
            if isinstance(found, str):
                left[name] = found
            else:
                behind[name] = found
        every = {each.channel.place: each for found in behind.values() for each in found}
        result = yield from part_of(
            sampled(copy, [(each.channel.name, [each]) for each in every.values()], scale), 0.1, 1.0
        )
    moving = {entry.channel.place for entry in result.entries}
    for name, found in behind.items():
        if not any(each.channel.place in moving for each in found):
            read = found[0].channel.name
            left[name] = f"is driven; its driver reads {read}, which does not move the face within its limits"
    return Driven(result.entries, tuple(result.effects), left)


class _Follow:
    """Follows drivers to what can be keyed."""

    def __init__(self, copy: RigCopy, scale: float) -> None:
        self._copy, self._scale = copy, scale

    def behind(self, owner: Datablock, path: str, index: int, depth: int = 0) -> list[Candidate] | str:
        """What is to be keyed for a driven number, or why nothing can be."""
        curve = driver_of(owner, path, index)
        assert curve is not None
        if depth > DEEP:
            return "is driven; its drivers are driven in a circle: give it a driver that reads a property"
        read = [self._read(variable, depth) for variable in curve.driver.variables]
        found = [each for candidates in read if not isinstance(candidates, str) for each in candidates]
        if found and not curve.driver.is_valid:
            return "is driven; its driver shows an error: mend it (Drivers editor, Update Dependencies)"
        refused = [why for why in read if isinstance(why, str)]
        nothing = "is driven; its driver reads nothing that can be keyed: let it read a property of an object or a bone"
        return found or next(iter(refused), nothing)

    def _read(self, variable: DriverVariable, depth: int) -> list[Candidate] | str:
        """What is to be keyed for a variable of a driver."""
        target = variable.targets[0]
        if variable.type == "CONTEXT_PROP" or target.id is None:
            return "is driven; its driver reads the scene: let it read a property of an object or a bone"
        if not self._copy.has(target.id):
            return f"is driven; its driver reads {target.id.name}: let it read a property of an object or a bone"
        found = [self._candidate(target.id, *spot) for spot in _spots(variable, target)]
        refused = ""
        usable: list[Candidate] = []
        for each in (each for each in found if each is not None):
            place = each.channel.place
            why = refusal(place.owner, place)
            if why is None:
                usable.append(each)
            elif why == LOCKED:
                refused = f"is driven; its driver reads {each.channel.name}: {why}"
            else:
                deeper = self.behind(place.owner, place.path, max(place.index, 0), depth + 1)
                if isinstance(deeper, str):
                    refused = deeper
                else:
                    usable += deeper
        return usable or refused or f"is driven; its driver reads {target.id.name}, where nothing can be keyed for it"

    def _candidate(self, owner: Datablock, path: str, index: int) -> Candidate | None:
        """A number as a channel; None where it is none."""
        if path.startswith(("data.", "data[")) and isinstance(owner, bpy.types.Object):
            owner, path = owner.data, path.removeprefix("data").removeprefix(".")
        place = Place(owner, path, index)
        try:
            holder, name = place.holder(owner)
            place.read(owner)
        except (ValueError, KeyError, AttributeError, TypeError, IndexError):
            return None
        if place.is_property:
            title = getattr(holder, "name", owner.name)
            return property_candidate(owner, holder, path[: path.rindex('["')], name, title)
        if isinstance(holder, bpy.types.PoseBone) and name in ATTRIBUTES:
            unit = unit_of(self._copy, owner, self._scale)  # type: ignore[arg-type]
            return axis_candidate(self._copy, owner, holder, ATTRIBUTES[name], _axis(name, index), holder.name, unit)  # type: ignore[arg-type]
        if isinstance(holder, bpy.types.Object) and name in ATTRIBUTES:
            kind, unit = ATTRIBUTES[name], float(np.cbrt(abs(np.linalg.det(self._copy.unit)))) / self._scale
            title = f"{owner.name} {kind.value.title()} {AXES[_axis(name, index)]}"
            return plain_candidate(self._copy, title, place, -np.inf, np.inf, kind, unit)
        return self._number(owner, holder, place, name)

    def _number(self, owner: Datablock, holder: object, place: Place, name: str) -> Candidate:
        """Any other number, within what Blender's slider for it allows."""
        if isinstance(holder, bpy.types.ShapeKey):
            key: ShapeKey = holder
            return plain_candidate(
                self._copy, key.name, place, min(key.slider_min, 0.0), max(key.slider_max, 0.0), Kind.PROPERTY
            )
        prop = holder.bl_rna.properties[name]  # type: ignore[attr-defined]
        title = f"{getattr(holder, 'name', owner.name)} {prop.name}"
        return plain_candidate(self._copy, title, place, float(prop.soft_min), float(prop.soft_max), Kind.PROPERTY)


def _axis(name: str, index: int) -> int:
    """The axis of a part of a transform; turns that are kept as four numbers begin with what has none."""
    return max(index - 1, 0) if name in ("rotation_quaternion", "rotation_axis_angle") else max(index, 0)


def _spots(variable: DriverVariable, target: DriverTarget) -> list[tuple[str, int]]:
    """Paths and indices of the numbers that a variable reads of its first target."""
    if variable.type == "SINGLE_PROP":
        return [_parsed(target.data_path)]
    obj: Object = target.id  # type: ignore[assignment]
    bone = obj.pose.bones.get(target.bone_target) if obj.pose is not None and target.bone_target else None
    whole = "" if bone is None else f'pose.bones["{bpy.utils.escape_identifier(bone.name)}"].'
    mode = obj.rotation_mode if bone is None else bone.rotation_mode
    turn = {"QUATERNION": "rotation_quaternion", "AXIS_ANGLE": "rotation_axis_angle"}.get(mode, "rotation_euler")
    if variable.type == "TRANSFORMS":
        kind, _, axis = target.transform_type.partition("_")
    else:
        kind, axis = ("LOC", "") if variable.type == "LOC_DIFF" else ("ROT", "")
    name = {"LOC": "location", "ROT": turn, "SCALE": "scale"}[kind]
    first = 0 if len(turn) == len("rotation_euler") or kind != "ROT" else 1
    axes = [AXES.index(axis)] if axis in tuple(AXES) else range(3)
    return [(f"{whole}{name}", first + each) for each in axes]


def _parsed(path: str) -> tuple[str, int]:
    """A path as drivers spell it, as path and index."""
    numbered = re.fullmatch(r"(.*)\[(\d+)\]", path)
    if numbered:
        return numbered[1], int(numbered[2])
    lettered = re.fullmatch(r"(.*)\.([xyz])", path)
    if lettered:
        return lettered[1], "xyz".index(lettered[2])
    return path, -1
