"""What Risorius keeps in a .blend as text, read back after somebody else has written there. Needs Blender's module."""

from __future__ import annotations

import base64
import contextlib
import io
import json
import struct
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from risorius.operators.points.clicks import clicks_of
from risorius.scene.jobs.inputs import meshes_of
from risorius.scene.points import bound
from risorius.scene.points.kept import POINTS, read_kept
from risorius.scene.rig.kept import FOLLOWED, _followed
from risorius.scene.rig.layers import INTO, REST, noted
from risorius.scene.shape_mix import RECORD, own_keys

from .attempts import Reader

#: How glTF holds data in its text.
INLINE = "data:application/octet-stream;base64,"


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
        Reader("blend_gltf", _head, _gltf()),
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


def _gltf() -> dict[str, bytes]:
    """A square as text and in binary."""
    places = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype="<f4").tobytes()
    data = places + np.array([0, 1, 2, 0, 2, 3], dtype="<u2").tobytes()
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "face"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "buffers": [{"byteLength": len(data)}],
    }  # fmt: skip
    told = {**document, "buffers": [{"byteLength": len(data), "uri": INLINE + base64.b64encode(data).decode()}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    parts = (struct.pack("<II", len(piece), kind) + piece for piece, kind in ((text, 0x4E4F534A), (data, 0x004E4942)))
    whole = b"".join(parts)
    return {"a.gltf": json.dumps(told).encode(), "a.glb": struct.pack("<4sII", b"glTF", 2, 12 + len(whole)) + whole}


def _head(path: Path) -> object:
    """The meshes of a glTF file; they go again, and what came with them."""
    rooms = (bpy.data.objects, bpy.data.collections, bpy.data.meshes, bpy.data.materials, bpy.data.images)
    before = [{item.name for item in room} for room in rooms]
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):  # of the importer
            found = meshes_of(path)
        return [(obj.name, np.array([[*vertex.co] for vertex in obj.data.vertices])) for obj in found]
    finally:
        for room, known in zip(rooms, before, strict=True):
            for item in [each for each in room if each.name not in known]:
                room.remove(item)


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
