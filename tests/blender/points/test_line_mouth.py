"""Mouths that end in an open border: said when they are baked, and lined on the user's own mesh."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bmesh
import bpy
import numpy as np
import pytest
from risorius.face.products.mouth_room import mouth_border
from risorius.scene.bake.remarks import remarks
from risorius.scene.cut.lips import DARK
from risorius.scene.faces import face_of, read_face
from risorius.scene.mesh import basis_vertices, key_vertices
from risorius.scene.points.kept import read_kept
from risorius.scene.points.stored import store_points


@pytest.fixture
def hollow(sewn_head: Callable[..., Any]) -> Any:
    """A head whose lips end in an open border, with a shape key of the user's own."""
    head = sewn_head()
    mesh = bpy.data.meshes.new("Hollow")
    mesh.from_pydata(head.vertices.tolist(), [], head.polygons)
    obj = bpy.data.objects.new("Hollow", mesh)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    obj.shape_key_add(name="Basis")
    raised = obj.shape_key_add(name="Raised")
    raised.data.foreach_set("co", (head.vertices + np.array([0.0, 0.0, 0.01])).astype(np.float32).ravel())
    raised.value = 0.25
    store_points(obj, {name: tuple(place) for name, place in head.points.items()})
    return obj


def is_said(obj: Any) -> bool:
    """Whether a bake names that its mouth has no inside."""
    return any("no inside" in line for line in remarks(obj, face_of(read_face(obj))))


def split_border(obj: Any) -> None:
    """Split an edge of the mouth's border, so that its upper and its lower side have different numbers of vertices."""
    border = mouth_border(face_of(read_face(obj)))
    edit = bmesh.new()
    edit.from_mesh(obj.data)
    edit.verts.ensure_lookup_table()
    first, second = (edit.verts[i] for i in border.upper[3:5].tolist())
    bmesh.ops.subdivide_edges(edit, edges=[edit.edges.get((first, second))], cuts=3)
    edit.to_mesh(obj.data)
    edit.free()


@pytest.mark.parametrize("uneven", [False, True])
def test_a_mouth_without_an_inside_is_lined(hollow: Any, uneven: bool) -> None:
    mesh = hollow.data
    if uneven:
        split_border(hollow)
    before, points = basis_vertices(mesh), read_kept(hollow).points
    assert is_said(hollow)
    assert bpy.ops.risorius.line_mouth() == {"FINISHED"}
    assert not mesh.validate()
    now = basis_vertices(mesh)
    np.testing.assert_allclose(now[: len(before)], before, atol=1e-7)
    np.testing.assert_allclose(
        key_vertices(mesh.shape_keys.key_blocks["Raised"]) - now, np.tile([0.0, 0.0, 0.01], (len(now), 1)), atol=1e-6
    )
    assert DARK in [slot.name for slot in mesh.materials if slot is not None]
    assert not is_said(hollow)
    assert read_kept(hollow).points.keys() == points.keys()
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}


def test_what_has_an_inside_is_left_alone(hollow: Any) -> None:
    bpy.ops.risorius.line_mouth()
    count = len(hollow.data.vertices)
    with pytest.raises(RuntimeError, match="no open border"):
        bpy.ops.risorius.line_mouth()
    assert len(hollow.data.vertices) == count


def test_sewn_lips_are_to_be_cut_instead(sewn_head: Callable[..., Any]) -> None:
    head = sewn_head("mouth")
    mesh = bpy.data.meshes.new("Scan")
    mesh.from_pydata(head.vertices.tolist(), [], head.polygons)
    obj = bpy.data.objects.new("Scan", mesh)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    store_points(obj, {name: tuple(place) for name, place in head.points.items()})
    with pytest.raises(RuntimeError, match="Cut Lips Open"):
        bpy.ops.risorius.line_mouth()
