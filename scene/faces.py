"""From objects to a face: one mesh, or a head with eyes, teeth and tongue as objects of their own.

Building a face takes a moment, so the last few are kept, found again by the fingerprint of all they are made of.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Floats, Ints
from ..face.mesh.parts import Part, Told
from ..face.mesh.point_files import PointTable
from ..polygons import PolygonTable
from ..progress import Work, run
from . import mesh as meshes
from .as_read import AsRead
from .blender_types import Mesh, Object, Scene
from .companions import Companion, placements, refuse_confused
from .fingerprint import Fingerprint, fingerprint
from .points.stored import moved_points, stored_points
from .points.stored import store_points as store_points
from .posed import Posed, posed
from .refusals import refuse_broken_vertices, refuse_unreadable
from .shape_mix import Resting, resting_values, settle_drivers

if TYPE_CHECKING:
    from ..api import Face, KeptFaces

KEPT_FACES = 3
#: Those that were asked for last, the last one at the end.
_faces: list[tuple[Fingerprint, Face]] = []


def nowhere() -> Path | None:
    """Prepared faces are kept in no folder."""
    return None


#: Tells in which folder prepared faces are kept.
_where: Callable[[], Path | None] = nowhere
#: Why the last one could not be kept.
_trouble = ""


@dataclass(frozen=True, eq=False)
class Piece:
    """One object of a face: vertices `first` to ``first + count`` of the joined arrays.

    Attributes
    ----------
    mix : (V, 3) vertices in the mesh's own coordinates, as the user's shape keys make them.
    to_metres : (4, 4) from those to the joined arrays' metres.
    posed : what a rig makes of them, where it changes the shape of the face.
    """

    obj: Object
    first: int
    mix: Floats
    to_metres: Floats
    posed: Posed | None = None

    @property
    def rest(self) -> Floats:
        """(V, 3) resting vertices in the mesh's own coordinates, as they show."""
        return self.mix if self.posed is None else self.posed.positions

    @property
    def metric(self) -> Floats:
        """(V, 3) resting vertices in the joined arrays' metres."""
        vertices: Floats = self.rest @ self.to_metres[:3, :3].T + self.to_metres[:3, 3]
        return vertices

    @property
    def slice(self) -> slice[int, int, None]:
        """This piece's rows of the joined arrays."""
        return slice(self.first, self.first + len(self.mix))

    def moves(self, displacements: Floats, least: float) -> bool:
        """Whether joined displacements (..., all vertices, 3) move this piece by more than `least` metres."""
        return bool(np.abs(displacements[..., self.slice, :]).max(initial=0.0) > least)

    def local_positions(self, displacements: Floats) -> Floats:
        """(V, 3) positions before modifiers, in the mesh's own coordinates, from joined displacements in metres."""
        positions: Floats = self.mix + self._change(displacements)
        return positions

    def key_positions(self, displacements: Floats) -> Floats:
        """(V, 3) the same as a shape key relative to the Basis, to which the user's keys add what they add."""
        positions: Floats = meshes.basis_vertices(self.obj.data) + self._change(displacements)
        return positions

    def shown(self, change: Floats) -> Floats:
        """(V, 3) in the joined arrays' metres what a change of this mesh before modifiers shows."""
        turned = change if self.posed is None else np.einsum("vij,vj->vi", self.posed.slopes, change)
        return np.asarray(turned @ self.to_metres[:3, :3].T)

    def _change(self, displacements: Floats) -> Floats:
        """(V, 3) joined displacements (all vertices, 3) in metres as those of this mesh before modifiers."""
        shown = np.asarray(displacements[self.slice] @ np.linalg.inv(self.to_metres[:3, :3]).T)
        return shown if self.posed is None else self.posed.back(shown, self.obj.name)


@dataclass(frozen=True, eq=False)
class FaceSource:
    """What a face is built from: the pieces and their joined arrays, in metres.

    Attributes
    ----------
    pieces : the head first.
    vertices : (V, 3).
    polygons : between `vertices`.
    points : name -> vertex index, or position (3,) in metres.
    parts : (V,) of `Part` and `Told`; None where nothing is known.
    as_read : what each object was.
    """

    pieces: tuple[Piece, ...]
    vertices: Floats
    polygons: PolygonTable
    points: Mapping[str, int | Floats]
    parts: Ints | None
    fingerprint: Fingerprint
    as_read: tuple[AsRead, ...]

    @property
    def head(self) -> Object:
        """The object that the face is named after."""
        return self.pieces[0].obj

    @property
    def objects(self) -> tuple[Object, ...]:
        """All objects of the face, the head first."""
        return tuple(piece.obj for piece in self.pieces)

    def refuse_changed(self, *, same_mesh: bool = False) -> None:
        """Refuse to write on objects that others have changed since they were read; to be asked just before writing.

        Parameters
        ----------
        same_mesh : what is written names the very meshes that were read.

        Raises
        ------
        SceneError : see `AsRead.refuse_changed`.
        """
        for obj, read in zip(self.objects, self.as_read, strict=True):
            read.refuse_changed(obj, same_mesh=same_mesh)


def read_face(
    obj: Object,
    *,
    companions: Sequence[Companion] = (),
    points: PointTable | None = None,
    scene: Scene | None = None,
    resting: Resting = resting_values,
    rigged: bool = True,
) -> FaceSource:
    """Read a face from its object, and from the objects of its eyes, teeth and tongue where they are apart.

    Parameters
    ----------
    obj : the head's object.
    companions : parts that are objects of their own.
    points : feature points in the mesh's own coordinates; by default those stored with `obj`.
    scene : whose unit scale counts; by default the current one.
    resting : which shape keys of a mesh, at which values, make its rest; by default the user's as they are now.
    rigged : whether a rig that changes the shape of the face is part of its rest.

    Raises
    ------
    SceneError : see `refusals`; an object named twice; missing feature points.
    """
    refuse_unreadable(obj)
    refuse_confused(obj, companions)
    settle_drivers([obj, *(companion.obj for companion in companions)])
    members = [obj, *(companion.obj for companion in companions)]
    pieces: list[Piece] = []
    polygons: list[PolygonTable] = []
    first = 0
    for member, to_metres in zip(members, placements(obj, companions, scene), strict=True):
        refuse_unreadable(member)
        refuse_broken_vertices(member)
        pieces.append(Piece(member, first, meshes.rest_vertices(member.data, resting(member.data)), to_metres))
        corners, sizes = meshes.polygon_arrays(member.data)
        polygons.append(PolygonTable(corners + first, sizes))
        first = pieces[-1].slice.stop
    shapes = posed(members, [piece.mix for piece in pieces]) if rigged else None
    if shapes is not None:
        pieces = [replace(piece, posed=shape) for piece, shape in zip(pieces, shapes, strict=True)]
    head = pieces[0].rest
    table = points if points is not None else stored_points(obj, head)
    if points is not None and shapes is not None:
        table = moved_points(obj, points, head)
    stretch = pieces[0].to_metres[:3, :3]
    metric = {n: p if isinstance(p, int) else stretch @ np.asarray(p, float) for n, p in table.items()}
    named = [Told.ANYTHING, *(companion.part for companion in companions)]
    parts = np.concatenate([_parts_of(member.data, part) for member, part in zip(members, named, strict=True)])
    return FaceSource(
        tuple(pieces),
        np.concatenate([piece.metric for piece in pieces]),
        PolygonTable.joined(polygons),
        metric,
        None if (parts == Told.ANYTHING).all() else parts,
        fingerprint(obj, companions, points=points, scene=scene, resting=resting, rigged=rigged),
        tuple(AsRead.of(member) for member in members),
    )


def _parts_of(mesh: Mesh, part: Part | Told) -> Ints:
    """(V,) parts of one object: what it is told to be, or where that is anything, what is stored with its mesh."""
    stored = meshes.read_parts(mesh) if part is Told.ANYTHING else None
    return stored if stored is not None else np.full(len(mesh.vertices), int(part), dtype=np.int64)


def face_of(source: FaceSource) -> Face:
    """The face of `source`; the last few are kept.

    Raises
    ------
    ModelError : what the face lacks.
    """
    return run(face_steps(source))


def face_steps(source: FaceSource) -> Work[Face]:
    """As `face_of`, bit by bit."""
    kept = next((kept for kept in _faces if kept[0].matches(source.fingerprint)), None)
    if kept is None:
        from .. import api

        kept_faces = _kept_faces()
        steps = api.Face.from_arrays_steps if kept_faces is None else kept_faces.face_steps
        face = yield from steps(source.vertices, source.polygons, dict(source.points), parts=source.parts)
        kept = source.fingerprint, face
    else:
        _faces.remove(kept)
    _faces.append(kept)
    del _faces[:-KEPT_FACES]
    return kept[1]


def keep_where(where: Callable[[], Path | None]) -> None:
    """Keep prepared faces in the folder that `where` tells whenever it is asked; in none where that is None."""
    global _where
    _where = where


@contextmanager
def kept_where_unset(where: Callable[[], Path | None]) -> Iterator[None]:
    """For a while, keep prepared faces as `keep_where`, where nothing has been said of that yet."""
    before = _where
    if before is nowhere:
        keep_where(where)
    try:
        yield
    finally:
        keep_where(before)


def keep_posed_steps() -> Work[list[str]]:
    """Keep the last faces of `face_of` that were posed, as far as they are prepared; why some could not be."""
    kept_faces, troubles = _kept_faces(), list[str]()
    if kept_faces is not None:
        for _, face in _faces:
            if not (yield from kept_faces.keep_posed_steps(face)) and kept_faces.entries.trouble:
                troubles.append(kept_faces.entries.trouble)
    return troubles


def keep_steps(face: Face) -> Work[bool]:
    """Keep a face of `face_of` for the next time, bit by bit; whether it is kept (`keeping_trouble` tells why not)."""
    global _trouble
    kept_faces = _kept_faces()
    if kept_faces is None:
        return False
    done = yield from kept_faces.keep_steps(face)
    _trouble = kept_faces.entries.trouble
    return done


def keeping_trouble() -> str:
    """Why the last face could not be kept, in words; or nothing."""
    return _trouble and f"The last face was not kept: {_trouble}"


def _kept_faces() -> KeptFaces | None:
    """The folder of prepared faces, where there is to be one."""
    from .. import api

    folder = _where()
    return None if folder is None else api.KeptFaces(folder)


def forget_faces() -> None:
    """Let go of the kept faces."""
    _faces.clear()
