"""The operators for feature points, as a script presses them; and what the list and the overlay show."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix, Vector
from risorius.mpeg4 import FEATURE_POINTS
from risorius.operators.points import clicks as clicked
from risorius.operators.points import diagram, drag, ops, overlay, panel
from risorius.scene import mesh as meshes
from risorius.scene.points import bound as points_bound
from risorius.scene.points import kept as points_kept
from risorius.scene.points import mirrored as points_mirrored
from risorius.scene.points import seen as points_seen
from risorius.scene.points.kept import Origin
from risorius.scene.points.stored import stored_points

S6 = tuple(clicked.ASKED)


def places(obj: Any) -> dict[str, np.ndarray]:
    return points_bound.places(points_kept.read_kept(obj), meshes.rest_vertices(obj.data))


@pytest.fixture
def stranger(head: Any) -> tuple[Any, dict[str, np.ndarray]]:
    """The default head's skin as a strange mesh, Y-up and in centimetres, its object turned; and its points."""
    known = places(head)
    parts = meshes.read_parts(head.data)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    head.data.vertices.foreach_set("select", parts != 0)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.delete(type="VERT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.quads_convert_to_tris()
    bpy.ops.object.mode_set(mode="OBJECT")
    turn = Matrix.Scale(100.0, 4) @ Matrix.Rotation(np.radians(-90.0), 4, "X")
    head.data.transform(turn)
    head.rotation_euler = Euler((0.3, 0.2, 1.0))
    head.scale = (0.01, 0.01, 0.01)
    bpy.context.view_layer.update()
    points_kept.forget_points(head)
    return head, {name: np.array(turn @ Vector(place)) for name, place in known.items()}


@pytest.fixture
def shown(head: Any) -> Any:
    """The default head with its points shown."""
    state = bpy.context.window_manager.risorius.points
    state.show = True
    return head


@pytest.mark.slow
def test_the_face_of_a_stranger_is_found_and_bakes_without_a_file(stranger: tuple[Any, dict[str, np.ndarray]]) -> None:
    obj, truth = stranger
    assert bpy.ops.risorius.find_points() == {"FINISHED"}
    kept = points_kept.read_kept(obj)
    assert {point.origin for point in kept.points.values()} == {Origin.FOUND}
    found = places(obj)
    lips = [np.linalg.norm(found[name] - truth[name]) / 100.0 for name in ("8.3", "8.4", "2.2", "2.3", "3.7", "3.12")]
    assert max(lips) < 4e-3
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    assert obj.data.shape_keys is not None


@pytest.mark.slow
def test_clicks_of_a_script_are_kept_where_they_are(stranger: tuple[Any, dict[str, np.ndarray]]) -> None:
    obj, truth = stranger
    clicks = {name: truth[name].tolist() for name in S6}
    assert bpy.ops.risorius.click_points(clicks=json.dumps(clicks)) == {"FINISHED"}
    kept = points_kept.read_kept(obj)
    assert {name for name, point in kept.points.items() if point.origin is Origin.CLICKED} == set(S6)
    assert np.linalg.norm(places(obj)["9.3"] - truth["9.3"]) < 0.05


@pytest.mark.slow
def test_what_is_no_face_is_refused_with_score_and_remedy_and_nothing_is_kept(cube: Any) -> None:
    with pytest.raises(RuntimeError, match=r"Cube: .*score \d.*click its feature points 3\.7, 3\.12"):
        bpy.ops.risorius.find_points()
    assert not points_kept.has_points(cube)
    with pytest.raises(RuntimeError, match="Clicks: are missing"):
        bpy.ops.risorius.click_points()


@pytest.mark.parametrize(
    ("clicks", "said"),
    [
        ("", "Clicks: are missing: give them as JSON"),
        ("3.7", "Clicks: contain no points"),
        ("[1, 2, 3]", "Clicks: contain no points"),
        ("{}", "Clicks: contain no points"),
        ('{"3.7": [0, 0, 0]', "Clicks: are not JSON .*delimiter"),
        ('{"3.7": [0, 1]}', r"clicks 3\.7 must be three finite coordinates, but it is \[0, 1\]"),
        ('{"3.7": null}', r"clicks 3\.7 must be three finite coordinates, but it is None"),
        ('{"3.7": [0, 0, NaN]}', r"clicks 3\.7 must be three finite coordinates"),
        ('{"99.9": [0, 0, 0]}', r"99\.9 is not a feature point"),
    ],
)
def test_clicks_of_a_script_that_cannot_be_read_are_refused(cube: Any, clicks: str, said: str) -> None:
    with pytest.raises(RuntimeError, match=said) as refused:
        bpy.ops.risorius.click_points(clicks=clicks)
    assert "Traceback" not in str(refused.value)
    assert not points_kept.has_points(cube)


@pytest.mark.slow
def test_half_a_face_with_a_mirror_modifier_says_so() -> None:
    bpy.ops.mesh.primitive_plane_add()
    bpy.context.object.modifiers.new("Mirror", "MIRROR")
    with pytest.raises(RuntimeError, match="apply the modifier"):
        bpy.ops.risorius.find_points()


def test_work_that_is_closed_early_keeps_nothing(stranger: tuple[Any, dict[str, np.ndarray]]) -> None:
    from risorius.scene.points.found import find_points

    obj, _ = stranger
    work = find_points(obj)
    fractions = [next(work).fraction for _ in range(4)]
    work.close()
    assert fractions == sorted(fractions)
    assert not points_kept.has_points(obj)


def test_dragging_moves_the_counterpart_and_reset_puts_back(head: Any) -> None:
    before = places(head)
    surface = points_bound.Surface.of(head.data)
    plane = points_mirrored.plane_of_points(before)
    target = before["4.3"] + np.array([0.003, 0.0, 0.004])
    kept = drag.with_counterpart(points_kept.read_kept(head), "4.3", target, surface, plane)
    points_kept.write_kept(head, kept)
    now = places(head)
    np.testing.assert_allclose(now["4.3"], surface.nearest(target)[0], atol=1e-6)
    np.testing.assert_allclose(now["4.4"], now["4.3"] * (-1.0, 1.0, 1.0), atol=1e-4)
    assert kept.points["4.4"].origin is Origin.DRAGGED
    assert bpy.ops.risorius.reset_points(which="RIGHT") == {"FINISHED"}
    np.testing.assert_allclose(places(head)["4.4"], before["4.4"])
    assert np.linalg.norm(places(head)["4.3"] - before["4.3"]) > 1e-3
    points_kept.write_kept(head, kept)
    assert bpy.ops.risorius.reset_points(which="ONE", point="4.3") == {"FINISHED"}
    np.testing.assert_allclose(places(head)["4.3"], before["4.3"])
    assert np.linalg.norm(places(head)["4.4"] - before["4.4"]) > 1e-3
    alone = drag.with_counterpart(points_kept.read_kept(head), "4.3", target, surface, None)
    assert alone.points["4.4"] == points_kept.read_kept(head).points["4.4"]


def test_clicks_are_mirrored_on_symmetric_meshes_and_taken_back_together(head: Any) -> None:
    truth, surface = places(head), points_bound.Surface.of(head.data)
    plane = points_mirrored.plane_of_mesh(surface)
    assert plane is not None
    np.testing.assert_allclose(np.abs(plane.normal), (1.0, 0.0, 0.0))
    clicks = clicked.Clicks(surface, plane)
    clicks.add(truth["3.7"], mirror=True)
    assert set(clicks.places) == {"3.7", "3.12"}
    assert np.linalg.norm(clicks.places["3.12"] - truth["3.12"]) < 1e-4
    assert clicks.wanted == "8.3"
    assert clicks.back()
    assert clicks.places == {}
    assert not clicks.back()
    for name in S6:
        assert clicks.wanted == name
        clicks.add(truth[name], mirror=False)
    assert clicks.wanted is None


def test_a_crooked_mesh_is_not_mirrored(head: Any) -> None:
    rest = meshes.rest_vertices(head.data)
    head.data.vertices.foreach_set("co", (rest + 0.3 * np.clip(rest[:, :1], 0, None) * (1, 0, 1)).ravel())
    head.data.transform(Euler((0.4, 0.3, 0.2)).to_matrix().to_4x4())
    assert points_mirrored.plane_of_mesh(points_bound.Surface.of(head.data)) is None


def test_a_click_lands_on_the_surface_that_shows_and_is_kept_on_the_resting_one(head: Any) -> None:
    head.location, head.rotation_euler, head.scale = (1.0, 2.0, 3.0), (0.1, 0.2, 0.3), (2.0, 2.0, 2.0)
    head.shape_key_add(name="Basis")
    lifted = head.shape_key_add(name="lifted", from_mix=False)
    for point in lifted.data:
        point.co.z += 0.05
    for frame, value in ((1, 0.0), (5, 1.0)):
        lifted.value = value
        lifted.keyframe_insert("value", frame=frame)
    bpy.context.scene.frame_set(5)
    surface, nose = points_bound.Surface.of(head.data), places(head)["9.3"]
    world = np.array(head.matrix_world)
    aim = world[:3, :3] @ (nose + np.array([0.0, 0.0, 0.05])) + world[:3, 3]
    ahead = world[:3, :3] @ np.array([0.0, 1.0, 0.0])
    visible = points_seen.Visible.of(head, bpy.context.evaluated_depsgraph_get())
    hit = visible.hit(aim - ahead, ahead, surface)
    assert hit is not None
    np.testing.assert_allclose(hit, nose, atol=1e-5)
    assert visible.hit(aim - ahead + np.array([10.0, 0, 0]), ahead, surface) is None
    seen = visible.places(points_kept.read_kept(head))
    np.testing.assert_allclose(seen["9.3"], aim, atol=1e-5)


def test_points_behind_the_face_are_hidden(head: Any) -> None:
    visible = points_seen.Visible.of(head, bpy.context.evaluated_depsgraph_get())
    seen = visible.places(points_kept.read_kept(head))
    chosen = {name: seen[name] for name in ("9.3", "5.1", "11.6")}
    assert list(visible.hidden(chosen, None, np.array([0.0, -1.0, 0.0]))) == [False, False, True]
    assert list(visible.hidden(chosen, np.array([0.0, 1.0, 0.0]), np.zeros(3))) == [True, True, False]


def test_an_edited_mesh_is_followed_with_a_report(head: Any, tmp_path: Path) -> None:
    assert not bpy.ops.risorius.follow_mesh.poll()
    rest = meshes.rest_vertices(head.data)
    ear = places(head)["10.1"]
    near = np.linalg.norm(rest - ear, axis=1) < 0.02
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    head.data.vertices.foreach_set("select", near)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.delete(type="VERT")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert ops.edited(head)
    assert bpy.ops.risorius.follow_mesh() == {"FINISHED"}
    assert not ops.edited(head)
    assert "10.1" not in points_kept.read_kept(head).points
    assert "9.3" in points_kept.read_kept(head).points


def test_exported_points_are_imported_again(head: Any, tmp_path: Path) -> None:
    path, before = tmp_path / "points.json", stored_points(head)
    assert bpy.ops.risorius.export_points(filepath=str(path)) == {"FINISHED"}
    table = json.loads(path.read_text())
    assert set(table["confidence"]) == set(table["origin"]) == set(before)
    points_kept.forget_points(head)
    assert bpy.ops.risorius.import_points(filepath=str(path)) == {"FINISHED"}
    after = stored_points(head)
    assert set(after) == set(before)
    for name, point in before.items():
        np.testing.assert_allclose(after[name], point, atol=1e-6)


def test_jumping_marks_the_point_and_every_tooltip_says_what_for(shown: Any) -> None:
    assert bpy.ops.risorius.jump_to_point(point="8.4") == {"FINISHED"}
    state = bpy.context.window_manager.risorius.points
    assert state.names[state.active].name == "8.4"
    assert [item.name for item in state.names] == list(FEATURE_POINTS)
    tip = ops.RISORIUS_OT_jump_to_point.description(bpy.context, SimpleNamespace(point="8.4"))
    assert "right corner" in tip
    assert "54 stretch_r_cornerlip_o" in tip
    for name in FEATURE_POINTS:
        assert name in ops.why_needed(name)


def test_the_list_shows_what_the_mesh_has(shown: Any) -> None:
    bpy.ops.risorius.jump_to_point(point="8.4")
    state = bpy.context.window_manager.risorius.points
    listed = SimpleNamespace(filter_name="lip", bitflag_filter_item=1)
    flags, _ = panel.RISORIUS_UL_points.filter_items(listed, bpy.context, state, "names")
    names = {item.name for item, flag in zip(state.names, flags, strict=True) if flag}
    assert {"8.4", "2.2"} <= names
    assert "9.3" not in names
    state.doubtful_only = True
    flags, _ = panel.RISORIUS_UL_points.filter_items(listed, bpy.context, state, "names")
    assert not any(flags)
    state.doubtful_only = False


def test_colours_tell_sure_from_doubtful() -> None:
    assert overlay.confidence_colour(1.0)[:3] == pytest.approx(overlay.SURE)
    assert overlay.confidence_colour(0.0)[:3] == pytest.approx(overlay.WRONG)
    assert overlay.confidence_colour(points_kept.DOUBTFUL)[:3] == pytest.approx(overlay.UNSURE)


def test_the_diagram_marks_the_point_in_its_paper() -> None:
    discs: list[tuple[float, float]] = []
    canvas: Any = SimpleNamespace(box=lambda *_: None, line=lambda *_: None, disc=lambda at, *_: discs.append(at))
    for name in S6:
        diagram.draw_diagram(canvas, (0.0, 0.0), 1.0, name, [])
    spots = dict(zip(S6, discs[1::2], strict=True))
    assert all(0 < x < diagram.WIDTH and 0 < y < diagram.HEIGHT for x, y in discs)
    assert spots["3.7"][0] > spots["9.3"][0] > spots["3.12"][0]
    assert spots["3.7"][1] > spots["9.3"][1] > spots["8.3"][1] > spots["2.1"][1]
