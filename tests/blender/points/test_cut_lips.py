"""Sewn lips: told when the face is found and when it is baked, and cut open on the user's own mesh."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.scene.bake.shape_keys import read_own
from risorius.scene.cut.lips import DARK
from risorius.scene.faces import face_of, read_face
from risorius.scene.mesh import basis_vertices, key_vertices, mesh_vertices
from risorius.scene.points.kept import read_kept
from risorius.scene.points.stored import store_points

#: Where the user's own shape key moves vertices, metres.
RAISED = 0.01


@pytest.fixture
def scan(sewn_head: Callable[..., Any]) -> Any:
    """A head with sewn lips, and what users have on theirs: materials, UV map, groups, a shape key, attributes."""
    head = sewn_head("mouth")
    mesh = bpy.data.meshes.new("Scan")
    mesh.from_pydata(head.vertices.tolist(), [], head.polygons)
    for name in ("Skin", "Neck"):
        mesh.materials.append(bpy.data.materials.new(name))
    for polygon in mesh.polygons:
        polygon.material_index = int(polygon.center.z < -0.06)
    layer = mesh.uv_layers.new(name="UV")
    for loop in mesh.loops:
        x, _, z = mesh.vertices[loop.vertex_index].co
        layer.data[loop.index].uv = 0.5 + 3.0 * x, 0.5 + 3.0 * z
    mesh.attributes.new("height", "FLOAT", "POINT").data.foreach_set("value", head.vertices[:, 2].astype(np.float32))
    obj = bpy.data.objects.new("Scan", mesh)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    obj.vertex_groups.new(name="Upper").add(np.flatnonzero(head.vertices[:, 2] > -0.06).tolist(), 0.75, "REPLACE")
    obj.shape_key_add(name="Basis")
    raised = obj.shape_key_add(name="Raised")
    raised.data.foreach_set("co", (head.vertices + np.array([0.0, 0.0, RAISED])).astype(np.float32).ravel())
    raised.value = 0.25
    store_points(obj, {name: tuple(place) for name, place in head.points.items()})
    return obj


def cut(obj: Any) -> np.ndarray:
    """Cut its lips; which vertices are new."""
    before = len(obj.data.vertices)
    assert bpy.ops.risorius.cut_lips() == {"FINISHED"}
    return np.arange(before, len(obj.data.vertices))


def upright(face: Any, name: str, positions: np.ndarray) -> float:
    """Height of a feature point on posed vertices, metres."""
    point = face.points[name]
    return float(point.weights @ positions[point.vertices, 2])


def test_all_that_was_there_stays_and_what_is_new_is_like_its_neighbours(scan: Any) -> None:
    mesh = scan.data
    vertices = basis_vertices(mesh)
    polygons = {tuple(sorted(polygon.vertices)): polygon.material_index for polygon in mesh.polygons}
    new = cut(scan)
    assert not mesh.validate()
    now = basis_vertices(mesh)
    np.testing.assert_allclose(now[: len(vertices)], vertices, atol=1e-7)
    kept = {tuple(sorted(polygon.vertices)): polygon.material_index for polygon in mesh.polygons}
    same = polygons.keys() & kept.keys()
    assert len(same) > 0.97 * len(polygons)
    assert all(kept[polygon] == polygons[polygon] for polygon in same)
    assert [slot.name for slot in mesh.materials] == ["Skin", "Neck", DARK]
    raised = key_vertices(mesh.shape_keys.key_blocks["Raised"]) - now
    np.testing.assert_allclose(raised, np.tile([0.0, 0.0, RAISED], (len(now), 1)), atol=1e-6)
    assert mesh.shape_keys.key_blocks["Raised"].value == 0.25
    group = scan.vertex_groups["Upper"].index
    weights = {v.index: [g.weight for g in v.groups if g.group == group] for v in mesh.vertices}
    assert all(weights[i] == [pytest.approx(0.75)] for i in new.tolist())
    layer = mesh.uv_layers["UV"]
    bag = [polygon for polygon in mesh.polygons if set(polygon.vertices) <= set(new.tolist())]
    assert {polygon.material_index for polygon in bag} == {0, 2}
    for polygon in bag:
        for loop in polygon.loop_indices:
            u, v = layer.data[loop].uv
            assert 0.4 < u < 0.6
            assert 0.35 < v < 0.5
    heights = np.zeros(len(now), dtype=np.float32)
    mesh.attributes["height"].data.foreach_get("value", heights)
    np.testing.assert_allclose(heights[: len(vertices)], vertices[:, 2], atol=1e-6)
    assert (np.abs(heights[new] - now[new, 2]) < 0.012).all()


@pytest.mark.slow
def test_the_mouth_opens_afterwards(scan: Any) -> None:
    assert face_of(read_face(scan)).sewn == {"mouth"}
    cut(scan)
    face = face_of(read_face(scan))
    assert face.sewn == frozenset()
    frame = np.full(68, np.nan)
    frame[2], frame[4] = 600.0, -600.0
    posed = face.pose(frame).positions
    assert upright(face, "2.2", face.vertices) - upright(face, "2.3", face.vertices) < 1e-4
    assert upright(face, "2.2", posed) - upright(face, "2.3", posed) > 8e-3
    dark = {v for p in scan.data.polygons if p.material_index == 2 for v in p.vertices}
    assert (face.vertices[sorted(dark), 1].max() - face.vertices[:, 1].min()) < 0.06
    inner = face.points["2.2"].position[1]
    assert face.vertices[sorted(dark), 1].max() > inner + 0.02


def test_lips_that_shape_keys_have_moved_are_cut_as_they_show(scan: Any) -> None:
    keys = scan.data.shape_keys.key_blocks
    places = basis_vertices(scan.data)
    keys["Raised"].data.foreach_set("co", (places * [2.0, 1.0, 1.0] + [0.1, 0.0, 0.0]).astype(np.float32).ravel())
    keys["Raised"].value = 1.0
    before = read_kept(scan)
    store_points(scan, {n: tuple(np.array(p.at) * [2.0, 1.0, 1.0] + [0.1, 0.0, 0.0]) for n, p in before.points.items()})
    new = cut(scan)
    assert face_of(read_face(scan)).sewn == frozenset()
    basis = basis_vertices(scan.data)[new]
    assert np.abs(basis[:, 0]).max() < 0.03


def test_a_cut_can_be_undone(scan: Any) -> None:
    before = len(scan.data.vertices)
    bpy.ops.ed.undo_push(message="start")
    assert bpy.ops.risorius.cut_lips("EXEC_DEFAULT", True) == {"FINISHED"}
    assert len(scan.data.vertices) > before
    bpy.ops.ed.undo()
    scan = bpy.data.objects["Scan"]
    assert len(scan.data.vertices) == before
    assert face_of(read_face(scan)).sewn == {"mouth"}


def test_a_mesh_without_materials_stays_as_bright_as_it_was(scan: Any) -> None:
    scan.data.materials.clear()
    for polygon in scan.data.polygons:
        polygon.material_index = 0
    cut(scan)
    assert [slot.name if slot else None for slot in scan.data.materials] == [None, DARK]
    assert 0 < sum(polygon.material_index == 1 for polygon in scan.data.polygons) < 0.1 * len(scan.data.polygons)


def test_lips_that_are_open_are_refused_and_nothing_changes(scan: Any, head: Any) -> None:
    bpy.context.view_layer.objects.active = head
    before = mesh_vertices(head.data)
    with pytest.raises(RuntimeError, match="its lips are not sewn together"):
        bpy.ops.risorius.cut_lips()
    np.testing.assert_array_equal(mesh_vertices(head.data), before)
    bpy.context.view_layer.objects.active = scan
    cut(scan)
    with pytest.raises(RuntimeError, match="its lips are not sewn together"):
        bpy.ops.risorius.cut_lips()


def test_doubled_vertices_at_the_mouth_are_refused_with_the_remedy(scan: Any) -> None:
    bpy.context.view_layer.objects.active = scan
    scan.shape_key_clear()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.edge_split(type="EDGE")
    bpy.ops.object.mode_set(mode="OBJECT")
    count = len(scan.data.vertices)
    with pytest.raises(RuntimeError, match="doubled vertices at the mouth: merge them first"):
        bpy.ops.risorius.cut_lips()
    assert len(scan.data.vertices) == count


@pytest.mark.slow
def test_finding_and_baking_say_what_is_sewn(scan: Any, capsys: pytest.CaptureFixture[str]) -> None:
    bpy.ops.risorius.forget_points()
    assert bpy.ops.risorius.find_points() == {"FINISHED"}
    assert read_kept(scan).sewn == {"mouth"}
    scan.risorius.emotion.word = "surprise"
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    assert read_own(scan.data).clips
    cut(scan)
    assert read_kept(scan).sewn == frozenset()
