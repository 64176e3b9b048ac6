"""What Risorius keeps in a .blend as text, read back after somebody else has written there. Needs Blender's module."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from risorius.operators.points.clicks import clicks_of
from risorius.scene.points import bound
from risorius.scene.points.kept import POINTS, read_kept
from risorius.scene.rig.kept import FOLLOWED, _followed
from risorius.scene.rig.layers import INTO, REST, noted
from risorius.scene.shape_mix import RECORD, own_keys

from .attempts import Reader


def blend_readers() -> list[Reader]:
    """A reader for each."""
    points = {
        "counts": [8, 24, 6], "digest": "a", "score": 0.5, "sewn": ["mouth"], "resting": {"Smile": 0.5},
        "points": {
            "8.4": {"at": [0.1, 0, 1], "vertices": [0, 1, 2], "weights": [0.5, 0.25, 0.25], "on": [0, 0, 1],
                    "confidence": 0.9, "origin": "file"},
            "2.1": {"at": [0, 0, 1], "vertices": [], "weights": [], "on": [0, 0, 0], "confidence": 1, "origin": "file"},
        },
    }  # fmt: skip
    own = {"face": "a", "added_basis": True, "clips": {"joy": ["joy", "none"]}}
    places = [["location", 0, 0.5], ['pose.bones["jaw"].scale', 2, 1.0]]
    spans = [["location", 0, 1.0, 25.0]]
    followed = {"explained": 0.9, "off": 0.001, "carriers": ["jaw"], "missing": []}
    clicks = {"3.7": [0.0, 0.1, 0.2], "8.4": [1, 2, 3]}
    return [
        Reader("blend_points", _points, _json(points)),
        Reader("blend_keys", _keys, _json(own)),
        Reader("blend_rest", _noted(REST), _json(places)),
        Reader("blend_into", _noted(INTO), _json(spans)),
        Reader("blend_followed", _follows, _json(followed)),
        Reader("blend_clicks", lambda path: clicks_of(_text(path)), _json(clicks)),
    ]


def _json(value: object) -> dict[str, bytes]:
    return {"a.json": json.dumps(value).encode()}


def _text(path: Path) -> str:
    """A file as Blender keeps text: no null character, and letters that it can."""
    return path.read_bytes().decode("utf-8", errors="replace").replace("\0", "")


@cache
def _cube() -> Any:
    """A mesh with a shape key, and an action."""
    mesh = bpy.data.meshes.new("fuzzed")
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    mesh.from_pydata(corners, [], [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
    made = bpy.data.objects.new("fuzzed", mesh)
    made.shape_key_add(name="Basis")
    made.shape_key_add(name="joy")
    return made


@cache
def _action() -> Any:
    return bpy.data.actions.new("fuzzed")


def _points(path: Path) -> object:
    obj = _cube()
    obj.data[POINTS] = _text(path)
    kept = read_kept(obj)
    followed = bound.followed(kept, obj.data).kept
    places = np.array([[*corner.co] for corner in obj.data.vertices])
    return kept, followed, bound.places(followed, places)


def _keys(path: Path) -> object:
    keys = _cube().data.shape_keys
    keys[RECORD] = _text(path)
    return own_keys(keys)


def _noted(name: str) -> Callable[[Path], object]:
    def read(path: Path) -> object:
        _action()[name] = _text(path)
        return noted(_action(), name)

    return read


def _follows(path: Path) -> object:
    _action()[FOLLOWED] = _text(path)
    return _followed(_action())
