"""From objects to a face: one mesh, or a head with eyes, teeth and tongue as objects of their own.

The feature points are kept with the mesh (`points_kept`). Building a face takes a moment, so the last few are kept,
found again by a fingerprint of all they are made of.
"""

from __future__ import annotations

import hashlib
import json
from collections import OrderedDict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Floats, Ints
from ..errors import SceneError
from ..face.mesh.parts import Part
from ..face.mesh.point_files import PointTable
from . import mesh as meshes
from .blender_types import Mesh, Object, Scene
from .points.bound import bind, followed, table_of
from .points.kept import Origin, read_kept, write_kept
from .points.kept import forget_points as forget_points
from .points.kept import has_points as has_points
from .refusals import refuse_broken_vertices, refuse_unreadable

if TYPE_CHECKING:
    from ..api import Face

KEPT_FACES = 3
_faces: OrderedDict[str, Face] = OrderedDict()


@dataclass(frozen=True)
class Piece:
    """One object of a face: vertices `first` to ``first + count`` of the joined arrays.

    Attributes
    ----------
    rest : (V, 3) resting vertices in the mesh's own coordinates.
    to_metres : (4, 4) from those to the joined arrays' metres.
    """

    obj: Object
    first: int
    rest: Floats
    to_metres: Floats

    @property
    def slice(self) -> slice[int, int, None]:
        """This piece's rows of the joined arrays."""
        return slice(self.first, self.first + len(self.rest))

    def local_positions(self, displacements: Floats) -> Floats:
        """(V, 3) positions in the mesh's own coordinates from joined displacements (all vertices, 3) in metres."""
        inverse = np.linalg.inv(self.to_metres[:3, :3])
        positions: Floats = self.rest + displacements[self.slice] @ inverse.T
        return positions


@dataclass(frozen=True)
class FaceSource:
    """What a face is built from: the pieces and their joined arrays, in metres.

    Attributes
    ----------
    pieces : the head first.
    vertices : (V, 3).
    polygons : index sequences into `vertices`.
    points : name -> vertex index, or position (3,) in metres.
    parts : (V,) of `Part`, -1 where the face itself is to say; None where nothing is known.
    """

    pieces: tuple[Piece, ...]
    vertices: Floats
    polygons: list[tuple[int, ...]]
    points: Mapping[str, int | Floats]
    parts: Ints | None
    fingerprint: str

    @property
    def head(self) -> Object:
        """The object that the face is named after."""
        return self.pieces[0].obj

    @property
    def objects(self) -> tuple[Object, ...]:
        """All objects of the face, the head first."""
        return tuple(piece.obj for piece in self.pieces)


def store_points(obj: Object, points: PointTable, *, origin: Origin = Origin.FILE) -> None:
    """Keep feature points with the mesh of `obj`: name -> vertex index, or position (3,) in the mesh's own coordinates.

    Raises
    ------
    SceneError : an index beyond the mesh's vertices; a mesh of another file.
    """
    count = len(obj.data.vertices)
    for name, point in points.items():
        if isinstance(point, int) and point >= count:
            raise SceneError(
                obj.name,
                f"has {count} vertices, but feature point {name} uses vertex {point}: wrong file for the mesh?",
            )
    write_kept(obj, bind(obj.data, points, origins=origin), as_given=True)


def stored_points(obj: Object) -> dict[str, int | tuple[float, float, float]]:
    """Feature points kept with the mesh of `obj`, where they are on it now.

    Raises
    ------
    SceneError : none there, unreadable, or the mesh was edited so that points that every face needs are lost.
    """
    from ..face.mesh.points import REQUIRED

    now = followed(read_kept(obj), obj.data)
    needed = sorted(set(now.lost) & set(REQUIRED))
    if needed:
        raise SceneError(
            obj.name, f"was edited, and its feature points {', '.join(needed)} were lost: find or import them again"
        )
    return table_of(now.kept, meshes.rest_vertices(obj.data))


def read_face(
    obj: Object,
    *,
    companions: Mapping[Part, Object] | None = None,
    points: PointTable | None = None,
    scene: Scene | None = None,
) -> FaceSource:
    """Read a face from its object, and from the objects of its eyes, teeth and tongue where they are apart.

    Parameters
    ----------
    obj : the head's object.
    companions : part -> its object, for parts that are objects of their own.
    points : feature points in the mesh's own coordinates; by default those stored with `obj`.
    scene : whose unit scale counts; by default the current one.

    Raises
    ------
    SceneError : see `refusals`; an object named twice; missing feature points.
    """
    refuse_unreadable(obj)
    others = [(part, other) for part, other in (companions or {}).items() if other is not None]
    _refuse_twice(obj, [other for _, other in others])
    table = points if points is not None else stored_points(obj)
    stretch = np.eye(4)
    stretch[:3, :3] = meshes.metres_matrix(obj, scene)
    pieces, polygons, parts = [], [], []
    first = 0
    for part, member in [(None, obj), *others]:
        refuse_unreadable(member)
        refuse_broken_vertices(member)
        rest = meshes.rest_vertices(member.data)
        to_metres = stretch if part is None else stretch @ meshes.relative_matrix(obj, member)
        pieces.append(Piece(member, first, rest, to_metres))
        polygons += meshes.polygon_sequence(*meshes.polygon_arrays(member.data), first_vertex=first)
        parts.append(_parts_of(member.data, part))
        first += len(rest)
    vertices = np.concatenate([p.rest @ p.to_metres[:3, :3].T + p.to_metres[:3, 3] for p in pieces])
    metric = {n: p if isinstance(p, int) else stretch[:3, :3] @ np.asarray(p, float) for n, p in table.items()}
    joined = np.concatenate(parts)
    known = None if (joined < 0).all() else joined
    return FaceSource(tuple(pieces), vertices, polygons, metric, known, _fingerprint(vertices, polygons, table, joined))


def _refuse_twice(obj: Object, others: Iterable[Object]) -> None:
    """Refuse an object that stands for two parts."""
    seen = {obj}
    for other in others:
        if other in seen:
            raise SceneError(other.name, "is used for two parts of the face: choose it for one of them")
        seen.add(other)


def _parts_of(mesh: Mesh, part: Part | None) -> Ints:
    """(V,) parts of one object: the given part, or those stored with the mesh, or -1."""
    count = len(mesh.vertices)
    if part is not None:
        return np.full(count, int(part), dtype=np.int64)
    stored = meshes.read_parts(mesh)
    return stored if stored is not None else np.full(count, -1, dtype=np.int64)


def _fingerprint(vertices: Floats, polygons: list[tuple[int, ...]], points: PointTable, parts: Ints) -> str:
    """A name for exactly this face."""
    digest = hashlib.blake2b(vertices.tobytes(), digest_size=16)
    digest.update(np.fromiter((i for polygon in polygons for i in (len(polygon), *polygon)), dtype=np.int64).tobytes())
    digest.update(json.dumps(points, sort_keys=True).encode())
    digest.update(parts.tobytes())
    return digest.hexdigest()


def face_of(source: FaceSource) -> Face:
    """The face of `source`; the last few are kept.

    Raises
    ------
    ModelError : what the face lacks.
    """
    from .. import api

    face = _faces.pop(source.fingerprint, None)
    if face is None:
        parts = source.parts
        if parts is not None and (parts < 0).any():
            derived = _derived_head_parts(source)
            parts = np.where(parts < 0, derived, parts)
        face = api.Face.from_arrays(source.vertices, source.polygons, dict(source.points), parts=parts)
    _faces[source.fingerprint] = face
    while len(_faces) > KEPT_FACES:
        _faces.popitem(last=False)
    return face


def _derived_head_parts(source: FaceSource) -> Ints:
    """(V,) parts as the head's own mesh tells them; the vertices of other objects are OTHER."""
    from .. import api

    count = len(source.pieces[0].rest)
    alone = [polygon for polygon in source.polygons if polygon[0] < count]
    head = api.Face.from_arrays(source.vertices[:count], alone, dict(source.points))
    parts = np.full(len(source.vertices), int(Part.OTHER), dtype=np.int64)
    parts[:count] = head.parts
    return parts


def forget_faces() -> None:
    """Let go of the kept faces."""
    _faces.clear()
