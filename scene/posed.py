"""A face that a rig has brought into another shape, and the way back to where shape keys act.

Blender applies shape keys before an armature. A head that a rig only carries keeps its shape: it is posed as if the rig
rested, and the rig carries what is baked. Where bones or a lattice change the shape of the face itself (proportions, a
jaw, lids), the face is posed as it shows, in the place of the head that does not turn, and every displacement goes back
through what the modifiers do about each vertex. A rig with an animation that changes is a motion and no form.

Limitations: the way back is exact for armatures, and right for small displacements for other modifiers. Modifiers that
smooth or subdivide are left out: what they do to a displacement is small.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from hashlib import blake2b
from typing import Protocol

import bpy
import numpy as np

from ..arrays import Floats, Ints
from ..errors import SceneError
from .attributes import read_floats, write_floats
from .blender_types import Action, Modifier, Object
from .fcurves import bone_curves, changes
from .mesh import mesh_vertices, relative_matrix, remove_all_keys, rest_vertices
from .points.kept import has_points, read_kept

#: Modifiers that move each vertex by itself.
MOVING = {"ARMATURE", "LATTICE", "SIMPLE_DEFORM", "CAST", "CURVE", "MESH_DEFORM", "SURFACE_DEFORM", "HOOK", "WARP"}
#: Points that eyeballs turn, and groups of points inside the mouth: they do not tell the shape of a face.
TURNING, INSIDE = ("3.5", "3.6"), ("6.",)
#: Corners of the eyes, bridge of the nose and ears tell where the head is; at least so many vertices of theirs.
STEADY = ("3.7", "3.8", "3.11", "3.12", "9.12", "10.7", "10.8", "10.9", "10.10")
LEAST = 4
#: A face whose shape changes by less than this share of its size keeps it.
SAME = 1e-3
#: A step by which it is found what modifiers do about a vertex, as a share of the mesh's size.
STEP = 1e-2
#: Less than this is left of a volume that modifiers have flattened.
FLAT = 1e-6
#: So many states of objects are kept: every redraw and every sketch asks.
KEPT = 12
_kept: OrderedDict[bytes, tuple[Floats, Floats] | None] = OrderedDict()


@dataclass(frozen=True, eq=False)
class Posed:
    """A mesh as its rig shows it, its head turned back.

    Attributes
    ----------
    positions : (V, 3) in the mesh's own coordinates.
    slopes : (V, 3, 3) how a vertex moves there when it moves before the modifiers.
    """

    positions: Floats
    slopes: Floats

    def back(self, displacement: Floats, name: str) -> Floats:
        """(V, 3) displacement before the modifiers that shows as a given one.

        Raises
        ------
        SceneError : a vertex that is to move has been flattened by the modifiers.
        """
        flat = np.abs(np.linalg.det(self.slopes)) < FLAT
        moving = flat & (np.abs(displacement).max(axis=1) > FLAT * float(np.ptp(self.positions)))
        if moving.any():
            problem = f"its rig flattens {moving.sum()} vertices of the face to nothing: clear its scale (Alt S)"
            raise SceneError(name, problem)
        slopes = np.where(flat[:, None, None], np.eye(3), self.slopes)
        return np.asarray(np.linalg.solve(slopes, displacement[..., None])[..., 0])


class NotKnownYet(LookupError):
    """A rig has moved, and what it does now has not been looked at."""


def posed(objects: Sequence[Object], rests: Sequence[Floats], *, look: bool = True) -> list[Posed] | None:
    """The objects of a face as their rigs show them, the head first; None where these keep the shape of the face.

    Parameters
    ----------
    rests : (V, 3) of each, before modifiers.
    look : False: only what is known already counts. Blender's events must not wait for another look.

    Raises
    ------
    NotKnownYet : without `look`.
    """
    face, steady = _anchors(objects[0])
    head = _shown(objects[0], rests[0], look=look) if len(steady) >= LEAST else None
    if head is None:
        return None
    motion = rigid_motion(rests[0][steady], head[0][steady])
    left = head[0][face] - (rests[0][face] @ motion[:3, :3].T + motion[:3, 3])
    if np.abs(left).max() < SAME * float(np.linalg.norm(np.ptp(rests[0][face], axis=0))):
        return None
    back, found = np.linalg.inv(motion), []
    for obj, rest in zip(objects, rests, strict=True):
        shown, slopes = _shown(obj, rest, look=look) or (rest, np.broadcast_to(np.eye(3), (len(rest), 3, 3)))
        place = np.eye(4) if obj == objects[0] else relative_matrix(objects[0], obj)
        here = np.linalg.inv(place) @ back @ place
        found.append(Posed(shown @ here[:3, :3].T + here[:3, 3], here[:3, :3] @ slopes))
    return found


def _anchors(head: Object) -> tuple[Ints, Ints]:
    """Vertices of the head that tell its shape, and those of them that tell where it is: they hold feature points."""
    if not has_points(head):
        return np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64)
    points = read_kept(head).points
    skin = {name: point.vertices for name, point in points.items() if name not in TURNING and name[:2] not in INSIDE}
    face = np.unique([vertex for vertices in skin.values() for vertex in vertices]).astype(np.int64)
    steady = np.unique([v for name in STEADY for v in skin.get(name, ())]).astype(np.int64)
    count = len(head.data.vertices)
    return face[face < count], steady[steady < count]


def is_reshaped(head: Object) -> bool:
    """Whether a rig changes the shape of a face."""
    return posed([head], [rest_vertices(head.data)]) is not None


def rigid_motion(before: Floats, after: Floats) -> Floats:
    """(4, 4) rotation and shift that take points (N, 3) nearest to others in the sense of least squares (Kabsch)."""
    first, second = before.mean(axis=0), after.mean(axis=0)
    u, _, vt = np.linalg.svd((before - first).T @ (after - second))
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(vt.T @ u.T)) or 1.0])
    motion = np.eye(4)
    motion[:3, :3] = vt.T @ flip @ u.T
    motion[:3, 3] = second - motion[:3, :3] @ first
    return motion


def _shown(obj: Object, rest: Floats, *, look: bool) -> tuple[Floats, Floats] | None:
    """Positions (V, 3) and slopes (V, 3, 3) as modifiers make them of a resting mesh; None if they change nothing."""
    acting = [m for m in obj.modifiers if m.type in MOVING and m.show_viewport and not _is_motion(m)]
    if not acting:
        return None
    state = _state(obj, acting, rest)
    if state not in _kept and not look:
        raise NotKnownYet(obj.name)
    if state not in _kept:
        _kept[state] = _evaluated(obj, acting, rest)
        while len(_kept) > KEPT:
            _kept.popitem(last=False)
    return _kept[state]


def _evaluated(obj: Object, acting: Sequence[Modifier], rest: Floats) -> tuple[Floats, Floats] | None:
    """See `_shown`."""
    size = float(np.linalg.norm(np.ptp(rest, axis=0)))
    with _through(obj, acting) as shows:
        shown = shows(rest)
        if shown.shape != rest.shape or np.abs(shown - rest).max() < SAME * SAME * size:
            return None
        steps = [shows(rest + STEP * size * axis) - shown for axis in np.eye(3)]
    return shown, np.stack(steps, axis=-1) / (STEP * size)


class _Shows(Protocol):
    """What modifiers make of positions (V, 3)."""

    def __call__(self, positions: Floats) -> Floats: ...


@contextmanager
def _through(obj: Object, acting: Sequence[Modifier]) -> Iterator[_Shows]:
    """Some modifiers of an object, to put positions through, in a scene of its own."""
    scene = bpy.data.scenes.new("Risorius Posed Face")
    scene.frame_set(bpy.context.scene.frame_current)
    copy, names = obj.copy(), {modifier.name for modifier in acting}
    copy.data = mesh = obj.data.copy()
    try:
        copy.parent = None
        copy.matrix_world = obj.matrix_world
        copy.animation_data_clear()
        remove_all_keys(copy)
        for modifier in [modifier for modifier in copy.modifiers if modifier.name not in names]:
            copy.modifiers.remove(modifier)
        scene.collection.objects.link(copy)
        layer = scene.view_layers[0]

        def shows(positions: Floats) -> Floats:
            write_floats(mesh.vertices, "co", positions)
            mesh.update_tag()
            layer.update()
            return mesh_vertices(copy.evaluated_get(layer.depsgraph).data)

        yield shows
    finally:
        bpy.data.objects.remove(copy)
        bpy.data.meshes.remove(mesh)
        bpy.data.scenes.remove(scene)


def _state(obj: Object, acting: Sequence[Modifier], rest: Floats) -> bytes:
    """A name for all that the shape depends on."""
    digest = blake2b(rest.astype(np.float32).tobytes(), digest_size=16)
    digest.update(repr((obj.session_uid, obj.data.session_uid, len(obj.data.polygons))).encode())
    for modifier in acting:
        digest.update(repr(_settings(modifier)).encode())
        other = modifier.object if hasattr(modifier, "object") else None
        if other is None:
            continue
        digest.update(np.round(relative_matrix(obj, other), 7).tobytes())
        if other.type == "ARMATURE" and other.pose is not None:
            digest.update(read_floats(other.pose.bones, "matrix", 16).tobytes())
        if other.type == "LATTICE":
            digest.update(read_floats(other.data.points, "co_deform", 3).tobytes())
    return digest.digest()


def _settings(modifier: Modifier) -> list[tuple[str, str]]:
    """What a modifier is set to."""
    kinds = {"BOOLEAN", "INT", "FLOAT", "ENUM", "STRING"}
    plain = (p.identifier for p in modifier.bl_rna.properties if p.type in kinds and p.identifier != "execution_time")
    return [(name, str(getattr(modifier, name))) for name in plain]


def _is_motion(modifier: Modifier) -> bool:
    """Whether a modifier is of a rig with an animation that changes."""
    return modifier.type == "ARMATURE" and modifier.object is not None and _is_animated(modifier.object)


def _is_animated(rig: Object) -> bool:
    """Whether keyframes move the bones of an armature."""
    animation = rig.animation_data
    if animation is None:
        return False
    strips = [strip.action for track in animation.nla_tracks for strip in track.strips]
    actions: list[Action] = [action for action in (animation.action, *strips) if action is not None]
    return any(changes(curve) for action in actions for curve in bone_curves(action))
