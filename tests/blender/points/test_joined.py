"""A face joined into another object: its points are kept on request, or the loss is said."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.errors import SceneError
from risorius.scene import mesh as meshes
from risorius.scene.points import bound as points_bound
from risorius.scene.points import joined as points_joined
from risorius.scene.points import kept as points_kept
from risorius.scene.points.kept import Origin

pytestmark = pytest.mark.smoke


def places(obj: Any) -> dict[str, np.ndarray]:
    """Where points are in the world."""
    world = np.array(obj.matrix_world)
    local = points_bound.places(points_kept.read_kept(obj), meshes.rest_vertices(obj.data))
    return {name: world[:3, :3] @ place + world[:3, 3] for name, place in local.items()}


def join(*others: Any, into: Any) -> Any:
    bpy.context.view_layer.update()
    bpy.ops.object.select_all(action="DESELECT")
    for obj in (*others, into):
        obj.select_set(True)
    bpy.context.view_layer.objects.active = into
    bpy.ops.object.join()
    return into


def body() -> Any:
    bpy.ops.mesh.primitive_uv_sphere_add(location=(0.0, 0.2, -1.5))
    obj = bpy.context.object
    obj.rotation_euler, obj.scale = (0.4, 0.5, 0.6), (2.0, 2.0, 2.0)
    return obj


def test_points_of_a_face_that_was_joined_in_are_taken_over(head: Any) -> None:
    head.location, head.rotation_euler, head.scale = (0.1, 0.2, 0.3), (0.0, 0.1, 0.7), (1.5, 1.5, 1.5)
    surface = points_bound.Surface.of(head.data)
    dragged = points_bound.moved(
        points_kept.read_kept(head), "4.3", places(head)["4.3"], surface, Origin.DRAGGED
    )  # somewhere else on the skin
    points_kept.write_kept(head, dragged)
    bpy.context.view_layer.update()
    before = places(head)
    bpy.ops.mesh.primitive_cube_add(location=(3.0, 0.0, 0.0))
    whole = join(head, bpy.context.object, into=body())
    assert not points_kept.has_points(whole)
    assert bpy.ops.risorius.take_over_points() == {"FINISHED"}
    after = places(whole)
    assert set(after) == set(before)
    assert max(np.linalg.norm(after[name] - before[name]) for name in before) < 1e-4
    assert points_kept.read_kept(whole).points["4.3"].origin is Origin.DRAGGED
    assert not bpy.ops.risorius.take_over_points.poll()


def test_what_has_points_or_no_room_is_offered_nothing(head: Any, cube: Any) -> None:
    assert points_joined.may_be_joined(cube) == []
    bpy.data.objects.remove(head)
    assert points_joined.may_be_joined(cube) == []
    assert not bpy.ops.risorius.take_over_points.poll()


def test_a_mesh_of_its_own_does_not_get_the_points_of_one_that_was_deleted(head: Any) -> None:
    bpy.data.objects.remove(head)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=160, ring_count=120)
    other = bpy.context.object
    assert points_joined.may_be_joined(other)
    with pytest.raises(SceneError, match="contains no face whose points can be restored: press Find Face"):
        points_joined.take_over_points(other)
    assert not points_kept.has_points(other)


def test_after_the_file_was_opened_again_they_are_lost(head: Any, tmp_path: Path) -> None:
    whole = join(head, into=body()).name
    assert points_joined.may_be_joined(bpy.data.objects[whole])
    path = str(tmp_path / "joined.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert points_joined.may_be_joined(bpy.data.objects[whole]) == []
