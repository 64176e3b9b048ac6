"""Face Animation Tables in files: JSON, and the text of BIFS and VRML nodes."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ...arrays import Ints
from ...errors import ParameterError
from ...files import write_whole
from ...mpeg4 import FAPS
from ...tables import KeyedTable, read_json
from .animation_tables import AnimationTable, AnimationTables, TableError

FORMAT, VERSION = "risorius face animation tables", 1
DIGITS = 7  # after the point: metres of the mesh and slopes; a 30 mm motion is kept within a hundredth of a micrometre


def write_animation_tables(path: str | Path, tables: AnimationTables) -> None:
    """Write tables as JSON, which `read_animation_tables` reads.

    Raises
    ------
    FormatError : the file cannot be written.

    Examples
    --------
    >>> tables = api.face_animation_tables(api.default_face(), faps=[3], steps=1)
    >>> api.write_animation_tables("face.json", tables)
    >>> list(api.read_animation_tables("face.json").tables)
    [3]
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

    Examples
    --------
    >>> tables = api.face_animation_tables(api.default_face(), faps=[3], steps=1)
    >>> api.write_animation_tables("face.json", tables)
    >>> api.read_animation_tables("face.json").tables[3].borders.tolist()
    [-121, 0, 1546]
    """
    document = read_json(path, kind=FORMAT, version=VERSION)
    found: dict[int, AnimationTable] = {}
    for entry in document.listed("tables"):
        table = _table(entry)
        if table.fap in found:
            raise entry.refuse(f"FAP {table.fap} has a table already", "fap")
        found[table.fap] = table
    return document.made(lambda: AnimationTables(document.numbers("vertices", None, 3), found), "tables")


def write_face_def_tables(path: str | Path, tables: AnimationTables, *, node: str = "Face") -> None:
    """Write tables as the text of the FDP node's FaceDefTables (BIFS text, VRML syntax).

    Vertex indices are those of the mesh, which must be the IndexedFaceSet that the scene calls `node`.

    Raises
    ------
    FormatError : the file cannot be written.
    ParameterError : the node's name is no name in VRML.

    Examples
    --------
    >>> tables = api.face_animation_tables(api.default_face(), faps=[3], steps=1)
    >>> api.write_face_def_tables("face.txt", tables)
    >>> "FaceDefTables" in open("face.txt").read()
    True
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


def _table(entry: KeyedTable) -> AnimationTable:
    """One checked table."""
    borders, vertices = _whole(entry, "borders"), _whole(entry, "vertices")
    return entry.made(
        lambda: AnimationTable(
            fap=entry.integer("fap"),
            unit=entry.number("unit"),
            borders=borders,
            vertices=vertices,
            slopes=entry.numbers("slopes", max(len(borders) - 1, 0), len(vertices), 3),
            error=_error(entry.cells.get("error_mm")),
        )
    )


def _error(entry: object) -> TableError | None:
    """The error, which is for information: None where it is not as written."""
    if not isinstance(entry, Mapping):
        return None
    values = [entry.get(name) for name in ("rms", "largest")]
    numbers = [value for value in values if isinstance(value, int | float)]
    return TableError(1e-3 * numbers[0], 1e-3 * numbers[1]) if len(numbers) == 2 else None


def _whole(entry: KeyedTable, name: str) -> Ints:
    """Whole numbers."""
    found = entry.numbers(name)
    if (found != np.rint(found)).any() or (np.abs(found) >= 2**53).any():
        raise entry.refuse("must be whole numbers", name)
    return found.astype(np.int64)


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
