"""Baking: what the operators write is what the API computes, and nothing of the user's is lost."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from mathutils import Matrix
from risorius.errors import SolverError
from risorius.face.face import Face
from risorius.face.mesh.parts import Part
from risorius.mpeg4 import VARIANTS, default_variant
from risorius.operators.bake.settings import stale_clips
from risorius.progress import run
from risorius.scene import bake, faces
from risorius.scene import mesh as meshes
from risorius.scene.bake import shape_keys
from risorius.scene.bake.action import data_path
from risorius.scene.bake.motion import CueMotion, FapMotion
from risorius.scene.bake.notes import BakeKind
from risorius.scene.fcurves import key_curves
from risorius.scene.points.stored import store_points


def key(obj: Any, name: str) -> np.ndarray:
    return meshes.key_vertices(obj.data.shape_keys.key_blocks[name])


def key_names(obj: Any) -> list[str]:
    return [] if obj.data.shape_keys is None else [block.name for block in obj.data.shape_keys.key_blocks]


def choose(obj: Any, word: str, **bake_settings: Any) -> None:
    obj.risorius.emotion.word = word
    for name, value in bake_settings.items():
        setattr(obj.risorius.bake, name, value)


def snapshot() -> dict[str, Any]:
    """All that a bake could change."""
    return {
        "meshes": {m.name: meshes.rest_vertices(m).tobytes() for m in bpy.data.meshes},
        "keys": {k.name: [(b.name, b.value) for b in k.key_blocks] for k in bpy.data.shape_keys},
        "actions": {a.name for a in bpy.data.actions},
        "objects": {o.name: o.data.name if o.data else "" for o in bpy.data.objects},
        "scenes": set(bpy.data.scenes.keys()),
    }


def split(head: Any) -> dict[str, Any]:
    """The default head with its eyeballs, lower teeth and tongue as objects of their own, turned and scaled."""
    whole = api.build_default_head()
    corners, sizes = meshes.flatten_polygons(whole.polygons)
    first = corners[np.cumsum(sizes) - sizes]
    parts = np.asarray(whole.parts)
    apart = [Part.EYEBALL_L, Part.EYEBALL_R, Part.TEETH_LOWER, Part.TONGUE]
    made = {}
    for part in [None, *apart]:
        kept = ~np.isin(parts, apart) if part is None else parts == part
        number = np.cumsum(kept) - 1
        polygons = [tuple(number[list(p)]) for p, f in zip(whole.polygons, first, strict=True) if kept[f]]
        mesh = meshes.new_mesh(str(part), whole.vertices[kept], *meshes.flatten_polygons(polygons))
        obj = bpy.data.objects.new("Head" if part is None else part.name, mesh)
        bpy.context.collection.objects.link(obj)
        made[obj.name] = obj
        if part is None:
            meshes.write_parts(mesh, parts[kept])
            here = {n for n, p in whole.points.items() if isinstance(p, int) and kept[p]}
            points = {n: int(number[p]) if n in here else tuple(whole.position(n)) for n, p in whole.points.items()}
            store_points(obj, points)
    head_object = made["Head"]
    head_object.risorius.face.eyeball_l = made["EYEBALL_L"]
    head_object.risorius.face.eyeball_r = made["EYEBALL_R"]
    head_object.risorius.face.teeth_lower = made["TEETH_LOWER"]
    head_object.risorius.face.tongue = made["TONGUE"]
    for obj in made.values():
        # The same place in the world by other coordinates: moved, turned, ten times as large, the mesh a tenth.
        obj.data.transform(Matrix.Scale(0.1, 4))
        obj.scale = (10.0, 10.0, 10.0)
    bpy.context.view_layer.update()
    bpy.data.objects.remove(head)
    bpy.context.view_layer.objects.active = head_object
    return made


@pytest.mark.slow
@pytest.mark.smoke
def test_the_operators_key_is_the_apis_pose(head: Any) -> None:
    choose(head, "fear")
    head.risorius.emotion.activation = 6.0
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    built = api.build_default_head()
    face = api.Face.from_arrays(built.vertices, built.polygons, built.points, built.parts)
    profile = api.expression("fear", activation=6.0)
    pose = face.pose(profile.frame(), emotion=profile.weights)
    assert np.linalg.norm(pose.positions - built.vertices, axis=1).max() > 0.003
    np.testing.assert_allclose(key(head, "fear"), pose.positions, atol=1e-6)
    np.testing.assert_allclose(key(head, "Basis"), built.vertices, atol=1e-7)


@pytest.mark.slow
@pytest.mark.smoke
def test_keyframes_follow_onset_apex_offset(head: Any) -> None:
    bpy.context.scene.render.fps = 30
    choose(head, "joy", start=11, onset=0.5, apex=1.0, offset=2.0)
    bpy.ops.risorius.bake_expression()
    block = head.data.shape_keys.key_blocks["joy"]
    values = {}
    for frame in (11, 18, 26, 40, 56, 86, 116, 200):
        bpy.context.scene.frame_set(frame)
        values[frame] = block.value
    assert [values[f] for f in (11, 26, 40, 56, 116, 200)] == pytest.approx([0.0, 1.0, 1.0, 1.0, 0.0, 0.0], abs=1e-6)
    assert 0.2 < values[18] < 0.8
    assert 0.2 < values[86] < 0.8


@pytest.mark.slow
def test_seed_and_variant_reach_the_solver(head: Any) -> None:
    choose(head, "joy")
    shapes = []
    other = next(n for n in VARIANTS["joy"] if n != default_variant("joy"))
    for variant, seed in (("DEFAULT", 0), (str(other), 0), ("DEFAULT", 3)):
        head.risorius.emotion.variant, head.risorius.emotion.seed = variant, seed
        bpy.ops.risorius.bake_expression()
        shapes.append(key(head, "joy"))
    assert key_names(head) == ["Basis", "joy"]
    assert np.abs(shapes[0] - shapes[1]).max() > 1e-4
    assert np.abs(shapes[0] - shapes[2]).max() > 1e-4


@pytest.mark.slow
@pytest.mark.smoke
def test_one_undo_takes_a_bake_back(head: Any) -> None:
    bpy.ops.ed.undo_push(message="start")
    before = snapshot()
    assert bpy.ops.risorius.bake_expression("EXEC_DEFAULT", True) == {"FINISHED"}
    assert key_names(bpy.context.object) == ["Basis", "joy"]
    bpy.ops.ed.undo()
    assert snapshot() == before


@pytest.mark.slow
def test_a_scaled_and_turned_head_gets_the_same_expression(head: Any) -> None:
    bpy.ops.risorius.bake_expression()
    straight = key(head, "joy") - key(head, "Basis")
    bpy.ops.risorius.clear()
    faces.forget_faces()
    head.data.transform(Matrix.Scale(100.0, 4))
    head.scale, head.rotation_euler, head.location = (0.01,) * 3, (0.3, 0.2, 2.0), (5.0, -3.0, 1.0)
    bpy.context.view_layer.update()
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    np.testing.assert_allclose(key(head, "joy") - key(head, "Basis"), 100.0 * straight, atol=100 * 2e-6)


@pytest.mark.slow
def test_a_head_squashed_in_its_mesh_and_stretched_in_its_object_is_the_same_face(head: Any) -> None:
    bpy.ops.risorius.bake_expression()
    straight = key(head, "joy") - key(head, "Basis")
    bpy.ops.risorius.clear()
    faces.forget_faces()
    head.data.transform(Matrix.Diagonal((1.0, 1.0, 0.25, 1.0)))
    head.scale = (1.0, 1.0, 4.0)
    squash = np.array([1.0, 1.0, 0.25])
    bpy.context.view_layer.update()
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    np.testing.assert_allclose(key(head, "joy") - key(head, "Basis"), squash * straight, atol=2e-6)


@pytest.mark.slow
def test_eyes_teeth_and_tongue_in_other_objects_follow(head: Any) -> None:
    choose(head, "surprise")
    bpy.ops.risorius.bake_expression()
    whole, parts = key(head, "surprise") - key(head, "Basis"), np.asarray(api.build_default_head().parts)
    made = split(head)
    obj = made["Head"]
    choose(obj, "surprise")
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    for part in (Part.TEETH_LOWER, Part.TONGUE):
        follower = made[part.name]
        alone = 10.0 * (key(follower, "surprise") - key(follower, "Basis"))
        assert np.abs(alone).max() > 0.001
        np.testing.assert_allclose(alone, whole[parts == part], atol=2e-5)
    users = [o.data.shape_keys.animation_data.action for o in (obj, made["TEETH_LOWER"], made["TONGUE"])]
    assert len(set(users)) == 1
    bpy.ops.risorius.clear()
    assert [o.data.shape_keys for o in made.values()] == [None] * len(made)
    assert "Head surprise" not in bpy.data.actions


@pytest.mark.slow
def test_a_copy_of_a_baked_head_is_a_face_of_its_own(head: Any) -> None:
    bpy.ops.risorius.bake_expression()
    action = head.data.shape_keys.animation_data.action
    twin = head.copy()
    twin.data = head.data.copy()
    bpy.context.collection.objects.link(twin)
    bpy.context.view_layer.objects.active = twin
    choose(twin, "anger")
    bpy.ops.risorius.bake_expression()
    assert key_names(head) == ["Basis", "joy"]
    assert head.data.shape_keys.animation_data.action == action
    assert [c.data_path for c in key_curves(action)] == [data_path("joy")]
    bpy.ops.risorius.clear()
    assert key_names(head) == ["Basis", "joy"]
    assert twin.data.shape_keys is None
    assert action.name in bpy.data.actions


@pytest.mark.slow
def test_clearing_leaves_the_file_as_found(head: Any) -> None:
    before = snapshot()
    bpy.ops.risorius.bake_expression()
    choose(head, "fear")
    bpy.ops.risorius.bake_expression()
    assert bpy.ops.risorius.clear(clip="fear") == {"FINISHED"}
    assert key_names(head) == ["Basis", "joy"]
    bpy.ops.risorius.clear()
    assert snapshot() == before
    assert not bpy.ops.risorius.clear.poll()


@pytest.mark.slow
def test_an_error_of_the_solver_is_reported_and_changes_nothing(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any, **__: Any) -> None:
        raise SolverError("no equilibrium", step=3)

    before = snapshot()
    monkeypatch.setattr(Face, "pose", fail)
    with pytest.raises(RuntimeError, match=r"^Error: no equilibrium \(step 3\)") as refused:
        bpy.ops.risorius.bake_expression()
    assert "Traceback" not in str(refused.value)
    assert snapshot() == before


@pytest.mark.slow
def test_a_cancelled_bake_changes_nothing_at_any_step(head: Any) -> None:
    before = snapshot()
    profile = api.expression("joy")
    timing = bake.ClipTiming(onset=0.1, apex=0.1, offset=0.1)
    frames = api.envelope(profile, onset=0.08, apex=0.08, offset=0.08)
    works = (
        lambda: bake.bake_expression(bake.Target(head), profile.frame(), clip="joy", timing=timing),
        lambda: bake.bake_motion(bake.Target(head), FapMotion(frames), clip="joy"),
    )
    for make in works:
        steps = 0
        for step in range(20):
            work = make()
            try:
                for _ in range(step + 1):
                    next(work)
            except StopIteration:
                break
            work.close()
            steps += 1
            assert snapshot() == before
        assert steps >= 4
        bake.clear(bake.Target(head))


@pytest.mark.slow
@pytest.mark.smoke
def test_a_motion_is_baked_within_a_tenth_of_a_millimetre(head: Any) -> None:
    choose(head, "surprise", onset=0.2, apex=0.1, offset=0.2, start=5)
    assert bpy.ops.risorius.bake_motion() == {"FINISHED"}
    profile = api.expression("surprise")
    chosen = head.risorius.bake
    cue = api.Cue(profile, onset=chosen.onset, apex=chosen.apex, offset=chosen.offset)
    fps = bake.scene_fps()
    source = faces.read_face(head)
    moving = np.stack(list(faces.face_of(source).performance([cue], fps)))
    worst = 0.0
    for index, positions in enumerate(moving):
        bpy.context.scene.frame_set(5 + index)
        worst = max(worst, float(np.linalg.norm(meshes.evaluated_vertices(head) - positions, axis=1).max()))
    assert worst <= 1e-4
    assert np.abs(moving - source.vertices).max() > 0.003
    count = len(key_names(head)) - 1
    assert 1 <= count <= len(moving) // 2
    print(f"{count} shape keys for {len(moving)} frames, {worst * 1000:.3f} mm")


@pytest.mark.slow
def test_a_motion_has_no_more_keys_than_are_allowed_and_says_how_far_it_is_off(head: Any) -> None:
    choose(head, "surprise", onset=0.1, apex=0.04, offset=0.1)
    motion = CueMotion([api.Cue(api.expression("surprise"), onset=0.1, apex=0.04, offset=0.1)])
    made = run(bake.bake_motion(bake.Target(head), motion, clip="few", max_keys=2))
    assert len(made.keys) == 2
    assert made.error > 1e-4
    (line,) = (line for line in made.remarks if line.startswith("few: 2 shape keys show the motion within"))
    assert f"{1000.0 * made.error:.2f} mm" in line
    free = run(bake.bake_motion(bake.Target(head), motion, clip="free"))
    assert len(free.keys) > 2
    assert not any("show the motion within" in line for line in free.remarks)
    head.risorius.bake.max_keys = 1
    assert bpy.ops.risorius.bake_motion() == {"FINISHED"}
    assert len(shape_keys.read_own(head.data).clips["surprise motion"]) == 1
    head.risorius.bake.max_keys = 2
    assert stale_clips(head, bpy.context.scene) == {"surprise motion": BakeKind.MOTION}


@pytest.mark.slow
def test_a_motion_baked_again_replaces_only_itself(head: Any) -> None:
    choose(head, "joy", onset=0.1, apex=0.04, offset=0.1)
    mine = head.shape_key_add(name="Basis") and head.shape_key_add(name="mine", from_mix=False)
    mine.value = 0.5
    bpy.ops.risorius.bake_expression()
    bpy.ops.risorius.bake_motion()
    first = set(key_names(head))
    head.risorius.emotion.activation = 2.0
    bpy.ops.risorius.bake_motion()
    again = key_names(head)
    assert {"Basis", "mine", "joy"} <= first & set(again)
    assert head.data.shape_keys.key_blocks["mine"].value == 0.5
    assert set(shape_keys.read_own(head.data).clips) == {"joy", "joy motion"}
    assert set(again) == {"Basis", "mine", *shape_keys.read_own(head.data).names}
    assert len(bpy.data.actions) == 2


@pytest.mark.smoke
def test_a_head_is_added_at_the_cursor_and_not_inside_the_cube() -> None:
    from risorius.scene.head import ROOM

    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.risorius.add_head()
    first = bpy.context.object
    assert tuple(first.location) == pytest.approx((1.0 + ROOM, 0.0, 0.0))
    bpy.context.view_layer.update()
    bpy.ops.risorius.add_head()
    assert bpy.context.object.location.x > first.location.x + ROOM
    bpy.context.scene.cursor.location = (5.0, 1.0, 2.0)
    bpy.ops.risorius.add_head()
    assert tuple(bpy.context.object.location) == pytest.approx((5.0, 1.0, 2.0))
