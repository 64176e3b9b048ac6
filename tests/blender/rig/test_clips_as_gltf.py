"""Clips on a character's own keys come into glTF as animations of its own morph targets, and come back."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from environments import SetUpError
from gltf_validator import validate
from risorius import cli
from risorius.progress import run
from risorius.scene.bake import ClipTiming, Target
from risorius.scene.gltf import export_gltf
from risorius.scene.mesh import evaluated_vertices
from risorius.scene.rig import bake_expressions_onto, bone_rig, key_rig
from risorius.scene.rig.baking import Expression

#: The character's keys: name -> FAPs that each shows at 1.
DRAWN = {"Smile": {6: 200.0, 7: 200.0, 12: 150.0, 13: 150.0}, "Jaw": {3: 400.0}, "Brows": {31: 150.0, 32: 150.0}}


@pytest.fixture
def character(head: Any) -> Any:
    """The default head with three keys of its own, one that its user keeps at a half, and one that is muted."""
    face = api.default_face()
    head.shape_key_add(name="Basis")
    for name, faps in DRAWN.items():
        frame = np.full(68, np.nan)
        frame[[number - 1 for number in faps]] = list(faps.values())
        key = head.shape_key_add(name=name, from_mix=False)
        key.value = 0.0
        key.data.foreach_set("co", face.pose(frame, drive="exact").positions.astype(np.float32).ravel())
    head.shape_key_add(name="Younger", from_mix=False).value = 0.5
    head.shape_key_add(name="Old", from_mix=False).mute = True
    return head


def bake(head: Any, *words: str, start: float = 11.0, find: Any = key_rig) -> None:
    """One clip per word, each two seconds after the last, at 25 frames per second."""
    expressions = []
    for number, word in enumerate(words):
        profile, timing = api.expression(word), ClipTiming(0.4, 0.8, 0.4, start=start + 50.0 * number, fps=25.0)
        expressions.append(Expression(word, profile.frame(), timing, 1.0, profile.weights))
    bpy.context.scene.render.fps = 25
    run(bake_expressions_onto(Target(head), expressions, find))


def state(head: Any) -> Any:
    """What must be the same before and after."""
    keys = head.data.shape_keys
    tracks = [(track.name, [strip.name for strip in track.strips]) for track in keys.animation_data.nla_tracks]
    blocks = [(block.name, block.value, block.mute) for block in keys.key_blocks]
    kinds = ("objects", "meshes", "actions", "scenes", "shape_keys")
    names = {kind: sorted(block.name for block in getattr(bpy.data, kind)) for kind in kinds}
    return names, tracks, blocks, keys.animation_data.action


def weights_at(clip: str, frame: int) -> dict[str, float]:
    """Values of the keys of the only face in the file, in one clip."""
    (face,) = (obj for obj in bpy.data.objects if obj.type == "MESH" and len(obj.data.vertices) > 100)
    came = face.data.shape_keys.animation_data
    came.action = None
    for track in came.nla_tracks:
        track.mute = track.name != clip
    bpy.context.scene.frame_set(frame)
    return {block.name: block.value for block in face.data.shape_keys.key_blocks[1:]}


def document(path: Path) -> dict[str, Any]:
    """The JSON of a .glb."""
    data = path.read_bytes()
    found: dict[str, Any] = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    return found


def refuse_invalid(path: Path) -> None:
    """Fail where Khronos' validator finds an error or a warning."""
    try:
        issues = validate(path)
    except SetUpError as missing:
        pytest.skip(str(missing))
    assert [str(issue) for issue in issues if issue.severity in ("error", "warning")] == []


@pytest.mark.slow
def test_clips_are_animations_of_the_users_own_targets(character: Any, tmp_path: Path) -> None:
    bake(character, "joy", "surprise")
    shown = {}
    for word, frame in (("joy", 31), ("surprise", 81)):
        bpy.context.scene.frame_set(frame)
        shown[word] = {block.name: block.value for block in character.data.shape_keys.key_blocks[1:]}
    before = state(character)
    exported = export_gltf([character], tmp_path / "face.glb")
    assert state(character) == before
    assert (exported.clips, exported.remarks) == (("joy", "surprise"), ())
    refuse_invalid(exported.path)
    (mesh,) = document(exported.path)["meshes"]
    assert mesh["extras"]["targetNames"] == [*DRAWN, "Younger"]
    assert dict(zip(mesh["extras"]["targetNames"], mesh["weights"], strict=True)) == {
        **dict.fromkeys(DRAWN, 0.0),
        "Younger": 0.5,
    }

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.render.fps = 25
    bpy.ops.import_scene.gltf(filepath=str(exported.path))
    for word in ("joy", "surprise"):
        assert weights_at(word, 20) == pytest.approx({n: v for n, v in shown[word].items() if n != "Old"}, abs=1e-4)
        assert weights_at(word, 0) == pytest.approx({**dict.fromkeys(DRAWN, 0.0), "Younger": 0.5}, abs=1e-4)
    assert max(shown["joy"]["Smile"], shown["surprise"]["Jaw"]) > 0.2


@pytest.mark.slow
def test_a_clip_over_an_animation_of_the_users_is_exported_without_it(character: Any, tmp_path: Path) -> None:
    """The user's action says something with the jaw at other frames, and is playing at the current one."""
    jaw = character.data.shape_keys.key_blocks["Jaw"]
    for frame, value in ((1, 0.0), (200, 0.8)):
        jaw.value = value
        jaw.keyframe_insert("value", frame=frame)
    bake(character, "joy")
    bpy.context.scene.frame_set(200)
    before = state(character)
    exported = export_gltf([character], tmp_path / "face.glb")
    assert state(character) == before
    (mesh,) = document(exported.path)["meshes"]
    assert mesh["weights"] == [0.0, 0.0, 0.0, 0.5]
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.import_scene.gltf(filepath=str(exported.path))
    assert weights_at("joy", 0)["Jaw"] == pytest.approx(0.0, abs=1e-4)


@pytest.mark.slow
def test_clips_of_one_name_on_new_keys_and_on_the_rig_are_both_there(character: Any, tmp_path: Path) -> None:
    bake(character, "joy")
    character.risorius.emotion.word = "joy"
    character.risorius.bake.start = 101
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    exported = export_gltf([character], tmp_path / "face.glb")
    assert set(exported.clips) == {"joy", "joy on the rig"}
    assert {animation["name"] for animation in document(exported.path)["animations"]} == set(exported.clips)


@pytest.mark.slow
def test_the_button_and_the_verb_export_them(
    character: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bake(character, "joy")
    bpy.context.view_layer.objects.active = character
    bpy.context.scene.risorius.film.model = str(tmp_path / "button.glb")
    assert bpy.ops.risorius.export_gltf() == {"FINISHED"}
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "face.blend"), check_existing=False)
    out = tmp_path / "verb.glb"
    command = ["export", "gltf", "--mesh", str(tmp_path / "face.blend"), "--no-morph-normals", "--out", str(out)]
    assert cli.main([*command, "--json"]) == 0
    printed = capsys.readouterr().out
    assert json.loads(printed[printed.index("{") :])["clips"] == ["joy"]
    button, verb = document(tmp_path / "button.glb"), document(out)
    assert [animation["name"] for animation in button["animations"]] == ["joy"]
    assert [animation["name"] for animation in verb["animations"]] == ["joy"]


@pytest.mark.slow
def test_a_clip_that_nothing_plays_is_named(character: Any, tmp_path: Path) -> None:
    bake(character, "joy", "surprise")
    animation = character.data.shape_keys.animation_data
    for track in animation.nla_tracks:
        for strip in [strip for strip in track.strips if strip.action.name.endswith("surprise")]:
            track.strips.remove(strip)
    exported = export_gltf([character], tmp_path / "face.glb")
    assert exported.clips == ("joy",)
    assert "surprise" in exported.remarks[0]


def test_a_file_without_clips_is_refused_by_the_verb(
    head: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "face.blend"), check_existing=False)
    out = tmp_path / "face.glb"
    assert cli.main(["export", "gltf", "--mesh", str(tmp_path / "face.blend"), "--out", str(out)]) == 1
    assert "bake one first" in capsys.readouterr().err
    assert not out.exists()


def shown_apex(name: str) -> np.ndarray:
    """(V, 3) how the only face of the file shows in the middle of a clip, against the clip's beginning."""
    (face,) = (obj for obj in bpy.data.objects if obj.type == "MESH" and len(obj.data.vertices) > 100)
    owners = [obj for obj in bpy.data.objects if obj.animation_data]
    owners += [face.data.shape_keys] if face.data.shape_keys and face.data.shape_keys.animation_data else []
    for owner in owners:
        owner.animation_data.action = None
        for track in owner.animation_data.nla_tracks:
            track.mute = track.name != name
    seen = []
    for frame in (0, 20):
        bpy.context.scene.frame_set(frame)
        seen.append(evaluated_vertices(face))
    return seen[1] - seen[0]


@pytest.mark.slow
def test_clips_on_bones_are_animations_of_the_armature(rigged: SimpleNamespace, tmp_path: Path) -> None:
    head = rigged.head
    bake(head, "joy", "surprise", find=bone_rig)
    bpy.context.scene.frame_set(11)
    rest = evaluated_vertices(head)
    bpy.context.scene.frame_set(31)
    joy = evaluated_vertices(head) - rest
    before = [(bone.name, tuple(bone.location)) for bone in rigged.bones], len(bpy.data.objects), len(bpy.data.actions)
    exported = export_gltf([head], tmp_path / "face.glb")
    after = [(bone.name, tuple(bone.location)) for bone in rigged.bones], len(bpy.data.objects), len(bpy.data.actions)
    assert after == before
    assert set(exported.clips) == {"joy", "surprise"}
    written = document(exported.path)
    assert {animation["name"] for animation in written["animations"]} == {"joy", "surprise"}
    assert {node["name"] for node in written["nodes"]} == {head.name, "Rig", *(bone.name for bone in rigged.bones)}
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.render.fps = 25
    bpy.ops.import_scene.gltf(filepath=str(exported.path))
    came = shown_apex("joy")
    assert np.abs(came).max() == pytest.approx(np.abs(joy).max(), rel=0.05)
    assert np.abs(came).max() > 0.003


@pytest.mark.slow
def test_keys_that_a_rig_drives_move_in_its_clips(rigged: SimpleNamespace, tmp_path: Path) -> None:
    """The corner of the mouth has a key that its bone drives, as many faces have."""
    head, bone = rigged.head, rigged.bones["corner.L"]
    bone.lock_rotation = bone.lock_scale = (True, True, True)
    head.shape_key_add(name="Basis")
    key = head.shape_key_add(name="Dimple", from_mix=False)
    key.value = 0.0
    driver = key.driver_add("value").driver
    variable = driver.variables.new()
    variable.type = "TRANSFORMS"
    target = variable.targets[0]
    target.id, target.bone_target, target.transform_type = rigged.rig, "corner.L", "LOC_Z"
    target.transform_space = "LOCAL_SPACE"
    driver.expression = f"min(1.0, abs({variable.name}) * 100.0)"
    bake(head, "joy", find=bone_rig)
    bpy.context.scene.frame_set(31)
    apex = head.data.shape_keys.key_blocks["Dimple"].value
    assert apex > 0.1
    export_gltf([head], tmp_path / "face.glb")
    assert len(head.data.shape_keys.animation_data.drivers) == 1
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.render.fps = 25
    bpy.ops.import_scene.gltf(filepath=str(tmp_path / "face.glb"))
    assert weights_at("joy", 20)["Dimple"] == pytest.approx(apex, abs=0.02)
    assert weights_at("joy", 0)["Dimple"] == pytest.approx(0.0, abs=0.02)
