"""Face Animation Tables in files: JSON, and the text of BIFS and VRML nodes."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ...arrays import Floats
from ...errors import FormatError, ParameterError
from ...files import read_document, write_whole
from ...mpeg4 import FAPS
from .animation_tables import AnimationTable, AnimationTables, TableError

FORMAT, VERSION = "risorius face animation tables", 1
DIGITS = 7  # after the point: metres of the mesh and slopes; a 30 mm motion is kept within a hundredth of a micrometre
KEYS = ("fap", "unit", "borders", "vertices", "slopes")


def write_animation_tables(path: str | Path, tables: AnimationTables) -> None:
    """Write tables as JSON, which `read_animation_tables` reads.

    Raises
    ------
    FormatError : the file cannot be written.
    """
    document = {
        "format": FORMAT,
        "version": VERSION,
        "vertices": np.round(tables.vertices, DIGITS).tolist(),
        "tables": [_entry(table) for table in tables.tables.values()],
    }
    write_whole(path, json.dumps(document))


def read_animation_tables(path: str | Path) -> AnimationTables:
    """Tables out of a JSON file.

    Raises
    ------
    FormatError : names the file, the key and the rule it breaks.
    """
    file = Path(path)
    document = read_document(file, kind=FORMAT, version=VERSION)
    entries = document.get("tables")
    if not isinstance(entries, list):
        raise FormatError(file, "must be a list of tables", key="tables")
    vertices = _array(file, document.get("vertices"), "vertices", (-1, 3))
    found: dict[int, AnimationTable] = {}
    for place, entry in enumerate(entries):
        table = _table(file, entry, f"tables.{place}")
        if table.fap in found:
            raise FormatError(file, f"FAP {table.fap} has a table already", key=f"tables.{place}.fap")
        found[table.fap] = table
    try:
        return AnimationTables(vertices, found)
    except ParameterError as error:
        raise FormatError(file, str(error), key="tables") from error


def write_face_def_tables(path: str | Path, tables: AnimationTables, *, node: str = "Face") -> None:
    """Write tables as the text of the FDP node's FaceDefTables (BIFS text, VRML syntax).

    Vertex indices are those of the mesh, which must be the IndexedFaceSet that the scene calls `node`.

    Raises
    ------
    FormatError : the file cannot be written.
    ParameterError : the node's name is no name in VRML.
    """
    if not node.isidentifier():
        raise ParameterError("node", "must be a name of letters, digits and _", node)
    write_whole(path, "\n".join(_node_lines(tables, node)) + "\n")


def _entry(table: AnimationTable) -> dict[str, Any]:
    """A table as JSON has it."""
    error = table.error
    return {
        "fap": table.fap,
        "name": FAPS[table.fap].name,
        "unit": table.unit,
        "borders": table.borders.tolist(),
        "vertices": table.vertices.tolist(),
        "slopes": np.round(table.slopes, DIGITS).tolist(),
        "error_mm": None if error is None else {"rms": 1e3 * error.rms, "largest": 1e3 * error.largest},
    }


def _table(file: Path, entry: object, key: str) -> AnimationTable:
    """One checked table."""
    if not isinstance(entry, dict) or not set(KEYS) <= set(entry):
        raise FormatError(file, f"must be an object with {', '.join(KEYS)}", key=key)
    for name in ("fap", "unit"):
        if isinstance(entry[name], bool) or not isinstance(entry[name], int | float):
            raise FormatError(file, f"must be a number, but it is {entry[name]!r:.40}", key=f"{key}.{name}")
    borders, vertices = (_array(file, entry[name], f"{key}.{name}", (-1,)) for name in ("borders", "vertices"))
    for name, values in (("borders", borders), ("vertices", vertices)):
        if (values != np.rint(values)).any() or (np.abs(values) >= 2**53).any():
            raise FormatError(file, "must be whole numbers", key=f"{key}.{name}")
    slopes = _array(file, entry["slopes"], f"{key}.slopes", (max(len(borders) - 1, 0), len(vertices), 3))
    try:
        return AnimationTable(
            fap=entry["fap"],
            unit=float(entry["unit"]),
            borders=borders.astype(np.int64),
            vertices=vertices.astype(np.int64),
            slopes=slopes,
            error=_error(entry.get("error_mm")),
        )
    except (ParameterError, OverflowError) as error:
        raise FormatError(file, str(error), key=key) from error


def _error(entry: object) -> TableError | None:
    """The error, which is for information: None where it is not as written."""
    if not isinstance(entry, Mapping):
        return None
    values = [entry.get(name) for name in ("rms", "largest")]
    numbers = [value for value in values if isinstance(value, int | float)]
    return TableError(1e-3 * numbers[0], 1e-3 * numbers[1]) if len(numbers) == 2 else None


def _array(file: Path, value: object, key: str, shape: tuple[int, ...]) -> Floats:
    """An array of numbers of a shape; -1 stands for any length."""
    if not isinstance(value, list):
        raise FormatError(file, "must be a list", key=key)
    try:
        array = np.array(value, dtype=np.float64).reshape(shape) if value else np.zeros([max(n, 0) for n in shape])
    except (TypeError, ValueError, OverflowError) as error:
        raise FormatError(file, f"must hold numbers in the shape {shape}: {error}", key=key) from error
    if array.ndim > 1 and np.shape(value[:1])[1:] != array.shape[1:] and value:
        raise FormatError(file, f"must hold numbers in the shape {shape}", key=key)
    if not np.isfinite(array).all():
        raise FormatError(file, "must be finite", key=key)
    return array


def _node_lines(tables: AnimationTables, node: str) -> Iterator[str]:
    """The FDP node, a line per field; one vector per vertex, interval after interval."""
    yield f"# Face Animation Tables of a mesh of {len(tables.vertices)} vertices, an IndexedFaceSet called {node}."
    yield "FDP {"
    yield "  faceDefTables ["
    for table in tables.tables.values():
        yield f"    FaceDefTables {{  # {FAPS[table.fap].name}"
        yield f"      fapID {table.fap}"
        yield "      faceDefMesh ["
        yield "        FaceDefMesh {"
        yield f"          faceSceneGraphNode USE {node}"
        yield f"          intervalBorders [ {' '.join(map(str, table.borders.tolist()))} ]"
        yield f"          coordIndex [ {' '.join(map(str, table.vertices.tolist()))} ]"
        yield "          displacements ["
        for interval in table.slopes:
            yield "            " + ", ".join(f"{x:.6g} {y:.6g} {z:.6g}" for x, y, z in interval.tolist())
        yield "          ]"
        yield "        }"
        yield "      ]"
        yield "    }"
    yield "  ]"
    yield "}"
