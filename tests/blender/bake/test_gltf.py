"""A face exported as glTF comes back with its clips: their names, lengths and apexes."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.errors import SceneError
from risorius.scene import gltf
from risorius.scene import mesh as meshes
from risorius.scene.gltf import clips_of, export_gltf


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


def test_an_armature_and_its_weights_go_along(head: Any, tmp_path: Path) -> None:
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


def test_a_file_without_the_face_is_not_called_exported(
    joy_and_fear: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def write_nothing(path: str) -> None:
        text = json.dumps({"asset": {"version": "2.0"}}).encode()
        Path(path).write_bytes(b"glTF" + bytes(8) + len(text).to_bytes(4, "little") + b"JSON" + text)

    exporter = SimpleNamespace(gltf=lambda **options: write_nothing(options["filepath"]))
    ops = SimpleNamespace(export_scene=exporter)
    monkeypatch.setattr(gltf, "bpy", SimpleNamespace(context=bpy.context, data=bpy.data, ops=ops))
    with pytest.raises(SceneError, match="holds no mesh"):
        export_gltf([joy_and_fear], tmp_path / "face.glb")
