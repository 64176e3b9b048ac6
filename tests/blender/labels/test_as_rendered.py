"""Labels tell what renders show, whatever the viewport shows; and what is seen through glass."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.scene.bake import Target, shape_keys
from risorius.scene.bake.motion import FapMotion
from risorius.scene.faces import read_face
from risorius.scene.jobs.labelling import Labels, begin
from risorius.scene.jobs.subjects import Subject
from risorius.scene.labels.clear import clear_slots
from risorius.scene.labels.rendered import as_rendered
from risorius.scene.labels.stage import Stage, stage_of
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.look import Engine, Look
from risorius.scene.pictures.studio import studio

SMALL = Look(width=64, height=64)


def labelled(head: Any, folder: Path, others: tuple[Any, ...] = (), look: Look = SMALL, frames: int = 1) -> Path:
    """Labels of a resting head, without a render."""
    motion = FapMotion(np.zeros((frames, 68)))
    labelling = begin(Labels(folder / "labels", 1), Subject(Target(head)), motion, start=1)
    with studio([head, *others], framing_of(head), look) as scene:
        for frame in range(1, frames + 1):
            labelling.look(scene, frame)
    return labelling.write(look)


def rows(folder: Path, name: str) -> list[dict[str, str]]:
    with (folder / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def staged(head: Any) -> Stage:
    """The head as a studio's renders show it."""
    with studio([head], framing_of(head), SMALL) as scene:
        scene.view_layers[0].update()
        with as_rendered(scene):
            return stage_of(scene, read_face(head).pieces)


def wall(name: str = "Wall") -> Any:
    """A wall before the face."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(-1.0, -0.4, -1.0), (1.0, -0.4, -1.0), (1.0, -0.4, 1.0), (-1.0, -0.4, 1.0)], [], [(0, 1, 2, 3)])
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def glass(kind: str) -> Any:
    """A material of one kind that lets light through."""
    material = bpy.data.materials.new(kind)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    out, shader = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new(kind)
    tree.links.new(shader.outputs[0], out.inputs["Surface"])
    return material


def test_smoothing_is_that_of_renders_and_everything_is_as_it_was(head: Any) -> None:
    smooth = head.modifiers.new("Smooth", "SUBSURF")
    smooth.levels, smooth.render_levels = 0, 1
    told = staged(head)
    assert (smooth.levels, smooth.render_levels, smooth.show_viewport) == (0, 1, True)
    smooth.levels = 1
    assert len(staged(head).shown.vertices) == len(told.shown.vertices)
    smooth.show_viewport = False
    assert len(staged(head).shown.vertices) == len(told.shown.vertices)
    assert not smooth.show_viewport
    smooth.show_render = False
    assert len(staged(head).shown.vertices) == len(head.data.vertices)


@pytest.mark.slow
def test_a_smoothed_head_at_rest_shows_no_faps(head: Any, tmp_path: Path) -> None:
    head.modifiers.new("Smooth", "SUBSURF").render_levels = 1
    folder = labelled(head, tmp_path)
    achieved = [float(row["achieved"]) for row in rows(folder, "faps") if row["achieved"]]
    assert len(achieved) > 40
    assert np.abs(achieved).max() < 0.1
    assert rows(folder, "frames")[0]["recognised"] == "neutral"


@pytest.mark.slow
def test_what_is_hidden_in_the_viewport_alone_hides_the_face(head: Any, tmp_path: Path) -> None:
    other = wall()
    other.hide_viewport = True
    folder = labelled(head, tmp_path, (other,))
    assert all(row["hidden"] == "true" for row in rows(folder, "landmarks") if row["in_picture"] == "true")
    assert other.hide_viewport


@pytest.mark.slow
def test_what_cameras_do_not_see_hides_nothing_but_in_workbench(head: Any, tmp_path: Path) -> None:
    other = wall()
    other.visible_camera = False
    folder = labelled(head, tmp_path, (other,), Look(width=64, height=64, engine=Engine.CYCLES))
    assert any(row["visible"] == "true" for row in rows(folder, "landmarks"))
    folder = labelled(head, tmp_path, (other,))
    assert not any(row["visible"] == "true" for row in rows(folder, "landmarks"))


@pytest.mark.slow
def test_an_object_keeps_its_number_while_others_come_and_go(head: Any, tmp_path: Path) -> None:
    first, last = wall("A"), wall("Z")
    first.location.y = last.location.y = 3.0  # behind the head
    last.location.y = 2.0
    for frame, hidden in ((1, True), (2, False)):
        first.hide_render = hidden
        first.keyframe_insert("hide_render", frame=frame)
    folder = labelled(head, tmp_path, (first, last), frames=2)
    names = json.loads((folder / "card.json").read_text(encoding="utf-8"))["objects"]
    assert set(names) == {head.name, "A", "Z"}
    for frame in (1, 2):
        image = bpy.data.images.load(str(folder / f"pictures/objects/{frame:05d}.png"))
        image.colorspace_settings.name = "Non-Color"
        shown = set(np.rint(np.array(image.pixels[:])[::4] * 65535.0).astype(int).tolist()) - {0}
        bpy.data.images.remove(image)
        assert {names[number - 1] for number in shown} == {head.name, "Z"}


@pytest.mark.parametrize("kind", ["ShaderNodeBsdfGlass", "ShaderNodeBsdfTransparent", "ShaderNodeBsdfRefraction"])
def test_glass_is_looked_through_where_it_is_drawn_as_such(head: Any, kind: str) -> None:
    other = wall()
    assert not clear_slots(other, workbench=False).any()
    other.data.materials.append(glass(kind))
    assert clear_slots(other, workbench=False).all()
    assert not clear_slots(other, workbench=True).any()  # Workbench draws its colour, which covers
    other.data.materials[0].diffuse_color[3] = 0.1
    assert clear_slots(other, workbench=True).all()


def test_a_cornea_of_mixed_shaders_is_clear_and_a_card_of_hair_is_not(head: Any) -> None:
    other = wall()
    material = glass("ShaderNodeMixShader")
    other.data.materials.append(material)
    tree = material.node_tree
    mix = next(node for node in tree.nodes if node.type == "MIX_SHADER")
    clear, shine = tree.nodes.new("ShaderNodeBsdfTransparent"), tree.nodes.new("ShaderNodeBsdfAnisotropic")
    tree.links.new(clear.outputs[0], mix.inputs[1])
    tree.links.new(shine.outputs[0], mix.inputs[2])
    edge = tree.nodes.new("ShaderNodeFresnel")
    link = tree.links.new(edge.outputs[0], mix.inputs[0])
    assert clear_slots(other, workbench=False).all()
    tree.links.remove(link)
    for share, expected in ((0.1, True), (0.9, False)):
        mix.inputs[0].default_value = share
        assert clear_slots(other, workbench=False).all() == expected
    tree.links.new(tree.nodes.new("ShaderNodeTexImage").outputs[0], mix.inputs[0])
    assert not clear_slots(other, workbench=False).any()


@pytest.mark.slow
def test_an_iris_is_seen_through_a_cornea(head: Any, tmp_path: Path) -> None:
    """A shell of glass before both eyes, as characters have it: iris and pupil are those of the eye behind."""
    look = Look(width=160, height=160, engine=Engine.CYCLES)
    shell = wall()
    shell.data.materials.append(glass("ShaderNodeBsdfGlass"))
    folder = labelled(head, tmp_path, (shell,), look)
    irises = [row for row in rows(folder, "landmarks") if row["set"] == "mediapipe478" and int(row["index"]) >= 468]
    assert sum(row["visible"] == "true" for row in irises) > 5
    image = bpy.data.images.load(str(folder / "pictures/areas/00001.png"))
    image.colorspace_settings.name = "Non-Color"
    areas = set(np.rint(np.array(image.pixels[:])[::4] * 255.0).astype(int).tolist())
    assert {9, 12} <= areas
    assert 16 not in areas


@pytest.mark.slow
def test_shut_lids_leave_no_gap_and_hide_the_irises(head: Any, tmp_path: Path) -> None:
    asked = np.full(68, np.nan)
    asked[[18, 19]], asked[[20, 21]] = 1100.0, 200.0
    shape_keys.write_keys(head, "shut", {"shut": np.asarray(api.default_face().pose(asked).positions)})
    for value, opening in ((0.0, 1.0), (1.0, 0.0)):
        head.data.shape_keys.key_blocks["shut"].value = value
        folder = labelled(head, tmp_path, look=Look(width=160, height=160, yaw=0.0))
        (frame,) = rows(folder, "frames")
        assert float(frame["eye_opening_left"]) == pytest.approx(opening, abs=0.03)
        assert float(frame["eye_opening_right"]) == pytest.approx(opening, abs=0.03)
        marks = rows(folder, "landmarks")
        irises = [row["visible"] for row in marks if row["set"] == "mediapipe478" and int(row["index"]) >= 468]
        pupils = [row["visible"] for row in marks if row["name"] in ("3.5", "3.6")]
        if value:
            assert {*irises, *pupils} == {"false"}
        else:
            assert irises.count("true") >= 8
            assert set(pupils) == {"true"}


@pytest.mark.slow
def test_what_lies_close_before_an_eyeball_hides_its_pupil(head: Any, tmp_path: Path) -> None:
    """As lids do that are thinner than what hides a mark of the skin."""
    front = float(api.default_face().points["3.5"].position[1])
    lid = wall("Thin lid")
    lid.location.y = front - 3e-4 + 0.4
    folder = labelled(head, tmp_path, (lid,), Look(width=160, height=160, yaw=0.0))
    pupils = [row for row in rows(folder, "landmarks") if row["name"] in ("3.5", "3.6") and row["set"] == "mpeg4"]
    assert [(row["in_picture"], row["hidden"], row["visible"]) for row in pupils] == [("true", "true", "false")] * 2
