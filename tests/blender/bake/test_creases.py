"""Creases in Blender: the nodes say what the model says, follow what plays, and leave without a trace."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.face.face import Face
from risorius.scene import bake, faces
from risorius.scene import mesh as meshes
from risorius.scene.creases import marks as creases
from risorius.scene.creases import nodes as crease_nodes
from risorius.scene.head import head_object
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.look import Engine, Look
from risorius.scene.pictures.studio import studio


def evaluated(obj: Any, name: str, width: int) -> np.ndarray | None:
    """An attribute of the vertices as a renderer sees it, (V, width)."""
    shown = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    attribute = mesh.attributes.get(name)
    values = np.empty(width * len(mesh.vertices), dtype=np.float32)
    if attribute is not None:
        attribute.data.foreach_get("value" if width == 1 else "vector", values)
    shown.to_mesh_clear()
    if attribute is None:
        return None
    return values.reshape(-1, width).astype(np.float64)


def fullness(obj: Any) -> dict[str, np.ndarray]:
    """(V,) how full each crease is."""
    names = [row.name for row in crease_nodes.seen(crease_nodes.read_creases())]
    found = {name: evaluated(obj, crease_nodes.CREASE + name, 3) for name in names}
    return {name: vectors[:, 1] for name, vectors in found.items() if vectors is not None}


def expression_key(obj: Any, word: str, value: float) -> None:
    """Show only one key."""
    obj.data.shape_keys.animation_data.action = None
    for block in obj.data.shape_keys.key_blocks[1:]:
        block.value = value if block.name == word else 0.0
    bpy.context.view_layer.update()


def traces(obj: Any) -> list[str]:
    """All of ours that could be on an object or in the file."""
    left = [f"modifier {modifier.name}" for modifier in obj.modifiers]
    ours = (crease_nodes.PLACE, crease_nodes.HEAD, crease_nodes.REST)
    left += [f"attribute {a.name}" for a in obj.data.attributes if a.name.startswith(ours)]
    left += ["property"] * (creases.RESTING in obj)
    left += [f"group {group.name}" for group in bpy.data.node_groups if group.bl_idname == "GeometryNodeTree"]
    return left + ["resting positions"] * obj.add_rest_position_attribute


@pytest.fixture
def plain(head: Any) -> Any:
    """A user's head: the same mesh with a material of the user's."""
    obj = head_object(api.build_default_head(), "Mine")
    bpy.context.collection.objects.link(obj)
    obj.data.materials.clear()
    material = bpy.data.materials.new("Mine")
    if material.node_tree is None:
        material.use_nodes = True
    obj.data.materials.append(material)
    data = bpy.data.objects["Risorius Head"].data
    bpy.data.objects.remove(bpy.data.objects["Risorius Head"])
    for mine in list(data.materials):
        bpy.data.materials.remove(mine)
    bpy.data.meshes.remove(data)
    creases.nodes.forget_unused()
    bpy.context.view_layer.objects.active = obj
    return obj


@pytest.mark.slow
@pytest.mark.smoke
def test_the_nodes_say_what_the_model_says(head: Any) -> None:
    head.risorius.emotion.word = "disgust"
    bpy.ops.risorius.bake_expression()
    expression_key(head, "disgust", 1.0)
    built = api.build_default_head()
    model = api.Creases(Face.from_arrays(built.vertices, built.polygons, built.points, built.parts))
    posed = meshes.key_vertices(head.data.shape_keys.key_blocks["disgust"])
    found, expected = fullness(head), model.fullness(posed)
    assert len(found) >= 10
    for name, full in found.items():
        np.testing.assert_allclose(full, expected[name], atol=2e-3, err_msg=name)
    assert found["bunny"].max() > 0.5
    strain = evaluated(head, crease_nodes.STRAIN, 1)
    assert strain is not None
    skin = built.parts == api.Part.SKIN
    np.testing.assert_allclose(strain[skin, 0], model.strain(posed)[skin], atol=1e-4)
    # A hair's end is so small that positions in single precision move its strain.
    np.testing.assert_allclose(strain[:, 0], model.strain(posed), atol=1e-3)


@pytest.mark.slow
@pytest.mark.smoke
def test_creases_follow_the_keys_and_rest_without_them(head: Any) -> None:
    for word in ("surprise", "anger"):
        head.risorius.emotion.word = word
        bpy.ops.risorius.bake_expression()
    assert [modifier.name for modifier in head.modifiers] == [creases.MODIFIER]
    expression_key(head, "surprise", 1.0)
    assert fullness(head)["forehead"].max() > 0.5
    assert fullness(head)["glabella"].max() < 0.1
    expression_key(head, "anger", 1.0)
    assert fullness(head)["glabella"].max() > 0.5
    assert fullness(head)["forehead"].max() < 0.1
    expression_key(head, "none", 0.0)
    assert max(full.max() for full in fullness(head).values()) == 0.0


@pytest.mark.slow
@pytest.mark.smoke
def test_a_saved_file_creases_without_the_extension(head: Any, tmp_path: Path) -> None:
    head.risorius.emotion.word = "anger"
    bpy.ops.risorius.bake_expression()
    path = str(tmp_path / "anger.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    again = bpy.data.objects["Risorius Head"]
    bpy.context.scene.frame_set(1)
    assert fullness(again)["glabella"].max() == 0.0
    bpy.context.scene.frame_set(20)
    assert fullness(again)["glabella"].max() > 0.5
    assert not any(driver for mesh in bpy.data.shape_keys for driver in (mesh.animation_data.drivers or ()))


def test_users_heads_have_none_unless_asked(plain: Any) -> None:
    plain.risorius.emotion.word = "joy"
    bpy.ops.risorius.bake_expression()
    assert traces(plain) == []
    assert not creases.has(plain)


@pytest.mark.slow
@pytest.mark.smoke
def test_off_leaves_no_trace_and_the_users_things_stay(plain: Any) -> None:
    nodes = {node.name for node in plain.data.materials[0].node_tree.nodes}
    mine = plain.data.attributes.new("risorius_mine", "FLOAT", "POINT")
    mine.data.foreach_set("value", np.full(len(plain.data.vertices), 0.5, dtype=np.float32))
    plain.modifiers.new("Smooth", "SUBSURF").levels = 0
    before = [*traces(plain)]
    plain.risorius.bake.creases = True
    bpy.ops.risorius.bake_expression()
    attributes = {a.name for a in plain.data.attributes}
    bpy.ops.risorius.bake_expression()
    assert {a.name for a in plain.data.attributes} == attributes
    assert [modifier.name for modifier in plain.modifiers] == [creases.MODIFIER, "Smooth"]
    offered = crease_nodes.drawing_group()
    assert offered.use_fake_user
    assert {node.name for node in plain.data.materials[0].node_tree.nodes} == nodes
    plain.risorius.bake.creases = False
    bpy.ops.risorius.bake_expression()
    assert traces(plain) == before
    assert not [tree for tree in bpy.data.node_groups if crease_nodes.TABLE in tree]
    assert plain.data.attributes["risorius_mine"].data[0].value == 0.5


@pytest.mark.slow
def test_clearing_everything_takes_the_creases_too(plain: Any) -> None:
    plain.risorius.bake.creases = True
    plain.add_rest_position_attribute = True
    for word in ("joy", "fear"):
        plain.risorius.emotion.word = word
        bpy.ops.risorius.bake_expression()
    bpy.ops.risorius.clear(clip="joy")
    assert creases.has(plain)
    bpy.ops.risorius.clear()
    assert traces(plain) == ["resting positions"]  # the user's own setting


@pytest.mark.slow
def test_a_material_that_draws_them_asks_for_them(plain: Any) -> None:
    node = plain.data.materials[0].node_tree.nodes.new("ShaderNodeGroup")
    node.node_tree = crease_nodes.drawing_group()
    bpy.ops.risorius.bake_expression()
    assert creases.has(plain)


def test_a_failed_bake_writes_no_creases(plain: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    plain.risorius.bake.creases = True

    def broken(*_: Any) -> Any:
        raise api.ModelError("broken")

    monkeypatch.setattr(creases, "prepare", broken)
    with pytest.raises(RuntimeError, match="broken"):
        bpy.ops.risorius.bake_expression()
    assert traces(plain) == []
    assert plain.data.shape_keys is None


@pytest.mark.slow
@pytest.mark.smoke
def test_a_moving_face_creases_as_its_motion_does(head: Any) -> None:
    from risorius.progress import run
    from risorius.scene.bake.motion import CueMotion

    cue = api.Cue(api.expression("anger"), start=0.0, onset=0.3, apex=0.4, offset=0.2)
    run(bake.bake_motion(bake.Target(head), CueMotion([cue]), clip="anger", fps=12.0))
    bpy.context.scene.frame_set(8)
    found = fullness(head)
    source = faces.read_face(head)
    model = api.Creases(faces.face_of(source))
    expected = model.fullness(meshes.evaluated_vertices(head))
    assert found["glabella"].max() > 0.3
    for name, full in found.items():
        np.testing.assert_allclose(full, expected[name], atol=2e-3, err_msg=name)


@pytest.mark.slow
def test_gltf_keeps_the_skins_colour(head: Any, tmp_path: Path) -> None:
    if not hasattr(bpy.ops.export_scene, "gltf"):
        pytest.skip("this Blender has no glTF exporter")
    import json

    bpy.ops.risorius.bake_expression()
    path = tmp_path / "head.gltf"
    bpy.ops.export_scene.gltf(filepath=str(path), export_format="GLTF_SEPARATE")
    written = json.loads(path.read_text())
    skin = next(material for material in written["materials"] if material["name"] == "Risorius skin")
    colour = next(m for m in api.build_default_head().materials if m.name == "skin").colour
    np.testing.assert_allclose(skin["pbrMetallicRoughness"]["baseColorFactor"][:3], colour, atol=1e-3)
    assert written["meshes"][0]["primitives"][0]["targets"]


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "measured"), [("WORKBENCH", False), ("CYCLES", True)])
def test_a_film_that_shows_no_creases_does_not_measure_them(head: Any, engine: str, measured: bool) -> None:
    """Workbench draws none: measuring takes a tenth of the time of a frame."""
    bpy.ops.risorius.bake_expression()
    (modifier,) = head.modifiers
    with studio([head], framing_of(head), Look(engine=Engine(engine), width=64, height=64)):
        assert modifier.show_render is measured
    assert modifier.show_render


def test_they_are_placed_once_for_a_face(head: Any) -> None:
    """Each bake asks for them, and to place them takes longer than all the rest of it."""
    first = creases.prepare(faces.read_face(head), True)
    assert first is not None
    assert creases.prepare(faces.read_face(head), True) is first
    head.scale = (2.0, 2.0, 2.0)
    bpy.context.view_layer.update()
    assert creases.prepare(faces.read_face(head), True) is not first
