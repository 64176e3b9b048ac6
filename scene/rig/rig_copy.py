"""A face with its rig as a copy, in a scene of its own, to move controls on; nothing of the user's is touched.

Copied are the objects of the face, the armatures, lattices and empties that they depend on, and what these depend on in
turn; drivers and constraints are kept and point to the copies. Keyframes are not: what they change is at its default.

Limitations: what a driver reads of scenes, materials and other things that are no objects stays as it is. Modifiers
that smooth or subdivide are left out: what they do to a displacement is small.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager

import bpy
import numpy as np

from ...arrays import Floats
from ..as_read import is_there
from ..blender_types import Datablock, Object, Scene, WithPointers
from ..faces import FaceSource, Piece
from ..fcurves import all_curves, changes
from ..mesh import mesh_vertices, remove_all_keys, world_matrix
from ..passing import passing, passing_scene
from ..posed import MOVING, rigid_motion
from ..shape_mix import resting_values
from .channels import Channel, Place, refusing_what_is_gone
from .turns import keyed_values

NAME = "Risorius Rig Copy"


class RigCopy:
    """The copy of a face and its rig.

    Attributes
    ----------
    copies : what was copied -> its copy.
    unit : (3, 3) from the world's axes and units to the metres of the joined face.
    """

    def __init__(self, source: FaceSource, copies: Mapping[Datablock, Datablock], scene: Scene) -> None:
        self.source, self.copies, self._layer = source, copies, scene.view_layers[0]
        self._objects: list[Object] = [copies[obj] for obj in source.objects]  # type: ignore[misc]
        self._layer.update()
        head = source.pieces[0]
        stretch = head.to_metres[:3, :3] @ np.linalg.inv(world_matrix(self._evaluated(self._objects[0]))[:3, :3])
        shown = self._world()
        turn = rigid_motion(shown[head.slice] @ stretch.T, source.vertices[head.slice])[:3, :3]
        self.unit: Floats = turn @ stretch
        self._rest, self._set = shown, dict[Place, float]()

    def resting(self, place: Place) -> float:
        """A number as it is at rest."""
        return place.read(self.copies[place.owner])

    def has(self, owner: Datablock) -> bool:
        """Whether something belongs to the face or its rig."""
        return owner in self.copies

    def displacement(self, values: Mapping[Channel, float]) -> Floats:
        """(V, 3) metres from rest that the joined face shows with channels at values that count from rest."""
        for place, resting in self._set.items():
            place.write(resting, self.copies[place.owner])
        self._set.clear()
        plain = keyed_values({channel: np.array([value]) for channel, value in values.items()})
        for channel, moved in plain.items():
            with refusing_what_is_gone(self.source.head, channel.name):
                self._move(channel, float(moved[0]))
        self._layer.update()
        return np.asarray((self._world() - self._rest) @ self.unit.T)

    def _move(self, channel: Channel, moved: float) -> None:
        """Put a channel so far from its rest, and note what was there."""
        for place in channel.places:
            copy = self.copies[place.owner]
            self._set[place] = place.read(copy)
            place.write(channel.resting + moved, copy)
            copy.update_tag()

    def _world(self) -> Floats:
        """(V, 3) all vertices of the face in the world, as they show."""
        shown = []
        for obj in self._objects:
            evaluated = self._evaluated(obj)
            matrix = world_matrix(evaluated)
            shown.append(mesh_vertices(evaluated.data) @ matrix[:3, :3].T + matrix[:3, 3])
        return np.concatenate(shown)

    def _evaluated(self, obj: Object) -> Object:
        """An object as it shows."""
        return obj.evaluated_get(self._layer.depsgraph)


@contextmanager
def rig_copy(source: FaceSource) -> Iterator[RigCopy]:
    """The copy of a face and its rig, as long as it is needed.

    Raises
    ------
    SceneError : others have changed the face since it was read.
    """
    source.refuse_changed()
    scene = passing_scene(NAME)
    copies: dict[Datablock, Datablock] = {}
    try:
        for obj in needed_objects(source.objects):
            copies |= _copied(obj)
        for original in list(copies):
            _stop(original, copies[original])
            point_to_copies(copies[original], copies)
        for piece in source.pieces:
            _rest(piece, copies[piece.obj])  # type: ignore[arg-type]
        for original in copies:
            if isinstance(original, bpy.types.Object):
                scene.collection.objects.link(copies[original])  # type: ignore[arg-type]
        scene.frame_set(bpy.context.scene.frame_current)
        yield RigCopy(source, copies, scene)
    finally:
        _remove(copies, scene)


def needed_objects(objects: Iterable[Object]) -> list[Object]:
    """Some objects and all that their place and shape depend on."""
    found: dict[Object, None] = {}
    waiting = list(objects)
    while waiting:
        obj = waiting.pop(0)
        if obj in found:
            continue
        found[obj] = None
        for item in _pointing(obj):
            waiting += [value for _, value in _object_pointers(item)]
        waiting += [] if obj.parent is None else [obj.parent]
        for owner in parts_of(obj):
            waiting += [t for t in driving(owner) if isinstance(t, bpy.types.Object)]
    return list(found)


def parts_of(obj: Object) -> list[Datablock]:
    """An object, its data, and the shape keys of that: what has drivers of its own."""
    parts: list[Datablock] = [obj]
    if obj.type in {"MESH", "ARMATURE", "LATTICE"}:
        parts.append(obj.data)
        keys = getattr(obj.data, "shape_keys", None)
        parts += [] if keys is None else [keys]
    return parts


def driving(owner: Datablock) -> list[Datablock]:
    """What the drivers of something read."""
    animation = owner.animation_data
    if animation is None:
        return []
    targets = [t for d in animation.drivers for v in d.driver.variables for t in v.targets]
    return [target.id for target in targets if target.id is not None]


def _pointing(obj: Object) -> list[WithPointers]:
    """What of an object may point to others: constraints, those of bones, and modifiers that move vertices."""
    holders = [obj, *(obj.pose.bones if obj.pose is not None else ())]
    constraints = [constraint for holder in holders for constraint in holder.constraints]
    targets = [target for constraint in constraints for target in getattr(constraint, "targets", ())]
    modifiers = [modifier for modifier in obj.modifiers if modifier.type in MOVING]
    return [*constraints, *targets, *modifiers]


def _object_pointers(item: WithPointers) -> list[tuple[str, Object]]:
    """Names of properties that point to objects, and those."""
    names = [prop.identifier for prop in item.bl_rna.properties if prop.type == "POINTER" and not prop.is_readonly]
    values = [(name, getattr(item, name, None)) for name in names]
    return [(name, value) for name, value in values if isinstance(value, bpy.types.Object)]


def _copied(obj: Object) -> dict[Datablock, Datablock]:
    """The copy of an object, and of what it is made of."""
    copy = passing(obj.copy())
    copies: dict[Datablock, Datablock] = {obj: copy}
    if obj.type in {"MESH", "ARMATURE", "LATTICE"}:
        copy.data = passing(obj.data.copy())
        copies |= dict(zip(parts_of(obj), parts_of(copy), strict=True))
    return copies


def _stop(original: Datablock, copy: Datablock) -> None:
    """Take the keyframes off a copy; what they change goes back to its default."""
    animation, own = original.animation_data, copy.animation_data
    if animation is None or own is None:
        return
    strips = [strip.action for track in animation.nla_tracks for strip in track.strips]
    actions = [action for action in (animation.action, *strips) if action is not None]
    own.action = None
    for track in list(own.nla_tracks):
        own.nla_tracks.remove(track)
    for curve in (curve for action in actions for curve in all_curves(action) if changes(curve)):
        if curve.data_path.startswith(("pose.bones", "[")):
            place = Place(original, curve.data_path, curve.array_index)
            try:
                place = place if hasattr(copy.path_resolve(place.path), "__len__") else Place(original, place.path)
                place.write(default_of(original, place), copy)
            except (ValueError, KeyError, TypeError):
                continue


def default_of(owner: Datablock, place: Place) -> float:
    """What Blender takes a number for where nothing is animated."""
    if place.is_property:
        holder, name = place.holder(owner)
        return as_number(holder.id_properties_ui(name).as_dict().get("default"), 0.0)
    head, _, name = place.path.rpartition(".")
    described: WithPointers = owner.path_resolve(head) if head else owner  # type: ignore[assignment]
    prop = described.bl_rna.properties[name]
    return float(prop.default_array[place.index] if place.index >= 0 else prop.default)


def as_number(value: object, otherwise: float) -> float:
    """A number, or where it is none, another."""
    return float(value) if isinstance(value, int | float) else otherwise


def point_to_copies(copy: Datablock, copies: Mapping[Datablock, Datablock]) -> None:
    """Let a copy depend on copies."""
    if isinstance(copy, bpy.types.Object):
        for item in _pointing(copy):
            for name, value in _object_pointers(item):
                if value in copies:
                    setattr(item, name, copies[value])
        if copy.parent is not None and copy.parent in copies:
            back = copy.matrix_parent_inverse.copy()
            copy.parent = copies[copy.parent]
            copy.matrix_parent_inverse = back
    drivers = copy.animation_data.drivers if copy.animation_data is not None else ()
    for target in (t for d in drivers for v in d.driver.variables for t in v.targets):
        if target.id is not None and target.id in copies:
            target.id = copies[target.id]


def _rest(piece: Piece, copy: Object) -> None:
    """Make the copy of a piece the resting face: only the user's keys that make it, only modifiers that move it."""
    copy.show_only_shape_key = False
    for modifier in list(copy.modifiers):
        if modifier.type not in MOVING or not modifier.show_viewport:
            copy.modifiers.remove(modifier)
    keys, resting = copy.data.shape_keys, resting_values(piece.obj.data)
    for key in keys.key_blocks if keys is not None else ():
        if key.name not in resting:
            key.value = 0.0


def _remove(copies: Mapping[Datablock, Datablock], scene: Scene) -> None:
    """Take all copies out of the file, and their scene; others may have removed some with what they are copies of."""
    there = [copy for copy in copies.values() if is_there(copy)]
    objects = [copy for copy in there if isinstance(copy, bpy.types.Object)]
    data = [copy for copy in there if isinstance(copy, bpy.types.Mesh | bpy.types.Armature | bpy.types.Lattice)]
    for obj in objects:
        if obj.type == "MESH":
            remove_all_keys(obj)
    bpy.data.batch_remove(objects)
    bpy.data.batch_remove(data)
    if is_there(scene):
        bpy.data.scenes.remove(scene)
