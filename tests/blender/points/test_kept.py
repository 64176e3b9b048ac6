"""Feature points kept with a mesh: through saving, appending, duplicating, joining, scaling and editing."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from risorius.errors import SceneError
from risorius.scene import mesh as meshes
from risorius.scene.bake.remarks import remarks
from risorius.scene.points import bound as points_bound
from risorius.scene.points import kept as points_kept
from risorius.scene.points.stored import store_points, stored_points

pytestmark = pytest.mark.smoke


def places(obj: Any) -> dict[str, np.ndarray]:
    """Where the points of an object are now."""
    now = points_bound.followed(points_kept.read_kept(obj), obj.data).kept
    return points_bound.places(now, meshes.rest_vertices(obj.data))


def assert_same(found: dict[str, np.ndarray], expected: dict[str, np.ndarray], within: float = 1e-6) -> None:
    assert set(found) == set(expected)
    worst = max(np.linalg.norm(found[name] - expected[name]) for name in expected)
    assert worst <= within, worst


def edit(obj: Any, *steps: Any) -> None:
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")
    for step in steps:
        step()
    bpy.ops.object.mode_set(mode="OBJECT")


def test_a_position_is_bound_to_the_polygon_it_lies_on(cube: Any) -> None:
    store_points(cube, {"2.1": (1.0, 0.5, -0.5), "8.4": 3, "3.5": (0.0, 0.0, 4.0)})
    kept = points_kept.read_kept(cube).points
    assert 2 <= len(kept["2.1"].vertices) <= 3
    corners = meshes.rest_vertices(cube.data)[list(kept["2.1"].vertices)]
    np.testing.assert_allclose(np.array(kept["2.1"].weights) @ corners, (1.0, 0.5, -0.5), atol=1e-6)
    assert kept["8.4"].vertices == (3,)
    assert not kept["3.5"].is_bound


def test_points_move_with_the_vertices_and_free_ones_with_the_whole(head: Any) -> None:
    before = places(head)
    head.data.transform(Matrix.Diagonal((10.0, 10.0, 2.0, 1.0)) @ Matrix.Translation((0.1, 0.0, 0.3)))
    expected = {n: (p + np.array([0.1, 0.0, 0.3])) * (10.0, 10.0, 2.0) for n, p in before.items()}
    assert not all(point.is_bound for point in points_kept.read_kept(head).points.values())
    assert_same(places(head), expected, within=1e-5)


def test_a_point_follows_its_own_vertices(head: Any) -> None:
    before = places(head)
    held = points_kept.read_kept(head).points["9.3"].vertices
    for vertex in held:
        head.data.vertices[vertex].co.y -= 0.01
    now = places(head)
    np.testing.assert_allclose(now["9.3"], before["9.3"] - (0.0, 0.01, 0.0), atol=1e-6)
    np.testing.assert_allclose(now["11.4"], before["11.4"], atol=1e-6)


def test_applying_the_scale_keeps_them(head: Any) -> None:
    before = places(head)
    head.scale = (3.0, 3.0, 3.0)
    bpy.ops.object.transform_apply(location=False, rotation=False, scale=True)
    assert_same(places(head), {n: 3.0 * p for n, p in before.items()}, within=1e-5)


def test_saved_and_appended_and_linked(head: Any, tmp_path: Path) -> None:
    before, path = places(head), str(tmp_path / "head.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert_same(places(bpy.data.objects["Risorius Head"]), before)
    for link in (False, True):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        with bpy.data.libraries.load(path, link=link) as (there, here):
            here.objects = list(there.objects)
        (loaded,) = here.objects
        assert_same(places(loaded), before)
    with pytest.raises(SceneError, match="mesh from another file: make it local"):
        store_points(loaded, {"2.1": 0})


def test_duplicates_bring_them_and_linked_ones_share_them(head: Any) -> None:
    before = places(head)
    bpy.ops.object.duplicate()
    copy = bpy.context.object
    assert copy != head
    assert_same(places(copy), before)
    points_kept.forget_points(head)
    assert points_kept.has_points(copy)
    bpy.ops.object.duplicate(linked=True)
    assert points_kept.has_points(bpy.context.object)


def test_joining_other_meshes_into_the_head_keeps_them(head: Any) -> None:
    before = places(head)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.3, location=(1.0, 0.0, 0.0))
    ball = bpy.context.object
    bpy.context.view_layer.objects.active = head
    head.select_set(True)
    ball.select_set(True)
    bpy.ops.object.join()
    assert_same(places(head), before, within=1e-4)


def test_a_subdivided_mesh_keeps_them_all(head: Any) -> None:
    before = places(head)
    edit(head, lambda: bpy.ops.mesh.select_all(action="SELECT"), bpy.ops.mesh.subdivide)
    now = points_bound.followed(points_kept.read_kept(head), head.data)
    assert now.moved_on
    assert now.lost == ()
    assert_same(places(head), before, within=2e-4)


def test_what_a_deletion_takes_away_is_lost_by_name(head: Any) -> None:
    lowest = {n for n, p in places(head).items() if p[2] < places(head)["2.3"][2] - 0.03}
    bound = {n for n in lowest if points_kept.read_kept(head).points[n].is_bound}
    assert "2.1" in bound
    limit = places(head)["2.3"][2] - 0.015
    doomed = meshes.rest_vertices(head.data)[:, 2] < limit
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    head.data.vertices.foreach_set("select", doomed)
    edit(head, lambda: bpy.ops.mesh.delete(type="VERT"))
    now = points_bound.followed(points_kept.read_kept(head), head.data)
    assert bound <= set(now.lost)
    assert "9.3" in now.kept.points
    with pytest.raises(SceneError, match=r"2\.1.*were lost"):
        stored_points(head)
    (said,) = remarks(head)
    assert "was edited" in said
    assert "2.1" in said
