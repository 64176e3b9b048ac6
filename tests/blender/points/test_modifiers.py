"""Feature points on what shows: under Subdivision Surface, Armature and shape keys, and put down there."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from risorius.scene.points import bound as points_bound
from risorius.scene.points import carried as points_carried
from risorius.scene.points import kept as points_kept
from risorius.scene.points import seen as points_seen

pytestmark = pytest.mark.smoke

TURN = Matrix.Rotation(0.7, 4, "Z") @ Matrix.Translation((0.03, 0.0, 0.02))


@pytest.fixture
def posed(head: Any) -> Any:
    """The head turned by a rig whose one bone moves it all, with a subdivision above."""
    bpy.ops.object.armature_add()
    rig = bpy.context.object
    head.vertex_groups.new(name="Bone").add(range(len(head.data.vertices)), 1.0, "REPLACE")
    head.modifiers.new("Rig", "ARMATURE").object = rig
    subdivision = head.modifiers.new("Subdivision", "SUBSURF")
    subdivision.levels, subdivision.show_viewport = 1, False
    bone = rig.pose.bones["Bone"]
    bone.matrix = TURN @ bone.bone.matrix_local
    bpy.context.view_layer.objects.active = head
    bpy.context.view_layer.update()
    return head


def visible(obj: Any) -> points_seen.Visible:
    bpy.context.view_layer.update()
    return points_seen.Visible.of(obj, bpy.context.evaluated_depsgraph_get())


def turned(place: np.ndarray) -> np.ndarray:
    world = np.array(TURN)
    moved: np.ndarray = world[:3, :3] @ place + world[:3, 3]
    return moved


def test_points_go_with_the_pose(posed: Any) -> None:
    kept = points_kept.read_kept(posed)
    seen = visible(posed).places(kept)
    for name in ("9.3", "8.4", "2.1"):
        np.testing.assert_allclose(seen[name], turned(np.array(kept.points[name].at)), atol=1e-4)


def test_points_go_with_the_pose_on_other_polygons(posed: Any) -> None:
    kept = points_kept.read_kept(posed)
    posed.modifiers["Subdivision"].show_viewport = True
    points_carried.carry_rest(posed)
    now = visible(posed)
    assert not now.same_polygons
    seen = now.places(kept)
    far = {name: np.linalg.norm(seen[name] - turned(np.array(point.at))) for name, point in kept.points.items()}
    assert max(far[name] for name in ("9.3", "8.3", "8.4", "4.3", "5.1", "3.5")) < 3e-3
    inverse = posed.matrix_world.inverted()
    for name in ("9.3", "8.4"):
        _, near, _, _ = now.shown.closest_point_on_mesh(inverse @ Matrix.Translation(seen[name]).translation)
        np.testing.assert_allclose(near, seen[name], atol=1e-5)


def test_without_resting_places_points_go_to_the_nearest_of_what_shows(head: Any) -> None:
    kept = points_kept.read_kept(head)
    head.modifiers.new("Subdivision", "SUBSURF").levels = 1
    now = visible(head)
    assert not now.same_polygons
    seen = now.places(kept)
    assert np.linalg.norm(seen["9.3"] - np.array(kept.points["9.3"].at)) < 3e-3
    _, near, _, _ = now.shown.closest_point_on_mesh(seen["9.3"])
    np.testing.assert_allclose(near, seen["9.3"], atol=1e-6)


def test_what_is_put_down_on_other_polygons_is_kept_on_the_resting_mesh(posed: Any) -> None:
    posed.modifiers["Subdivision"].show_viewport = True
    points_carried.carry_rest(posed)
    surface, kept = points_bound.Surface.of(posed.data), points_kept.read_kept(posed)
    now = visible(posed)
    front = np.array(TURN)[:3, :3] @ np.array([0.0, 1.0, 0.0])
    for name in ("9.3", "5.3"):
        seen = now.places(kept)[name]
        hit = now.hit(seen - 0.1 * front, front, surface)
        assert hit is not None
        assert np.linalg.norm(hit - np.array(kept.points[name].at)) < 1.5e-3
        np.testing.assert_allclose(now.shown_place(hit, surface), seen, atol=1.5e-3)


def test_showing_points_lets_blender_carry_resting_places_only_where_that_is_needed(head: Any) -> None:
    head.add_rest_position_attribute = False
    bpy.ops.risorius.jump_to_point(point="9.3")
    assert not head.add_rest_position_attribute
    head.modifiers.new("Subdivision", "SUBSURF").levels = 1
    bpy.context.view_layer.update()
    bpy.ops.risorius.jump_to_point(point="9.3")
    assert head.add_rest_position_attribute
