"""A face exported as glTF comes back with its clips: their names, lengths and apexes."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
from environments import SetUpError
from gltf_validator import validate
from risorius.errors import SceneError
from risorius.scene import gltf
from risorius.scene import mesh as meshes
from risorius.scene.gltf import export_gltf, write_gltf
from risorius.scene.jobs.shapes import blendshape_file
from risorius.scene.laid_out import clips_of


@pytest.fixture
def joy_and_fear(head: Any) -> Any:
    """The head with two baked expressions."""
    chosen = head.risorius
    chosen.bake.creases = False
    for word in ("joy", "fear"):
        chosen.emotion.word = word
        assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    return head


def state() -> dict[str, Any]:
    """What must be the same before and after."""
    kinds = ("objects", "meshes", "actions", "scenes", "shape_keys")
    return {kind: sorted(block.name for block in getattr(bpy.data, kind)) for kind in kinds}


@pytest.mark.slow
def test_clips_come_back_with_names_lengths_and_apexes(joy_and_fear: Any, tmp_path: Path) -> None:
    head, before = joy_and_fear, state()
    basis = meshes.rest_vertices(head.data)
    keys = head.data.shape_keys
    apexes = {name: meshes.key_vertices(keys.key_blocks[name]) - basis for name in ("joy", "fear")}
    lengths = {name: np.ptp(action.frame_range) for name, action in clips_of(head).items()}
    playing = keys.animation_data.action
    exported = export_gltf([head], tmp_path / "face.glb")
    assert set(exported.clips) == {"joy", "fear"}
    assert state() == before
    assert keys.animation_data.action == playing

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.import_scene.gltf(filepath=str(exported.path))
    (face,) = (obj for obj in bpy.data.objects if obj.type == "MESH")
    assert face.name.startswith("Risorius Head")
    came = face.data.shape_keys.animation_data
    strips = {track.name: track.strips[0] for track in came.nla_tracks}
    assert set(strips) == {"joy", "fear"}
    rest = meshes.rest_vertices(face.data)
    nearest = np.array([np.abs(rest - place).max(axis=1).argmin() for place in basis[::40]])
    came.action = None  # the importer leaves one clip in hand, which would play over the tracks
    for name, strip in strips.items():
        assert strip.action.frame_range[1] - strip.action.frame_range[0] == pytest.approx(lengths[name], abs=0.6)
        for track in came.nla_tracks:
            track.mute = track.name != name
        apex = round(strip.frame_start + 0.5 * lengths[name])
        bpy.context.scene.frame_set(apex)
        moved = sum(key.value * (meshes.key_vertices(key) - rest) for key in face.data.shape_keys.key_blocks[1:])
        np.testing.assert_allclose(moved[nearest], apexes[name][::40], atol=1e-4, err_msg=name)


def test_a_separate_gltf_names_its_animations(joy_and_fear: Any, tmp_path: Path) -> None:
    export_gltf([joy_and_fear], tmp_path / "face.gltf")
    written = json.loads((tmp_path / "face.gltf").read_text())
    assert {animation["name"] for animation in written["animations"]} == {"joy", "fear"}


def test_nothing_baked_is_refused(head: Any, tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="bake one first"):
        export_gltf([head], tmp_path / "face.glb")
    assert not list(tmp_path.iterdir())


def test_the_button_exports_beside_the_file(joy_and_fear: Any, tmp_path: Path) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    bpy.context.scene.risorius.film.model = "//out/mine"
    assert bpy.ops.risorius.export_gltf() == {"FINISHED"}
    assert (tmp_path / "out" / "mine.glb").read_bytes()[:4] == b"glTF"


def test_the_button_is_grey_before_a_bake(head: Any) -> None:
    assert not bpy.ops.risorius.export_gltf.poll()


def document(path: Path) -> dict[str, Any]:
    """The JSON of a .glb."""
    data = path.read_bytes()
    size = int.from_bytes(data[12:16], "little")
    found: dict[str, Any] = json.loads(data[20 : 20 + size])
    return found


@pytest.mark.slow
def test_a_face_under_a_turned_and_scaled_parent_is_in_the_file_where_it_stands(head: Any, tmp_path: Path) -> None:
    root = bpy.data.objects.new("Root", None)
    bpy.context.collection.objects.link(root)
    root.rotation_euler, root.scale = (1.5708, 0.0, 0.0), (0.01,) * 3
    head.parent = root
    bpy.context.view_layer.update()
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    stands, before = np.array(head.matrix_world), state()
    written = document(export_gltf([head], tmp_path / "face.glb").path)
    assert state() == before
    assert head.parent == root
    assert {node.get("name") for node in written["nodes"]} >= {"Root", head.name}

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.import_scene.gltf(filepath=str(tmp_path / "face.glb"))
    bpy.context.view_layer.update()
    (face,) = (obj for obj in bpy.data.objects if obj.type == "MESH")
    np.testing.assert_allclose(np.array(face.matrix_world), stands, atol=1e-6)


def rigged(head: Any) -> None:
    """An armature of one bone that carries the head, which is its child."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new("Head")
    bone.head, bone.tail = (0.0, 0.0, 0.0), (0.0, 0.0, 0.2)
    bpy.ops.object.mode_set(mode="OBJECT")
    head.vertex_groups.new(name="Head").add(range(len(head.data.vertices)), 1.0, "REPLACE")
    head.modifiers.new("Armature", "ARMATURE").object = rig
    head.parent = rig
    bpy.context.view_layer.objects.active = head


@pytest.mark.slow
def test_an_armature_and_its_weights_go_along(head: Any, tmp_path: Path) -> None:
    rigged(head)
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    written = document(export_gltf([head], tmp_path / "face.glb").path)
    assert len(written["skins"]) == len(written["meshes"]) == 1
    assert "JOINTS_0" in written["meshes"][0]["primitives"][0]["attributes"]


def test_clips_begin_at_zero_on_whole_frames(joy_and_fear: Any, tmp_path: Path) -> None:
    joy_and_fear.risorius.emotion.word, joy_and_fear.risorius.bake.start = "anger", 62
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    written = document(export_gltf([joy_and_fear], tmp_path / "face.glb").path)
    fps = bpy.context.scene.render.fps
    assert {animation["name"] for animation in written["animations"]} == {"joy", "fear", "anger"}
    for animation in written["animations"]:
        for sampler in animation["samplers"]:
            times = written["accessors"][sampler["input"]]
            assert times["min"][0] == 0.0
            assert times["max"][0] * fps == pytest.approx(round(times["max"][0] * fps), abs=1e-3)


def test_the_users_own_keys_keep_their_values(joy_and_fear: Any, tmp_path: Path) -> None:
    key = joy_and_fear.shape_key_add(name="younger", from_mix=False)
    key.value = 0.5
    written = document(export_gltf([joy_and_fear], tmp_path / "face.glb").path)
    mesh = written["meshes"][0]
    weights = dict(zip(mesh["extras"]["targetNames"], mesh["weights"], strict=True))
    assert weights == {"joy": 0.0, "fear": 0.0, "younger": 0.5}
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.import_scene.gltf(filepath=str(tmp_path / "face.glb"))
    (face,) = (obj for obj in bpy.data.objects if obj.type == "MESH")
    bpy.context.scene.frame_set(10)
    assert face.data.shape_keys.animation_data.action is not None
    assert face.data.shape_keys.key_blocks["younger"].value == pytest.approx(0.5)


def test_a_file_without_the_face_is_not_called_exported(
    joy_and_fear: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def write_nothing(path: str) -> None:
        text = json.dumps({"asset": {"version": "2.0"}}).encode()
        Path(path).write_bytes(b"glTF" + bytes(8) + len(text).to_bytes(4, "little") + b"JSON" + text)

    exporter = SimpleNamespace(gltf=lambda **options: write_nothing(options["filepath"]))
    ops = SimpleNamespace(export_scene=exporter)
    monkeypatch.setattr(gltf, "bpy", SimpleNamespace(context=bpy.context, data=bpy.data, ops=ops))
    (tmp_path / "face.glb").write_text("the old file")
    with pytest.raises(SceneError, match="holds no mesh"):
        export_gltf([joy_and_fear], tmp_path / "face.glb")
    assert (tmp_path / "face.glb").read_text() == "the old file"


def test_a_file_without_a_clip_or_a_key_is_not_called_exported(joy_and_fear: Any, tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="lacks the shape keys wink: Blender's exporter left them out"):
        write_gltf(tmp_path / "face.glb", ["joy", "wink"])
    with pytest.raises(SceneError, match="lacks the clips sadness"):
        write_gltf(tmp_path / "face.glb", ["joy"], ["sadness"])
    assert not list(tmp_path.iterdir())


def test_names_are_lent_and_given_back_however_long(joy_and_fear: Any, tmp_path: Path) -> None:
    long = "An object whose name is as long as Blender keeps any: 63 bytes."
    joy_and_fear.name = long
    assert joy_and_fear.name == long
    written = document(export_gltf([joy_and_fear], tmp_path / "face.glb").path)
    assert joy_and_fear.name == long
    assert [node["name"] for node in written["nodes"]] == [long]


@pytest.mark.slow
def test_an_armature_of_another_file_goes_along(head: Any, tmp_path: Path) -> None:
    rigged(head)
    library = tmp_path / "rig.blend"
    bpy.data.libraries.write(str(library), {bpy.data.objects["Rig"]})
    bpy.data.objects.remove(bpy.data.objects["Rig"])
    with bpy.data.libraries.load(str(library), link=True) as (_, here):
        here.objects = ["Rig"]
    (rig,) = here.objects
    bpy.context.collection.objects.link(rig)
    head.modifiers["Armature"].object = head.parent = rig
    bpy.context.view_layer.objects.active = head
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    before = state()
    written = document(export_gltf([head], tmp_path / "face.glb").path)
    assert state() == before
    assert len(written["skins"]) == 1
    assert {node["name"] for node in written["nodes"]} >= {"Rig", "Head", head.name}


@pytest.mark.slow
def test_morph_targets_move_the_normals_where_that_is_chosen(joy_and_fear: Any, tmp_path: Path) -> None:
    chosen = bpy.context.scene.risorius.film
    chosen.model = str(tmp_path / "face.glb")
    for wanted in (False, True):
        chosen.morph_normals = wanted
        assert bpy.ops.risorius.export_gltf() == {"FINISHED"}
        targets = [t for part in document(tmp_path / "face.glb")["meshes"][0]["primitives"] for t in part["targets"]]
        assert all(("NORMAL" in target) is wanted for target in targets)
        refuse_invalid(tmp_path / "face.glb")


def refuse_invalid(path: Path) -> None:
    """Fail where Khronos' validator finds an error, or a warning but for what Blender does with every armature."""
    try:
        issues = validate(path)
    except SetUpError as missing:
        pytest.skip(str(missing))
    bad = [issue for issue in issues if issue.severity in ("error", "warning")]
    assert [str(issue) for issue in bad if issue.code != "NODE_SKINNED_MESH_NON_ROOT"] == []


def test_the_validator_bites(tmp_path: Path) -> None:
    path = tmp_path / "bad.gltf"
    path.write_text(json.dumps({"asset": {"version": "2.0"}, "nodes": [{"mesh": 3}]}))
    with pytest.raises(AssertionError, match="UNRESOLVED_REFERENCE"):
        refuse_invalid(path)


def under_a_parent(head: Any) -> list[Any]:
    """A parent that is turned, scaled and walks."""
    root = bpy.data.objects.new("Root", None)
    bpy.context.collection.objects.link(root)
    root.rotation_euler, root.scale = (1.0, 0.2, 0.0), (0.01, 0.02, 0.01)
    root.keyframe_insert("location", frame=1)
    head.parent = root
    return [head]


def with_an_armature(head: Any) -> list[Any]:
    rigged(head)
    return [head]


def on_half_frames(head: Any) -> list[Any]:
    """Clips that begin and end between frames, at a rate that is no whole number."""
    render, bake = bpy.context.scene.render, head.risorius.bake
    render.fps, render.fps_base = 30, 1.001
    bake.start, bake.onset, bake.apex, bake.offset = 62, 0.117, 0.233, 0.349
    return [head]


def of_two_objects(head: Any) -> list[Any]:
    """With an object beside the head, of another material."""
    bpy.ops.mesh.primitive_cube_add(size=0.02)
    cube = bpy.context.object
    cube.data.materials.append(bpy.data.materials.new("Glass"))
    cube.parent = head
    return [head, cube]


def with_keys_of_its_own(head: Any) -> list[Any]:
    """With shape keys, one driven, and an action of the user's, and names of letters outside ASCII."""
    for name in ("Basis", "年", "drøv"):
        head.shape_key_add(name=name, from_mix=False)
    keys = head.data.shape_keys
    keys.key_blocks["年"].keyframe_insert("value", frame=3.5)
    keys.key_blocks["drøv"].driver_add("value").driver.expression = "0.25"
    return [head]


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".glb", ".gltf"])
@pytest.mark.parametrize(
    "made", [under_a_parent, with_an_armature, on_half_frames, of_two_objects, with_keys_of_its_own]
)
def test_a_validator_finds_no_fault_and_the_file_comes_back(head: Any, made: Any, suffix: str, tmp_path: Path) -> None:
    objects = made(head)
    bpy.context.view_layer.objects.active = head
    for word in ("joy", "fear"):
        head.risorius.emotion.word = word
        assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    bpy.context.view_layer.update()
    stands = {obj.name: np.array(obj.matrix_world) for obj in objects}
    path = export_gltf(objects, tmp_path / f"face{suffix}").path
    refuse_invalid(path)

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.import_scene.gltf(filepath=str(path))
    bpy.context.view_layer.update()
    for name, matrix in stands.items():  # a skinned mesh stands for itself, its node stays beside it
        np.testing.assert_allclose(np.array(bpy.data.objects[name].matrix_world), matrix, atol=1e-6)
    face = next(o for o in bpy.data.objects if o.type == "MESH" and o.name.startswith("Risorius Head"))
    assert {"joy", "fear"} <= set(face.data.shape_keys.key_blocks.keys())
    assert {track.name for track in face.data.shape_keys.animation_data.nla_tracks} == {"joy", "fear"}


@pytest.mark.slow
def test_engine_shapes_as_glb_are_valid(tmp_path: Path) -> None:
    blendshape_file(tmp_path / "shapes.glb", names="oculus_visemes")
    refuse_invalid(tmp_path / "shapes.glb")


@pytest.mark.slow
def test_keys_that_ours_drive_move_in_the_clips_under_an_armature(head: Any, tmp_path: Path) -> None:
    """A corrective key at half of joy: it follows in joy's clip and stays at rest in fear's."""
    rigged(head)
    for name in ("Basis", "fix"):
        head.shape_key_add(name=name, from_mix=False)
    for word in ("joy", "fear"):
        head.risorius.emotion.word = word
        assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    keys = head.data.shape_keys
    driver = keys.key_blocks["fix"].driver_add("value").driver
    variable = driver.variables.new()
    variable.targets[0].id_type, variable.targets[0].id = "KEY", keys
    variable.targets[0].data_path = 'key_blocks["joy"].value'
    driver.expression = f"0.5 * {variable.name}"
    export_gltf([head], tmp_path / "face.glb")
    assert len(keys.animation_data.drivers) == 1
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.import_scene.gltf(filepath=str(tmp_path / "face.glb"))
    face = next(obj for obj in bpy.data.objects if obj.type == "MESH" and obj.data.shape_keys is not None)
    came = face.data.shape_keys.animation_data
    came.action = None
    for clip, highest in (("joy", 0.5), ("fear", 0.0)):
        for track in came.nla_tracks:
            track.mute = track.name != clip
        seen = []
        for frame in range(0, 70, 2):
            bpy.context.scene.frame_set(frame)
            seen.append(face.data.shape_keys.key_blocks["fix"].value)
        assert max(seen) == pytest.approx(highest, abs=1e-4)


def test_targets_list_only_the_vertices_that_they_move(joy_and_fear: Any, tmp_path: Path) -> None:
    exported = export_gltf([joy_and_fear], tmp_path / "face.glb")
    written = document(exported.path)
    targets = [target for part in written["meshes"][0]["primitives"] for target in part["targets"]]
    listed = [written["accessors"][target["POSITION"]] for target in targets]
    moving = sum(each["sparse"]["count"] if "sparse" in each else each["count"] for each in listed)
    assert 0 < moving < 0.75 * sum(each["count"] for each in listed)
    assert exported.size.bytes == exported.path.stat().st_size
    assert exported.size.full > 1.08 * exported.size.bytes
    assert f"{exported.size.full / 1e6:.1f} MB with every vertex" in exported.size.line


def test_what_is_beside_a_gltf_counts(joy_and_fear: Any, tmp_path: Path) -> None:
    size = export_gltf([joy_and_fear], tmp_path / "face.gltf", morph_normals=True).size
    assert size.bytes == sum(file.stat().st_size for file in tmp_path.iterdir())
