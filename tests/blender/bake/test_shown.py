"""A face whose shape keys make it what it is is posed as it shows, and the user's keys stay as they are."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.operators.bake.settings import stale_clips
from risorius.progress import run
from risorius.scene import bake
from risorius.scene import mesh as meshes
from risorius.scene.blendshape_keys import write_blendshapes
from risorius.scene.faces import read_face
from risorius.scene.fingerprint import fingerprint
from risorius.scene.live.live_face import LiveFace
from risorius.scene.live.reading import FaceReader
from risorius.scene.shape_mix import resting_values


def give_key(obj: Any, name: str, positions: np.ndarray, value: float = 0.0) -> Any:
    """A shape key of the user's, positions (V, 3)."""
    if obj.data.shape_keys is None:
        obj.shape_key_add(name="Basis", from_mix=False)
    key = obj.shape_key_add(name=name, from_mix=False)
    key.data.foreach_set("co", positions.astype(np.float32).ravel())
    key.slider_min, key.slider_max = -2.0, 2.0
    key.value = value
    return key


def one(head: Any, basis: np.ndarray, shown: np.ndarray) -> None:
    give_key(head, "macro", shown, 1.0)


def shares(head: Any, basis: np.ndarray, shown: np.ndarray) -> None:
    give_key(head, "a", basis + 2.0 * (shown - basis), 0.3)
    give_key(head, "b", basis + 0.8 * (shown - basis), 0.5)
    give_key(head, "muted", basis + 1.0, 1.0).mute = True
    give_key(head, "unused", basis - 1.0, 0.0)


def relative(head: Any, basis: np.ndarray, shown: np.ndarray) -> None:
    other = give_key(head, "other", basis + 0.3)
    give_key(head, "macro", basis + 0.3 + (shown - basis) / 0.7, 0.7).relative_key = other


def grouped(head: Any, basis: np.ndarray, shown: np.ndarray) -> None:
    group = head.vertex_groups.new(name="half")
    group.add(list(range(0, len(basis), 2)), 0.5, "REPLACE")
    group.add(list(range(1, len(basis), 2)), 1.0, "REPLACE")
    change = shown - basis
    change[::2] *= 2.0
    give_key(head, "macro", basis + change, 1.0).vertex_group = "half"


def driven(head: Any, basis: np.ndarray, shown: np.ndarray) -> None:
    key = give_key(head, "macro", shown)
    head["age"] = 0.5
    driver = key.driver_add("value").driver
    variable = driver.variables.new()
    variable.targets[0].id, variable.targets[0].data_path = head, '["age"]'
    driver.expression = "2 * var"


def keyed_once(head: Any, basis: np.ndarray, shown: np.ndarray) -> None:
    give_key(head, "macro", shown, 1.0).keyframe_insert("value", frame=1)


@pytest.fixture
def base(head: Any) -> tuple[np.ndarray, np.ndarray]:
    """The default head's vertices, and another form of it: a wide child's head with a high forehead."""
    shown = meshes.rest_vertices(head.data)
    basis = shown * np.array([1.25, 1.05, 0.9]) + np.array([0.0, 0.02, 0.05])
    basis[:, 2] += 0.15 * np.maximum(shown[:, 2] - shown[:, 2].mean(), 0.0)
    return basis, shown


Making = Callable[[Any, np.ndarray, np.ndarray], None]


@pytest.fixture
def morphed(head: Any, base: tuple[np.ndarray, np.ndarray], request: pytest.FixtureRequest) -> Any:
    """The default head as it shows, its mesh another form; its points found on what shows."""
    basis, shown = base
    points = dict(api.build_default_head().points)
    head.data.vertices.foreach_set("co", basis.astype(np.float32).ravel())
    make: Making = getattr(request, "param", one)
    make(head, basis, shown)
    bpy.context.view_layer.update()
    meshes_points = {n: (p if isinstance(p, int | np.integer) else tuple(p)) for n, p in points.items()}
    from risorius.scene.points.stored import store_points

    store_points(head, {n: int(p) if isinstance(p, np.integer) else p for n, p in meshes_points.items()})
    return head


@pytest.mark.parametrize("morphed", [one, shares, relative, grouped, driven, keyed_once], indirect=True)
def test_the_rest_is_what_shows(morphed: Any, base: tuple[np.ndarray, np.ndarray]) -> None:
    np.testing.assert_allclose(meshes.evaluated_vertices(morphed), base[1], atol=2e-6)
    np.testing.assert_allclose(meshes.rest_vertices(morphed.data), base[1], atol=2e-6)
    np.testing.assert_allclose(meshes.basis_vertices(morphed.data), base[0], atol=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("morphed", [one, driven], indirect=True)
def test_a_bake_shows_the_pose_of_what_shows(morphed: Any, base: tuple[np.ndarray, np.ndarray]) -> None:
    before = {k.name: (k.value, k.mute, k.slider_max) for k in morphed.data.shape_keys.key_blocks}
    drivers = [curve.driver.expression for curve in _drivers(morphed)]
    morphed.risorius.emotion.word = "surprise"
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    again = {k.name: (k.value, k.mute, k.slider_max) for k in morphed.data.shape_keys.key_blocks if k.name in before}
    assert again == before
    assert [curve.driver.expression for curve in _drivers(morphed)] == drivers
    profile = api.expression("surprise", activation=morphed.risorius.emotion.activation)
    wanted = api.default_face().pose(profile.frame(), emotion=profile.weights).positions
    bpy.context.scene.frame_set(20)
    np.testing.assert_allclose(meshes.evaluated_vertices(morphed), wanted, atol=1e-5)
    # what was baked is no part of the rest, whatever frame is shown
    np.testing.assert_allclose(meshes.rest_vertices(morphed.data), base[1], atol=2e-6)
    target = bake.Target(morphed)
    face = LiveFace(target)
    face.show(target, face.pose(profile.frame(), drive="natural", emotion=profile.weights, exact=True).displacement)
    bpy.context.view_layer.update()
    np.testing.assert_allclose(meshes.evaluated_vertices(morphed), wanted, atol=1e-5)


def _drivers(obj: Any) -> list[Any]:
    """Drivers of an object's shape keys."""
    animation = obj.data.shape_keys.animation_data
    return [] if animation is None else list(animation.drivers)


@pytest.mark.slow
def test_a_change_of_the_users_values_is_noticed_and_said(morphed: Any) -> None:
    morphed.risorius.emotion.word = "joy"
    bpy.ops.risorius.bake_expression()
    before = read_face(morphed).fingerprint
    assert not stale_clips(morphed, bpy.context.scene)
    bpy.context.scene.frame_set(18)
    assert fingerprint(morphed).matches(before)
    morphed.data.shape_keys.key_blocks["macro"].value = 0.9
    assert not fingerprint(morphed).matches(before)
    assert list(stale_clips(morphed, bpy.context.scene)) == ["joy"]
    assert bake.remarks.shown_remarks(morphed) == (
        f"{morphed.name}: posed on the face as it shows, with 1 shape key (macro)",
    )


def test_keys_that_are_animated_are_a_motion_and_no_form(morphed: Any, base: tuple[np.ndarray, np.ndarray]) -> None:
    talking = give_key(morphed, "talking", base[0] + 0.01)
    for frame, value in ((1, 0.0), (11, 1.0)):
        talking.value = value
        talking.keyframe_insert("value", frame=frame)
    bpy.context.scene.frame_set(11)
    assert list(resting_values(morphed.data)) == ["macro"]
    np.testing.assert_allclose(meshes.rest_vertices(morphed.data), base[1], atol=2e-6)
    said = bake.remarks.shown_remarks(morphed)
    assert said[1] == f"{morphed.name}: animation of 1 shape key (talking) adds to the bake"


@pytest.mark.slow
def test_engine_shapes_are_those_of_what_shows(
    morphed: Any, base: tuple[np.ndarray, np.ndarray], tmp_path: Any
) -> None:
    table = tmp_path / "few.toml"
    table.write_text("[keys.blink]\nfaps = { 19 = 900, 20 = 900 }\n")
    wanted = api.arkit_shapes(api.default_face(), table)["blink"]
    for replace in (False, True):
        run(write_blendshapes(bake.Target(morphed), table, replace=replace))
        key = morphed.data.shape_keys.key_blocks["blink"]
        key.value = 1.0
        bpy.context.view_layer.update()
        np.testing.assert_allclose(meshes.evaluated_vertices(morphed), wanted, atol=1e-5)


@pytest.mark.slow
def test_a_form_is_no_expression_and_a_key_set_later_is_one(morphed: Any, base: tuple[np.ndarray, np.ndarray]) -> None:
    graph = bpy.context.evaluated_depsgraph_get
    assert FaceReader(morphed).read(graph()).is_resting
    joy = api.default_face().pose(api.archetype("joy", 0).frame()).positions - base[1]
    give_key(morphed, "mine", base[0] + joy, 1.0)
    bpy.context.view_layer.update()
    reading = FaceReader(morphed).read(graph(), rule="robust")
    assert not reading.is_resting
    assert reading.beliefs.best == "joy"


@pytest.mark.slow
def test_a_form_makes_no_creases(morphed: Any) -> None:
    morphed.risorius.bake.creases = True
    bpy.ops.risorius.bake_expression()
    bpy.context.scene.frame_set(1)
    shown = morphed.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    strain = np.empty(len(shown.vertices), dtype=np.float32)
    shown.attributes["risorius_strain"].data.foreach_get("value", strain)
    assert np.abs(strain).max() < 1e-3


def human(shared: Path, name: str) -> Any:
    """The shared MakeHuman head: its raw base with the form as a live key, or the form applied."""
    data = np.load(shared / "heads" / "makehuman.npz")
    base, form = (data[key].astype(np.float64) for key in ("vertices_base", "vertices"))
    mesh = meshes.new_mesh(name, form if name == "applied" else base, data["loops"], data["face_sizes"])
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    if name == "live":
        give_key(obj, "$md-universal-$fe-$yn", form, 1.0)
    return obj


@pytest.mark.slow
def test_a_human_whose_form_is_a_key_shows_what_one_shows_whose_form_is_applied(shared: Path) -> None:
    lids = json.loads((shared / "heads" / "makehuman.fp.json").read_text())["points"]
    skin = np.load(shared / "heads" / "makehuman.npz")["labels"] == 0
    shown: dict[str, np.ndarray] = {}
    for name in ("applied", "live"):
        obj = human(shared, name)
        obj.risorius.emotion.word = "surprise"
        bpy.ops.risorius.find_points()
        bpy.ops.risorius.bake_expression()
        bpy.context.scene.frame_set(20)
        shown[name] = meshes.evaluated_vertices(obj)
    assert np.linalg.norm(shown["live"] - shown["applied"], axis=1)[skin].max() < 1e-4
    bpy.ops.risorius.make_shapes()
    bpy.context.scene.frame_set(1)
    rest = meshes.evaluated_vertices(obj)
    for side in ("Left", "Right"):
        obj.data.shape_keys.key_blocks[f"eyeBlink{side}"].value = 1.0
    bpy.context.view_layer.update()
    shut = meshes.evaluated_vertices(obj)
    gap, left = (np.linalg.norm(each[lids["3.1"]] - each[lids["3.3"]]) for each in (rest, shut))
    assert left < 0.35 * gap
