"""The controls of armatures: location, rotation and scale of bones, and custom properties.

A control is what users can see and select. Whether it does anything to the face is measured, never told by its name.
"""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ...errors import SceneError
from ...progress import Progress, Work, part_of
from ..blender_types import Constraint, Datablock, Object, PoseBone, WithProperties
from ..faces import FaceSource, face_steps
from ..fcurves import played_curves
from ..mesh import world_matrix
from .channels import Channel, Form, Place
from .clips import refuse_unkeyable
from .rig import Rig
from .rig_copy import RigCopy, as_number, default_of, needed_objects, rig_copy
from .sampling import Candidate, Kind, evaluation, sampled

AXES = "XYZ"
#: Numbers beyond this stand for no limit.
ENDLESS = 1e6
TURNS_HEAD = "moves the whole head"
HIDDEN = "none that is shown moves the face: show the bone collections of its face controls"
LOCKED = "its F-curve is locked: unlock it in the Graph Editor"
DRIVEN = "is driven"


def bone_rig(source: FaceSource) -> Work[Rig]:
    """The bones and custom properties of the armatures that a face depends on.

    Raises
    ------
    SceneError : there is no armature, or one is linked, in edit mode or showing its rest position.
    """
    yield Progress(0.0, "Looking for bones")
    rigs = [obj for obj in needed_objects(source.objects) if obj.type == "ARMATURE"]
    if not rigs:
        raise SceneError(source.head.name, "has no armature: bind it to one, or bake to New Keys")
    for rig in rigs:
        refuse_unready(rig)
    left: dict[str, str] = {}
    face = yield from part_of(face_steps(source), 0.0, 0.1)
    with rig_copy(source) as copy:
        groups = [group for rig in rigs for group in _groups(copy, rig, face.scale, left, several=len(rigs) > 1)]
        found = yield from part_of(sampled(copy, groups, face.scale), 0.1, 1.0)
    if not found.entries:
        left |= {rig.name: HIDDEN for rig in rigs}
    left |= dict.fromkeys(found.whole, TURNS_HEAD)
    return Rig(source, found.entries, found.effects, left, evaluation(source))


def refuse_unready(rig: Object) -> None:
    """Refuse an armature whose bones cannot be moved now.

    Raises
    ------
    SceneError : names it and the remedy.
    """
    refuse_unkeyable([rig])
    if rig.mode == "EDIT":
        raise SceneError(rig.name, "is in edit mode: leave it first (Tab)")
    if rig.data.pose_position == "REST":
        raise SceneError(rig.name, "shows its rest position: set it to Pose Position (Object Data > Pose)")


def _groups(
    copy: RigCopy, rig: Object, scale: float, left: dict[str, str], *, several: bool
) -> list[tuple[str, Sequence[Candidate]]]:
    """The channels of each bone that is shown, and those of the armature's own properties."""
    assert rig.pose is not None
    name = f"{rig.name}: " if several else ""
    unit = unit_of(copy, rig, scale)
    groups: list[tuple[str, Sequence[Candidate]]] = [(rig.name, _kept(rig, _properties(rig, rig, "", rig.name), left))]
    for bone in (bone for bone in rig.pose.bones if is_shown(bone)):
        path = f'pose.bones["{bpy.utils.escape_identifier(bone.name)}"]'
        title = f"{name}{bone.name}"
        candidates = [*_transforms(copy, rig, bone, title, unit), *_properties(rig, bone, path, title)]
        groups.append((title, _kept(rig, candidates, left)))
    return groups


def unit_of(copy: RigCopy, rig: Object, scale: float) -> float:
    """The unit of an armature's bones in metres of a life-size face."""
    return float(np.cbrt(abs(np.linalg.det(copy.unit @ world_matrix(rig)[:3, :3])))) / scale


def is_shown(bone: PoseBone) -> bool:
    """Whether users can see and select a bone."""
    data = bone.bone
    hidden = bone.hide if hasattr(bone, "hide") else data.hide
    shown = not data.collections or any(group.is_visible_effectively for group in data.collections)
    return shown and not hidden and not data.hide_select


def _kept(rig: Object, candidates: Sequence[Candidate], left: dict[str, str]) -> list[Candidate]:
    """The channels that nothing else decides about; the others are noted."""
    kept = []
    for candidate in candidates:
        why = refusal(rig, candidate.channel.place)
        if why is None:
            kept.append(candidate)
        else:
            left[candidate.channel.name] = why
    return kept


def refusal(owner: Datablock, place: Place) -> str | None:
    """Why a number cannot be keyed; None where it can."""
    animation = owner.animation_data
    if animation is None:
        return None
    index = max(place.index, 0)
    if any(d.data_path == place.path and d.array_index == index for d in animation.drivers):
        return DRIVEN
    curves = played_curves(animation)
    curve = None if curves is None else curves.find(place.path, index=index)
    return LOCKED if curve is not None and curve.lock else None


def _transforms(copy: RigCopy, rig: Object, bone: PoseBone, title: str, unit: float) -> list[Candidate]:
    """The axes of a bone that are not locked; `unit` is an armature's in metres of a life-size face."""
    connected = bone.bone.use_connect and bone.parent is not None
    locks = {Kind.LOCATION: bone.lock_location, Kind.ROTATION: bone.lock_rotation, Kind.SCALE: bone.lock_scale}
    return [
        axis_candidate(copy, rig, bone, kind, axis, title, unit)
        for axis in range(3)
        for kind, locked in locks.items()
        if not locked[axis] and not (connected and kind is Kind.LOCATION)
    ]


def axis_candidate(
    copy: RigCopy, rig: Object, bone: PoseBone, kind: Kind, axis: int, title: str, unit: float
) -> Candidate:
    """A bone's location, turn or scale along one axis, within the limits that its constraints give it."""
    low, high = _limits(bone, f"LIMIT_{kind.name}", axis)
    name = f"{title} {kind.value.title()} {AXES[axis]}"
    whole = f'pose.bones["{bpy.utils.escape_identifier(bone.name)}"].'
    if kind is Kind.ROTATION and bone.rotation_mode in {"QUATERNION", "AXIS_ANGLE"}:
        form = Form[bone.rotation_mode]
        place = Place(rig, f"{whole}{form.value}", axis)
        turn = _resting_turn(copy, place, form)
        channel = Channel(name, place, min(low, 0.0), max(high, 0.0), form=form, turn=turn)
        return Candidate(channel, kind)
    path = "rotation_euler" if kind is Kind.ROTATION else kind.value
    return plain_candidate(copy, name, Place(rig, whole + path, axis), low, high, kind, unit)


def plain_candidate(
    copy: RigCopy, name: str, place: Place, low: float, high: float, kind: Kind, unit: float = 1.0
) -> Candidate:
    """A plain number with its limits, which hold its value at rest."""
    resting = copy.resting(place)
    low, high = min(_finite(low, -np.inf), resting), max(_finite(high, np.inf), resting)
    return Candidate(Channel(name, place, low, high, resting, neutral=default_of(place.owner, place)), kind, unit)


def _resting_turn(copy: RigCopy, place: Place, form: Form) -> tuple[float, float, float, float]:
    """The turn of a bone at rest, as a quaternion."""
    turn = np.array([copy.resting(Place(place.owner, place.path, part)) for part in range(4)])
    if form is Form.AXIS_ANGLE:
        length = float(np.linalg.norm(turn[1:])) or 1.0
        turn = np.append(np.cos(turn[0] / 2.0), np.sin(turn[0] / 2.0) * turn[1:] / length)
    w, x, y, z = (float(part) for part in turn / (float(np.linalg.norm(turn)) or 1.0))
    return w, x, y, z


def _limits(bone: PoseBone, kind: str, axis: int) -> tuple[float, float]:
    """The limits that a bone's constraints give an axis; endless where they give none."""
    low, high = -np.inf, np.inf
    for constraint in bone.constraints:
        if constraint.type == kind and not constraint.mute and constraint.influence > 0.0:
            lower, upper = _bounds(constraint, kind, "xyz"[axis])
            low, high = max(low, lower), min(high, upper)
    return float(low), float(high)


def _bounds(constraint: Constraint, kind: str, axis: str) -> tuple[float, float]:
    """The limits of one constraint, where it is about the bone's own axes."""
    low, high = float(getattr(constraint, f"min_{axis}")), float(getattr(constraint, f"max_{axis}"))
    if constraint.owner_space not in {"LOCAL", "LOCAL_WITH_PARENT"}:
        return -np.inf, np.inf
    if kind == "LIMIT_ROTATION":
        return (low, high) if getattr(constraint, f"use_limit_{axis}") else (-np.inf, np.inf)
    return (
        low if getattr(constraint, f"use_min_{axis}") else -np.inf,
        high if getattr(constraint, f"use_max_{axis}") else np.inf,
    )


def _properties(owner: Datablock, holder: WithProperties, path: str, title: str) -> list[Candidate]:
    """The custom properties of a bone or an object that are numbers."""
    names = [name for name, value in holder.items() if isinstance(value, float) and not name.startswith("risorius")]
    return [property_candidate(owner, holder, path, name, title) for name in names]


def property_candidate(owner: Datablock, holder: WithProperties, path: str, name: str, title: str) -> Candidate:
    """A custom property within the limits of its slider."""
    place = Place(owner, f'{path}["{bpy.utils.escape_identifier(name)}"]')
    look = holder.id_properties_ui(name).as_dict()
    low, high = _finite(look.get("min"), -np.inf), _finite(look.get("max"), np.inf)
    soft_low, soft_high = _finite(look.get("soft_min"), -np.inf), _finite(look.get("soft_max"), np.inf)
    resting = float(holder[name])  # type: ignore[arg-type]
    low, high = min(max(low, soft_low), resting), max(min(high, soft_high), resting)
    channel = Channel(f"{title} {name}", place, low, high, resting, neutral=as_number(look.get("default"), 0.0))
    return Candidate(channel, Kind.PROPERTY)


def _finite(value: object, otherwise: float) -> float:
    """A limit, or where there is none, another."""
    return float(value) if isinstance(value, int | float) and abs(value) < ENDLESS else otherwise
