"""Meshes in files, without Blender: .npz and .obj.

The .npz files hold `vertices` (V, 3) in metres with either `polygons` (F, 3|4) or `loops` (the corners of all
polygons, one after another) and `face_sizes` (F,). An .obj is read as it stands, whichever way it looks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

import numpy as np

from ...arrays import LARGEST, Floats
from ...errors import FormatError
from ...files import read_bytes
from ...tables import read_arrays

#: What `read_mesh` reads without Blender.
SUFFIXES = (".npz", ".obj")


@dataclass(frozen=True, eq=False)
class MeshFile:
    """A mesh as read: `vertices` (V, 3) float64 and `polygons`, a tuple of tuples of vertex indices."""

    vertices: Floats
    polygons: tuple[tuple[int, ...], ...]

    def __post_init__(self) -> None:
        if self.vertices.ndim != 2 or self.vertices.shape[1] != 3:
            raise ValueError(f"vertices must be (V, 3), but are {self.vertices.shape}")


def read_mesh(path: str | Path) -> MeshFile:
    """Read an .npz or .obj mesh.

    Returns
    -------
    MeshFile
        vertices (V, 3) float64 in the file's unit, polygons as tuples of 0-based vertex indices.

    Raises
    ------
    FormatError
        where the file is missing, of another kind or damaged; says which line or array.

    Examples
    --------
    >>> _ = open("square.obj", "w").write("v 0 0 0\\nv 1 0 0\\nv 1 1 0\\nv 0 1 0\\nf 1 2 3 4\\n")
    >>> mesh = api.read_mesh("square.obj")
    >>> mesh.vertices.shape, mesh.polygons
    ((4, 3), ((0, 1, 2, 3),))
    """
    path = Path(path)
    if path.suffix.lower() not in SUFFIXES:
        raise FormatError(path, f"only {' and '.join(SUFFIXES)} can be read without Blender; export the mesh as .obj")
    if not path.is_file():
        raise FormatError(path, "does not exist: check the path")
    return _read_npz(path) if path.suffix.lower() == ".npz" else _read_obj(path)


def _read_npz(path: Path) -> MeshFile:
    """Vertices and polygons of an .npz file."""
    stored = read_arrays(path, "vertices", "polygons", "loops", "face_sizes")
    vertices = stored.get("vertices")
    if vertices is None or vertices.ndim != 2 or vertices.shape[1] != 3 or vertices.dtype.kind not in "iuf":
        raise FormatError(path, "expected an array `vertices` of numbers of shape (V, 3)", key="vertices")
    vertices = vertices.astype(np.float64)
    wrong = np.flatnonzero(~(np.abs(vertices) <= LARGEST).all(axis=1))
    if len(wrong):
        raise FormatError(path, f"vertex {wrong[0]} is NaN, infinite or beyond any mesh: repair it", key="vertices")
    for key in ("polygons", "loops", "face_sizes"):
        if key in stored and (stored[key].dtype.kind not in "iu" or stored[key].ndim != 1 + (key == "polygons")):
            raise FormatError(path, "must be whole numbers, (F, 3|4) of `polygons`, else (N,)", key=key)
    if "polygons" in stored:
        rows = [tuple(row) for row in stored["polygons"].tolist()]
    elif "loops" in stored and "face_sizes" in stored:
        rows = _split(path, stored["loops"].tolist(), stored["face_sizes"].tolist())
    else:
        raise FormatError(path, "expected `polygons`, or `loops` with `face_sizes`", key="polygons")
    _check_corners(path, rows, len(vertices))
    return MeshFile(vertices, tuple(rows))


def _split(path: Path, loops: list[int], sizes: list[int]) -> list[tuple[int, ...]]:
    """Corners of all polygons as those of each."""
    if len(loops) != sum(sizes) or min(sizes, default=0) < 0:
        raise FormatError(path, f"has {len(loops)} corners, but face_sizes add up to {sum(sizes)}", key="loops")
    ends = list(accumulate(sizes))
    return [tuple(loops[end - size : end]) for end, size in zip(ends, sizes, strict=True)]


def _check_corners(path: Path, rows: Sequence[Sequence[int]], vertex_count: int) -> None:
    """Refuse polygons that name a vertex that is not there."""
    wrong = next((n for n, row in enumerate(rows) if row and not 0 <= min(row) <= max(row) < vertex_count), None)
    if wrong is not None:
        raise FormatError(path, f"polygon {wrong} names a vertex outside 0..{vertex_count - 1}: export the mesh again")


def _read_obj(path: Path) -> MeshFile:
    """Vertices and faces of an .obj file; everything else in it is passed over."""
    vertices: list[tuple[float, float, float]] = []
    polygons: list[tuple[int, ...]] = []
    text = read_bytes(path).decode("utf-8", errors="replace")
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split()
        if not words or words[0] not in ("v", "f"):
            continue
        try:
            if words[0] == "v":
                x, y, z = (_coordinate(word) for word in words[1:4])
                vertices.append((x, y, z))
            else:
                polygons.append(tuple(_obj_index(word, len(vertices)) for word in words[1:]))
        except ValueError as error:
            raise FormatError(path, f"cannot read {line.strip()[:80]!r} ({str(error)[:80]})", line=number) from error
    if not vertices:
        raise FormatError(path, "has no vertices (lines beginning with `v`)")
    _check_corners(path, polygons, len(vertices))
    return MeshFile(np.array(vertices, dtype=np.float64), tuple(polygons))


def _coordinate(word: str) -> float:
    """A number that a mesh may have."""
    value = float(word)
    if not abs(value) <= LARGEST:
        raise ValueError("a coordinate is NaN, infinite or beyond any mesh")
    return value


def _obj_index(word: str, vertex_count: int) -> int:
    """The 0-based vertex index of one corner `v/vt/vn`; negative ones count back from the last vertex read."""
    index = int(word.split("/")[0])
    if index == 0 or index < -vertex_count:
        raise ValueError(f"there is no vertex {index}")
    return index - 1 if index > 0 else vertex_count + index
