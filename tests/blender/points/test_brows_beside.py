"""Brows that are objects of their own tell where the points of the brows are."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.scene.faces import stored_points

LIFT = 6e-3


@pytest.fixture
def unknown_head(shared: Path) -> Any:
    """A head that is not known by its connectivity, as an object."""
    with np.load(shared / "heads" / "ict_narrow.npz") as data:
        faces = np.split(data["loops"], np.cumsum(data["face_sizes"])[:-1])
        mesh = bpy.data.meshes.new("Unknown")
        mesh.from_pydata(data["vertices"].tolist(), [], [face.tolist() for face in faces[:-1]])
    obj = bpy.data.objects.new("Unknown", mesh)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    return obj


def brow(name: str, places: np.ndarray) -> None:
    """A strip 7 mm high along a line (N, 3), an object scaled otherwise than the face."""
    up = np.array([0.0, 0.0, 3.5e-3])
    vertices = np.concatenate([places - up, places + up]) * 100.0
    count = len(places)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices.tolist(), [], [[k, k + 1, count + k + 1, count + k] for k in range(count - 1)])
    obj = bpy.data.objects.new(name, mesh)
    obj.scale = (0.01, 0.01, 0.01)
    bpy.context.scene.collection.objects.link(obj)


@pytest.mark.slow
def test_brows_of_their_own_are_found(unknown_head: Any) -> None:
    bpy.ops.risorius.find_points()
    vertices = np.array([v.co for v in unknown_head.data.vertices])
    plain = {
        name: np.array(_place(unknown_head, vertices, name)) for name in ("4.1", "4.3", "4.5", "4.2", "4.4", "4.6")
    }
    for names in (("4.1", "4.3", "4.5"), ("4.2", "4.4", "4.6")):
        line = np.array([plain[name] for name in names])
        dense = np.concatenate([np.linspace(line[0], line[1], 9)[:-1], np.linspace(line[1], line[2], 9)])
        brow("Part", dense + np.array([0.0, -2e-3, LIFT]))
    bpy.ops.risorius.find_points()
    for name, before in plain.items():
        rise = np.array(_place(unknown_head, vertices, name))[2] - before[2]
        assert 0.5 * LIFT < rise < 1.5 * LIFT, name


def _place(obj: Any, vertices: np.ndarray, name: str) -> Any:
    """Where a feature point lies in the mesh's coordinates."""
    point = stored_points(obj)[name]
    return vertices[point] if isinstance(point, int) else point
