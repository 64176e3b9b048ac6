"""Meshes in files, without Blender: .npz and .obj.

The .npz files hold `vertices` (V, 3) in metres with either `polygons` (F, 3|4) or `loops` (the corners of all
polygons, one after another) and `face_sizes` (F,). An .obj is read as it stands, whichever way it looks.
"""

from __future__ import annotations

import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...arrays import Floats
from ...errors import FormatError

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
    try:
        with np.load(path, allow_pickle=False) as arrays:
            stored = {name: arrays[name] for name in ("vertices", "polygons", "loops", "face_sizes") if name in arrays}
    except (ValueError, OSError, EOFError, zipfile.BadZipFile) as error:
        raise FormatError(path, f"not an .npz file of plain arrays ({error})") from error
    vertices = stored.get("vertices")
    if vertices is None or vertices.ndim != 2 or vertices.shape[1] != 3:
        raise FormatError(path, "expected an array `vertices` of shape (V, 3)", key="vertices")
    if "polygons" in stored:
        rows = [tuple(int(index) for index in row) for row in np.atleast_2d(stored["polygons"])]
    elif "loops" in stored and "face_sizes" in stored:
        loops, sizes = stored["loops"], stored["face_sizes"]
        if len(loops) != int(sizes.sum()):
            raise FormatError(path, f"has {len(loops)} corners, but face_sizes add up to {sizes.sum()}", key="loops")
        rows = [tuple(map(int, part)) for part in np.split(loops, np.cumsum(sizes)[:-1])] if len(sizes) else []
    else:
        raise FormatError(path, "expected `polygons`, or `loops` with `face_sizes`", key="polygons")
    return MeshFile(vertices.astype(np.float64), tuple(rows))


def _read_obj(path: Path) -> MeshFile:
    """Vertices and faces of an .obj file; everything else in it is passed over."""
    vertices: list[tuple[float, float, float]] = []
    polygons: list[tuple[int, ...]] = []
    text = path.read_text(encoding="utf-8", errors="replace")
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split()
        if not words or words[0] not in ("v", "f"):
            continue
        try:
            if words[0] == "v":
                x, y, z = (float(word) for word in words[1:4])
                vertices.append((x, y, z))
            else:
                polygons.append(tuple(_obj_index(word, len(vertices)) for word in words[1:]))
        except ValueError as error:
            raise FormatError(path, f"cannot read {line.strip()!r} ({error})", line=number) from error
    if not vertices:
        raise FormatError(path, "has no vertices (lines beginning with `v`)")
    return MeshFile(np.array(vertices, dtype=np.float64), tuple(polygons))


def _obj_index(word: str, vertex_count: int) -> int:
    """The 0-based vertex index of one corner `v/vt/vn`; negative ones count back from the last vertex read."""
    index = int(word.split("/")[0])
    if index == 0 or index < -vertex_count:
        raise ValueError(f"there is no vertex {index}")
    return index - 1 if index > 0 else vertex_count + index
