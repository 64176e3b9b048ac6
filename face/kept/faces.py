"""Faces whose preparation is kept: the same mesh with the same points is ready at once the next time.

A file is of one face alone: its key is a digest of the mesh, the points, the parts and the axes, of the code and the
tables that a face is worked out with, and of the versions of what it is computed with. A face out of a file is the same
to the last bit.
"""

from __future__ import annotations

import platform
import sys
from collections.abc import Mapping, Sequence
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from numpy.typing import ArrayLike

from ...arrays import Floats
from ...polygons import PolygonTable
from ...progress import Work, run
from ...resources import PACKAGE, PRESETS, STANDARD
from ..face import Face
from ..mesh.checks import checked_polygons, checked_vertices
from ..mesh.points import PointSource
from ..pose import Poser
from .entries import MOST, Entries


class KeptFaces:
    """A folder of prepared faces.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> head = api.build_default_head()
    >>> with TemporaryDirectory() as folder:
    ...     kept = api.KeptFaces(Path(folder))
    ...     first = kept.face(head.vertices, head.polygons, head.points)
    ...     written = kept.keep(first)
    ...     again = kept.face(head.vertices, head.polygons, head.points)  # ready at once
    >>> written, len(again.vertices) == len(head.vertices)
    (True, True)
    """

    def __init__(self, folder: str | Path, *, most: int = MOST) -> None:
        """Use a folder, which is made when the first face is kept; it holds `most` bytes or less."""
        self.entries = Entries(Path(folder), most)

    def face(
        self,
        vertices: ArrayLike,
        polygons: Sequence[Sequence[int]] | ArrayLike,
        points: Mapping[str, PointSource],
        parts: ArrayLike | None = None,
        *,
        axes: ArrayLike | None = None,
    ) -> Face:
        """As `Face.from_arrays`, ready where it has been kept."""
        return run(self.face_steps(vertices, polygons, points, parts, axes=axes))

    def face_steps(
        self,
        vertices: ArrayLike,
        polygons: Sequence[Sequence[int]] | ArrayLike,
        points: Mapping[str, PointSource],
        parts: ArrayLike | None = None,
        *,
        axes: ArrayLike | None = None,
    ) -> Work[Face]:
        """As `face`, bit by bit."""
        array = checked_vertices(vertices)
        table = checked_polygons(polygons, len(array))
        key = face_key(array, table, points, parts, axes)
        poser = self.entries.read(key)
        if isinstance(poser, Poser):
            return _out_of_file(array, table, poser, key)
        face = yield from Face.from_arrays_steps(array, table, points, parts, axes=axes)
        face.kept_as = key
        return face

    def keep(self, face: Face) -> bool:
        """Prepare a face that came from here and keep it; whether it is kept now (`entries.trouble` tells why not)."""
        return run(self.keep_steps(face))

    def keep_steps(self, face: Face) -> Work[bool]:
        """As `keep`, bit by bit; a face that came out of a file with all that is near explored is kept already."""
        if face.kept_as == "":
            return False
        if face.is_from_file and face.was_explored:
            return True
        yield from face.prepare()
        yield from face.sketcher().explore()
        return (yield from self.entries.write(face.kept_as, face.poser))

    def keep_posed(self, face: Face) -> bool:
        """Keep a face from here that was posed, as far as it is prepared by now; whether it is kept."""
        return run(self.keep_posed_steps(face))

    def keep_posed_steps(self, face: Face) -> Work[bool]:
        """As `keep_posed`, bit by bit."""
        if face.kept_as == "" or "inverse" not in vars(face.anatomy):
            return False
        if face.is_from_file:
            return True
        yield from face.prepare()
        return (yield from self.entries.write(face.kept_as, face.poser))


def _out_of_file(vertices: Floats, polygons: PolygonTable, poser: Poser, key: str) -> Face:
    """A face that was prepared before."""
    face = Face(vertices, polygons, poser.anatomy)
    vars(face)["_poser"] = poser
    face.kept_as, face.is_from_file, face.was_explored = key, True, poser.is_explored
    return face


def face_key(
    vertices: Floats,
    polygons: PolygonTable,
    points: Mapping[str, PointSource],
    parts: ArrayLike | None,
    axes: ArrayLike | None,
) -> str:
    """The key of the face that is made of these."""
    digest = sha256(code_digest())
    told: list[Any] = [vertices, polygons.loops, polygons.sizes, parts, axes]
    for name in sorted(points):
        told += [name, points[name]]
    for each in told:
        array = np.array(str(each)) if each is None or isinstance(each, str) else np.asarray(each)
        digest.update(f"{array.dtype.str}{array.shape}".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


@lru_cache(maxsize=1)
def code_digest() -> bytes:
    """A digest of all that faces are worked out with: code, tables, libraries and machine."""
    machine = (sys.version, sys.byteorder, platform.machine(), np.__version__, scipy.__version__)
    digest = sha256(repr(machine).encode())
    files = [PACKAGE / "polygons.py", *STANDARD.rglob("*.*"), *PRESETS.rglob("*.toml"), *PRESETS.rglob("*.csv")]
    for room in ("face", "physics", "mpeg4"):
        files += (PACKAGE / room).rglob("*.py")
    for path in sorted(file for file in files if file.is_file()):
        digest.update(path.relative_to(PACKAGE).as_posix().encode() + b"\0")
        digest.update(sha256(path.read_bytes()).digest())
    return digest.digest()
