"""Feature points from a JSON file.

The file is an object of name -> vertex index or position in the mesh's own coordinates, ``{"8.4": 6207, "3.5":
[0.03, -0.1, 0.04]}``, or has such an object under "points" beside other things it may say; positions may then
also stand under "xyz" for names that "no_vertex" lists.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TypeAlias

from ...arrays import LARGEST
from ...errors import FormatError
from ...files import read_bytes
from ...tables import is_number, parsed_json

#: Name ("8.4") -> vertex index, or position (3,) in the mesh's own coordinates.
PointTable: TypeAlias = Mapping[str, int | tuple[float, float, float]]


def read_point_file(path: str | Path) -> dict[str, int | tuple[float, float, float]]:
    """Read feature points.

    Raises
    ------
    FormatError : with the line of a JSON error, or the key of a wrong entry.

    Examples
    --------
    >>> _ = open("points.json", "w").write('{"points": {"8.4": 17, "2.1": [0.0, -0.1, -0.06]}}')
    >>> api.read_point_file("points.json")
    {'8.4': 17, '2.1': (0.0, -0.1, -0.06)}
    """
    try:
        table = parsed_json(read_bytes(path).decode("utf-8-sig"))
    except json.JSONDecodeError as problem:
        raise FormatError(path, f"is not JSON: {problem.msg}", line=problem.lineno) from problem
    except ValueError as problem:  # not UTF-8, or nested too deeply
        raise FormatError(path, f"is not JSON ({problem}): choose a JSON file of feature points") from problem
    if not isinstance(table, dict):
        raise FormatError(path, 'must be an object such as {"8.4": 6207, ...}')
    entries = table.get("points", table)
    if not isinstance(entries, dict) or not entries:
        raise FormatError(path, 'has no feature points: expected an object such as {"8.4": 6207, ...}', key="points")
    points = {str(name): _point(entry, path, str(name)) for name, entry in entries.items() if entry is not None}
    return points | (_without_vertex(table, path) if "points" in table else {})


def _without_vertex(table: Mapping[str, object], path: str | Path) -> dict[str, int | tuple[float, float, float]]:
    """The positions of points that are said to have no vertex."""
    names, positions = table.get("no_vertex", []), table.get("xyz", {})
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise FormatError(path, "must be a list of names", key="no_vertex")
    if not isinstance(positions, dict):
        raise FormatError(path, 'must be an object such as {"3.5": [0.03, -0.1, 0.04]}', key="xyz")
    return {name: _point(positions[name], path, name) for name in names if name in positions}


def _point(entry: object, path: str | Path, name: str) -> int | tuple[float, float, float]:
    """One entry, checked."""
    if isinstance(entry, int) and not isinstance(entry, bool) and 0 <= entry < 1 << 31:
        return entry
    if isinstance(entry, list) and len(entry) == 3 and all(is_number(part, most=LARGEST) for part in entry):
        return float(entry[0]), float(entry[1]), float(entry[2])
    raise FormatError(path, f"must be a vertex index or [x, y, z], not {repr(entry)[:40]}", key=name)
