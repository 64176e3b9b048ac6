"""Which object it is, and which face: the one fingerprint of all that a face is made of.

It changes with the resting vertices and polygons of a face's objects (so with the values of the user's shape keys),
with its feature points and parts, and with the sizes of these objects and their places relative to the head. It does
not change with where the head is and how it is turned, with keyframes, with what was baked, with materials and names,
or with how sure the points are. Two objects may have the same: a copy of a face is the same face.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import blake2b

import numpy as np

from ..arrays import Floats
from ..face.mesh.parts import Told
from ..face.mesh.point_files import PointTable
from .blender_types import Datablock, Object, Scene
from .companions import Companion, placements
from .mesh import polygon_arrays, read_parts, rest_vertices
from .points.kept import mesh_counts, read_kept
from .posed import NotKnownYet, posed
from .shape_mix import Resting, resting_values

#: Blender holds matrices in single precision: objects that move together come out a little differently in every frame.
#: Sizes are the same within this share of them, and places within this share of the head's size.
STRETCHED, MOVED = 1e-5, 1e-4
#: So many vertices of each object are compared where a rig shapes it.
SAMPLE = 400


@dataclass(frozen=True, eq=False)
class Fingerprint:
    """What a face is made of.

    Attributes
    ----------
    digest : of vertices, polygons, points and parts.
    placements : (n, 4, 4) from the coordinates of its objects, the head first, to metres.
    size : of the head, metres, a measure for the places of companions; 0 without any.
    posed : (k, 3) places of some vertices where a rig changes the shape of the face, none where it does not; NaN where
        that is not known yet, which is no face's.
    """

    digest: str
    placements: Floats
    size: float
    posed: Floats

    def matches(self, other: Fingerprint) -> bool:
        """Whether the other is of the same face."""
        if self.digest != other.digest or self.posed.shape != other.posed.shape:
            return False
        if len(self.posed):
            extent = float(np.linalg.norm(np.ptp(self.posed, axis=0)))
            return bool(np.abs(self.posed - other.posed).max() <= MOVED * extent)
        off = np.abs(self.placements - other.placements)
        stretch = float(np.abs(self.placements[:, :3, :3]).max())
        return bool(off[:, :3, :3].max() <= STRETCHED * stretch and off[:, :3, 3].max() <= MOVED * self.size)


def uid_of(datablock: Datablock) -> int:
    """A number that an object or mesh keeps while Blender runs, through renaming and undo."""
    return int(datablock.session_uid)


def fingerprint(
    obj: Object,
    companions: Sequence[Companion] = (),
    *,
    points: PointTable | None = None,
    scene: Scene | None = None,
    resting: Resting = resting_values,
    rigged: bool = True,
) -> Fingerprint:
    """The fingerprint of a face; parameters as for `faces.read_face`. Takes some milliseconds.

    Raises
    ------
    SceneError : no feature points; an object that is scaled to nothing, or a mirrored head.
    """
    digest, matrices = blake2b(digest_size=16), np.array(placements(obj, companions, scene))
    rests = []
    for member, part in [(obj, Told.ANYTHING), *((companion.obj, companion.part) for companion in companions)]:
        parts = read_parts(member.data) if part is Told.ANYTHING else None
        digest.update(repr((part, mesh_counts(member.data), parts is None)).encode())
        rests.append(rest_vertices(member.data, resting(member.data)))
        digest.update(rests[-1].astype(np.float32).tobytes())
        for numbers in (*polygon_arrays(member.data), parts):
            digest.update(b"" if numbers is None else numbers.astype(np.int32).tobytes())
    digest.update(repr(sorted(points.items()) if points is not None else _places(obj)).encode())
    size = np.ptp(rests[0] @ matrices[0, :3, :3].T, axis=0).max() if companions else 0.0
    shape = _posed([obj, *(companion.obj for companion in companions)], rests, matrices) if rigged else np.zeros((0, 3))
    return Fingerprint(digest.hexdigest(), matrices, float(size), shape)


def _posed(members: Sequence[Object], rests: Sequence[Floats], matrices: Floats) -> Floats:
    """(k, 3) see `Fingerprint.posed`."""
    try:
        shapes = posed(members, rests, look=False)
    except NotKnownYet:
        return np.full((1, 3), np.nan)
    if shapes is None:
        return np.zeros((0, 3))
    places = [
        shape.positions[:: max(1, len(shape.positions) // SAMPLE)] @ matrix[:3, :3].T + matrix[:3, 3]
        for shape, matrix in zip(shapes, matrices, strict=True)
    ]
    return np.concatenate(places)


def _places(obj: Object) -> list[tuple[object, ...]]:
    """Where the points are kept, without how sure they are and where they came from."""
    kept = read_kept(obj)
    points = sorted(kept.points.items())
    return [(kept.counts, kept.digest), *((name, p.at, p.vertices, p.weights, p.on) for name, p in points)]
