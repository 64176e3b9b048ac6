"""What makes a face another one, and what does not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix
from risorius.errors import SceneError
from risorius.face.mesh.parts import Part
from risorius.scene import mesh as meshes
from risorius.scene.companions import Companion
from risorius.scene.faces import read_face
from risorius.scene.fingerprint import fingerprint
from risorius.scene.points.kept import forget_points, read_kept, write_kept

pytestmark = pytest.mark.smoke


@pytest.fixture
def eye() -> Any:
    """A ball, for an eye apart from the head."""
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.012, location=(0.03, -0.08, 0.04))
    return bpy.context.object


def move_a_vertex(head: Any, eye: Any) -> None:
    head.data.vertices[7].co.x += 1e-4


def move_the_basis(head: Any, eye: Any) -> None:
    head.shape_key_add(name="Basis")
    head.data.shape_keys.key_blocks[0].data[7].co.x += 1e-4


def turn_a_polygon(head: Any, eye: Any) -> None:
    head.data.polygons[3].flip()


def delete_a_polygon(head: Any, eye: Any) -> None:
    import bmesh

    shape = bmesh.new()
    shape.from_mesh(head.data)
    shape.faces.ensure_lookup_table()
    bmesh.ops.delete(shape, geom=[shape.faces[0]], context="FACES_ONLY")
    shape.to_mesh(head.data)
    shape.free()


def move_a_point(head: Any, eye: Any) -> None:
    kept = read_kept(head)
    moved = replace(kept.points["8.4"], vertices=kept.points["8.3"].vertices, weights=kept.points["8.3"].weights)
    write_kept(head, replace(kept, points={**kept.points, "8.4": moved}))


def forget_a_point(head: Any, eye: Any) -> None:
    kept = read_kept(head)
    write_kept(head, replace(kept, points={name: point for name, point in kept.points.items() if name != "11.1"}))


def correct_a_part(head: Any, eye: Any) -> None:
    parts = meshes.read_parts(head.data)
    parts[5] = int(Part.OTHER)
    meshes.write_parts(head.data, parts)


def tell_no_parts(head: Any, eye: Any) -> None:
    meshes.remove_parts(head.data)


def set_a_shape_key(head: Any, eye: Any) -> None:
    head.shape_key_add(name="Basis")
    key = head.shape_key_add(name="mine")
    key.data[3].co.x += 0.1
    key.value = 0.7


def stretch(head: Any, eye: Any) -> None:
    head.scale.z = 1.01


def change_units(head: Any, eye: Any) -> None:
    bpy.context.scene.unit_settings.scale_length = 0.01


def move_the_eye(head: Any, eye: Any) -> None:
    eye.location.x += 1e-4


def turn_the_eye(head: Any, eye: Any) -> None:
    eye.rotation_euler.z += 0.1


def shape_the_eye(head: Any, eye: Any) -> None:
    eye.data.vertices[0].co *= 1.1


@pytest.mark.parametrize(
    "change",
    [
        move_a_vertex,
        move_the_basis,
        turn_a_polygon,
        delete_a_polygon,
        move_a_point,
        forget_a_point,
        correct_a_part,
        tell_no_parts,
        set_a_shape_key,
        stretch,
        change_units,
        move_the_eye,
        turn_the_eye,
        shape_the_eye,
    ],
)
def test_what_makes_another_face(head: Any, eye: Any, change: Callable[[Any, Any], None]) -> None:
    before = fingerprint(head, [Companion(eye, Part.EYEBALL_L)])
    change(head, eye)
    bpy.context.view_layer.update()
    assert not fingerprint(head, [Companion(eye, Part.EYEBALL_L)]).matches(before)


def test_companions_are_part_of_it(head: Any, eye: Any) -> None:
    alone, left, right = (
        fingerprint(head, companions)
        for companions in ([], [Companion(eye, Part.EYEBALL_L)], [Companion(eye, Part.EYEBALL_R)])
    )
    assert len({alone.digest, left.digest, right.digest}) == 3
    assert not left.matches(right)


def test_what_leaves_it_the_same_face(head: Any, eye: Any) -> None:
    companions = [Companion(eye, Part.EYEBALL_L)]
    eye.parent = head
    bpy.context.view_layer.update()
    before = fingerprint(head, companions)
    head.shape_key_add(name="Basis")
    unused, muted = head.shape_key_add(name="unused"), head.shape_key_add(name="muted")
    unused.value = 0.0  # newer Blenders add keys with 1
    muted.value, muted.mute = 0.7, True
    for key in (unused, muted):
        key.data[3].co.x += 0.1
    head.modifiers.new("Subdivision", "SUBSURF")
    head.data.materials.append(bpy.data.materials.new("mine"))
    head.name, head.data.name, eye.name = "Other", "Others", "Ball"
    head["mine"] = head.data["mine"] = 3.0
    head.select_set(False)
    bpy.context.scene.frame_set(17)
    kept = read_kept(head)
    unsure = {name: replace(point, confidence=0.1) for name, point in kept.points.items()}
    write_kept(head, replace(kept, points=unsure, score=0.9))
    assert fingerprint(head, companions).matches(before)


def test_where_a_head_is_and_how_it_is_turned_leaves_it_the_same_face(head: Any, eye: Any) -> None:
    companions = [Companion(eye, Part.EYEBALL_L)]
    eye.parent = head
    head.scale = (1.1, 1.2, 0.9)
    bpy.context.view_layer.update()
    before = fingerprint(head, companions)
    for angles in np.random.default_rng(3).uniform(-np.pi, np.pi, (40, 3)):
        turned = Euler(angles).to_matrix().to_4x4()
        head.matrix_world = Matrix.Translation(angles * 2.0) @ turned @ Matrix.Diagonal((1.1, 1.2, 0.9, 1.0))
        bpy.context.view_layer.update()
        assert fingerprint(head, companions).matches(before)


def test_a_copy_is_the_same_face_and_reading_tells_the_same(head: Any) -> None:
    copy = head.copy()
    copy.data = head.data.copy()
    bpy.context.collection.objects.link(copy)
    copy.location.x = 1.0
    bpy.context.view_layer.update()
    assert fingerprint(copy).matches(fingerprint(head))
    assert read_face(head).fingerprint.matches(fingerprint(head))


def test_without_points_there_is_no_face(head: Any) -> None:
    forget_points(head)
    with pytest.raises(SceneError, match="feature points"):
        fingerprint(head)
