"""What is refused, with the object and the remedy in the message, and the scene as it was."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.errors import FormatError, SceneError
from risorius.face.mesh.point_files import read_point_file
from risorius.operators.classes import CLASSES
from risorius.scene import bake, refusals
from risorius.scene.bake import shape_keys
from risorius.scene.bake.remarks import remarks
from risorius.scene.points.kept import has_points
from risorius.scene.points.stored import store_points, stored_points

pytestmark = pytest.mark.smoke


def bake_key(obj: Any, **options: Any) -> None:
    from risorius.progress import run

    run(
        bake.bake_expression(
            bake.Target(obj, **options),
            np.zeros(68),
            clip="joy",
            timing=bake.ClipTiming(onset=0.1, apex=0.1, offset=0.1),
        )
    )


def test_no_object() -> None:
    with pytest.raises(SceneError, match="default head"):
        bake_key(None)
    assert not bpy.ops.risorius.bake_expression.poll()
    with pytest.raises(RuntimeError, match="select the mesh of a face") as refused:
        bpy.ops.risorius.bake_expression()
    assert "Traceback" not in str(refused.value)


@pytest.mark.parametrize("active", ["nothing", "empty", "cube"])
def test_every_button_says_whether_it_works_whatever_is_active(active: str) -> None:
    if active == "empty":
        bpy.ops.object.empty_add()
    if active == "cube":
        bpy.ops.mesh.primitive_cube_add()
    polled = [cls for cls in CLASSES if hasattr(cls, "refusal")]
    assert len(polled) > 30
    for cls in polled:
        reason = cls.refusal(bpy.context)
        assert reason is None or (isinstance(reason, str) and reason), cls.__name__


def test_not_a_mesh() -> None:
    bpy.ops.object.empty_add()
    with pytest.raises(SceneError, match="Empty: is a empty, not a mesh"):
        bake_key(bpy.context.object)


def test_an_empty_mesh() -> None:
    obj = bpy.data.objects.new("Nothing", bpy.data.meshes.new("Nothing"))
    bpy.context.collection.objects.link(obj)
    with pytest.raises(SceneError, match="Nothing: has no polygons"):
        bake_key(obj)


def test_vertices_that_are_not_numbers(head: Any) -> None:
    head.data.vertices[7].co.x = float("nan")
    with pytest.raises(SceneError, match=r"vertex 7 .*Edit Mode"):
        bake_key(head)
    assert head.data.shape_keys is None


def test_no_feature_points(cube: Any) -> None:
    with pytest.raises(SceneError, match=r"no feature points: find the face"):
        bake_key(cube)


def test_points_for_another_mesh(head: Any, cube: Any) -> None:
    with pytest.raises(SceneError, match="wrong file for the mesh"):
        store_points(cube, stored_points(head))
    assert not has_points(cube)


def test_points_that_an_edited_mesh_has_no_place_for(head: Any) -> None:
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    bpy.ops.transform.translate(value=(1.0, 0.0, 0.0))
    bpy.ops.object.mode_set(mode="OBJECT")
    with pytest.raises(SceneError, match=r"2\.1, .*were lost: find or import them again"):
        bake_key(head)


def test_missing_and_swapped_points(head: Any) -> None:
    points = stored_points(head)
    store_points(head, {name: point for name, point in points.items() if name != "8.4"})
    with pytest.raises(RuntimeError, match=r"8\.4"):
        bpy.ops.risorius.bake_expression()
    store_points(head, {**points, "8.4": points["8.3"], "8.3": points["8.4"]})
    with pytest.raises(RuntimeError, match=r"8\.3 and 8\.4 are swapped"):
        bpy.ops.risorius.bake_expression()
    assert head.data.shape_keys is None
    assert len(bpy.data.actions) == 0


@pytest.mark.parametrize(("mode", "word"), [("EDIT", "Edit Mode"), ("SCULPT", "Sculpt Mode")])
def test_modes_that_hold_the_mesh(head: Any, mode: str, word: str) -> None:
    bpy.ops.object.mode_set(mode=mode)
    with pytest.raises(SceneError, match=rf"{word}: go to Object Mode \(Tab\)"):
        bake_key(head)
    assert not bpy.ops.risorius.bake_expression.poll()
    bpy.ops.object.mode_set(mode="OBJECT")


def test_linked_data(head: Any, tmp_path: Path) -> None:
    path = tmp_path / "library.blend"
    bpy.data.libraries.write(str(path), {head})
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(path), link=True) as (there, here):
        here.objects = list(there.objects)
    linked = here.objects[0]
    bpy.context.collection.objects.link(linked)
    with pytest.raises(SceneError, match="make it local"):
        bake_key(linked)


@pytest.mark.slow
def test_a_shared_mesh_is_refused_or_made_single_user(head: Any) -> None:
    twin = bpy.data.objects.new("Twin", head.data)
    bpy.context.collection.objects.link(twin)
    with pytest.raises(SceneError, match=r"shares its mesh with Twin.*Make Single User"):
        bake_key(head)
    assert not bpy.ops.risorius.bake_expression.poll()
    head.risorius.face.make_single_user = True
    assert bpy.ops.risorius.bake_expression.poll()
    bake_key(head, make_single_user=True)
    assert twin.data.shape_keys is None
    assert shape_keys.has_own(head)


class Counted:
    """All objects of a file; counts how often all of them are gone through."""

    def __init__(self) -> None:
        self.times = 0

    def get(self, name: str) -> Any:
        return bpy.data.objects.get(name)

    def __iter__(self) -> Any:
        self.times += 1
        return iter(bpy.data.objects)


def test_no_button_goes_through_all_objects_of_the_file(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    counted = Counted()
    monkeypatch.setattr(refusals, "bpy", SimpleNamespace(data=SimpleNamespace(objects=counted)))
    head.data.use_fake_user = True
    assert refusals.reason(head) is None
    assert counted.times == 0
    twins = {f"Twin {number}": bpy.data.objects.new(f"Twin {number}", head.data) for number in (1, 2)}
    told = {refusals.sharer_of(head) for _ in range(3)}
    assert counted.times == len(told) == 1
    twins.pop(str(told.pop())).data = head.data.copy()
    (other,) = twins
    assert f"shares its mesh with {other}" in str(refusals.reason(head))
    bpy.data.objects.remove(twins[other])
    assert refusals.reason(head) is None
    assert counted.times == 2


def test_absolute_keys(head: Any) -> None:
    head.shape_key_add(name="Basis")
    head.data.shape_keys.use_relative = False
    with pytest.raises(SceneError, match="absolute shape keys: turn on Relative"):
        bake_key(head)


def test_mirrored_and_flat_objects(head: Any) -> None:
    head.scale.x = -1.0
    bpy.context.view_layer.update()
    with pytest.raises(SceneError, match="mirrored"):
        bake_key(head)
    head.scale.x = 0.0
    bpy.context.view_layer.update()
    with pytest.raises(SceneError, match="scale of zero along an axis"):
        bake_key(head)


def test_an_object_named_as_two_parts(head: Any, cube: Any) -> None:
    from risorius.face.mesh.parts import Part
    from risorius.scene.companions import Companion

    with pytest.raises(SceneError, match="two parts"):
        bake_key(head, companions=(Companion(cube, Part.EYEBALL_L), Companion(cube, Part.EYEBALL_R)))


def test_a_bake_tells_that_dense_skin_is_solved_on_a_share_of_its_vertices(
    head: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    from risorius.face import anatomy
    from risorius.scene.faces import face_of, read_face

    face = face_of(read_face(head))
    assert not face.is_thinned
    assert not any("dense" in line for line in remarks(head, face))
    monkeypatch.setattr(anatomy, "MOST", 1000)
    (said,) = (line for line in remarks(head, face) if "dense" in line)
    assert "off by about 0.5 %" in said
    assert "7 % at the worst vertex" in said


def test_what_is_fine_is_remarked_on(head: Any) -> None:
    assert remarks(head) == ()
    head.modifiers.new("Subdivision", "SUBSURF").levels = 1
    head.shape_key_add(name="Basis")
    head.shape_key_add(name="mine", from_mix=False).value = 0.5
    bpy.context.view_layer.update()
    said = " ".join(remarks(head))
    assert "modifiers change the vertex count" in said
    assert "posed on the face as it shows, with 1 shape key (mine)" in said


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("{", "line 1: is not JSON"),
        ("[1]", "must be an object"),
        ("{}", "no feature points"),
        ('{"8.4": "left"}', r"key 8\.4: must be a vertex index"),
        ('{"8.4": -1}', r"key 8\.4"),
        ('{"8.4": [1, 2]}', r"key 8\.4"),
    ],
)
def test_a_wrong_file_of_points_names_the_place(tmp_path: Path, cube: Any, text: str, match: str) -> None:
    path = tmp_path / "points.json"
    path.write_text(text)
    with pytest.raises(FormatError, match=match):
        read_point_file(path)
    with pytest.raises(RuntimeError, match=r"points\.json"):
        bpy.ops.risorius.import_points(filepath=str(path))
    assert not has_points(cube)


def test_points_are_imported_and_saved_with_the_object(tmp_path: Path, cube: Any) -> None:
    path = tmp_path / "points.json"
    table = {"points": {"8.4": 3, "8.3": 1}, "xyz": {"3.5": [0, 1, 2.5]}, "no_vertex": ["3.5", "7.1"]}
    path.write_text(json.dumps(table))
    assert bpy.ops.risorius.import_points(filepath=str(path)) == {"FINISHED"}
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    cube = bpy.data.objects["Cube"]
    assert stored_points(cube) == {"8.4": 3, "8.3": 1, "3.5": (0.0, 1.0, 2.5)}
    bpy.context.view_layer.objects.active = cube
    assert bpy.ops.risorius.forget_points() == {"FINISHED"}
    assert not has_points(cube)
