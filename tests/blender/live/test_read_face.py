"""Reading a face in Blender: as it shows, however it is animated; the panel, the animation, and what is refused."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.errors import SceneError
from risorius.operators.read import live, ops, panel
from risorius.operators.session import begin_session
from risorius.progress import run
from risorius.scene.faces import face_of, read_face
from risorius.scene.live import belief_curves
from risorius.scene.live.reading import FaceReader, read_animation
from risorius.scene.mesh import rest_vertices
from risorius.scene.pictures import belief_plot

HEAD_FAPS = slice(47, 50)


class Spy:
    """A layout that records what is shown, whatever row it is in."""

    def __init__(self, seen: list[tuple[str, str, float]]) -> None:
        self.seen = seen

    def _nested(self, **options: Any) -> Spy:
        return Spy(self.seen)

    row = column = box = split = _nested

    def label(self, *, text: str = "", icon: str = "NONE") -> None:
        self.seen.append(("label", text, 0.0))

    def progress(self, *, factor: float, text: str, type: str) -> None:
        self.seen.append(("progress", text, factor))

    def prop(self, data: Any, name: str, **options: Any) -> None:
        assert name in data.bl_rna.properties

    def operator(self, name: str, **options: Any) -> None:
        self.seen.append(("operator", name, 0.0))


def drawn(cls: Any) -> list[tuple[str, str, float]]:
    """What a panel shows now."""
    spy = Spy([])
    drawing = SimpleNamespace(layout=spy)
    for name in vars(cls):
        if name.startswith("_draw_"):
            setattr(drawing, name, getattr(cls, name).__get__(drawing))
    cls.draw(drawing, bpy.context)
    return spy.seen


def labels(cls: Any) -> list[str]:
    """The texts that a panel shows now."""
    return [text for kind, text, _ in drawn(cls) if kind == "label"]


@pytest.fixture(scope="module")
def joy() -> np.ndarray:
    """(V, 3) displacement of the default head's vertices, metres."""
    face = api.default_face()
    return np.asarray(face.sketcher().sketch(api.archetype("joy", 0).frame()).positions) - face.vertices


@pytest.fixture
def smiling(head: Any, joy: np.ndarray) -> Any:
    """The default head with a shape key of the user's that smiles from frame 1 to frame 11."""
    head.shape_key_add(name="Basis")
    key = head.shape_key_add(name="Mine")
    key.data.foreach_set("co", (rest_vertices(head.data) + joy).astype(np.float32).ravel())
    for frame, value in ((1, 0.0), (11, 1.0)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 11
    bpy.context.scene.frame_set(11)
    return head


def measured(head: Any) -> np.ndarray:
    """FAPs as they show now."""
    return FaceReader(head).measure(bpy.context.evaluated_depsgraph_get())


def differences(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Differences of FAPs, without those of the head's own turn."""
    return np.delete(one - other, np.arange(47, 50))


@pytest.mark.slow
@pytest.mark.smoke
def test_what_shows_is_what_the_api_measures(smiling: Any, joy: np.ndarray) -> None:
    face = face_of(read_face(smiling))
    np.testing.assert_allclose(measured(smiling), face.measure(face.vertices + joy), atol=0.05)
    reader = FaceReader(smiling)
    reading = reader.read(bpy.context.evaluated_depsgraph_get(), rule="robust", words=("guilty", "eager"))
    assert reading.beliefs.best == "joy"
    assert set(reading.words) == {"guilty", "eager"}
    assert reading.features is not None
    np.testing.assert_allclose(reading.features, face.features(face.vertices + joy), atol=0.05)
    assert not reading.is_resting
    bpy.context.scene.frame_set(1)
    assert reader.read(bpy.context.evaluated_depsgraph_get()).is_resting


def test_a_bone_that_moves_the_head_is_no_expression(smiling: Any) -> None:
    before = measured(smiling)
    bone = with_bone(smiling)
    bone.rotation_euler, bone.location = (0.3, 0.5, 0.2), (0.05, 0.1, 0.0)
    bpy.context.view_layer.update()
    after = measured(smiling)
    assert np.nanmax(np.abs(differences(after, before))) < 0.1
    assert np.abs(after[HEAD_FAPS]).min() > 1000.0
    for obj in (smiling, bpy.data.objects["Rig"]):
        obj.location, obj.rotation_euler = (1.0, 2.0, 3.0), (0.4, 0.0, 1.0)
    bpy.context.view_layer.update()
    assert np.nanmax(np.abs(measured(smiling) - after)) < 0.1


def test_a_mask_without_a_skull_is_steadied(smiling: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    reader = FaceReader(smiling)
    still = reader.positions(bpy.context.evaluated_depsgraph_get())
    matrix = reader._face.anatomy.mesh.points.matrix(["3.7", "3.8", "3.11", "3.12", "9.12"])
    monkeypatch.setattr(reader, "_steady", matrix)
    steadied = reader.positions(bpy.context.evaluated_depsgraph_get())
    assert np.linalg.norm(steadied - still, axis=1).max() < 0.002
    bone = with_bone(smiling)
    bone.rotation_euler = (0.3, 0.5, 0.2)
    bpy.context.view_layer.update()
    turned = reader.positions(bpy.context.evaluated_depsgraph_get())
    np.testing.assert_allclose(turned, steadied, atol=1e-5)


def with_bone(head: Any) -> Any:
    """The one bone of an armature that takes all of the head along."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new("head")
    bone.head, bone.tail = (0.0, 0.0, -0.1), (0.0, 0.0, 0.1)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.view_layer.objects.active = head
    head.vertex_groups.new(name="head").add(list(range(len(head.data.vertices))), 1.0, "REPLACE")
    head.modifiers.new("Armature", "ARMATURE").object = rig
    posed = rig.pose.bones["head"]
    posed.rotation_mode = "XYZ"
    return posed


def test_a_subdivided_face_is_read_like_the_one_below(smiling: Any) -> None:
    before, datablocks = measured(smiling), counted()
    smiling.modifiers.new("Smooth", "SUBSURF").levels = 1
    after = measured(smiling)
    assert counted() == datablocks
    assert np.nanmax(np.abs(differences(after, before))) < 0.08 * np.nanmax(np.abs(before))
    bpy.context.scene.frame_set(1)
    assert np.nanmax(np.abs(measured(smiling))) < 0.05


def counted() -> list[int]:
    """How many scenes, objects and meshes there are."""
    return [len(bpy.data.scenes), len(bpy.data.objects), len(bpy.data.meshes)]


def test_other_vertices_are_refused_with_the_modifier_named(smiling: Any) -> None:
    smiling.modifiers.new("Fewer", "DECIMATE").ratio = 0.5
    with pytest.raises(SceneError, match=r"modifiers Fewer: turn them off"):
        measured(smiling)
    live.refresh(smiling)
    assert "Fewer" in live.shown(smiling)[1]


def test_the_panel_shows_beliefs_faps_and_features(smiling: Any) -> None:
    begin_session()
    assert "Reading ..." in labels(panel.RISORIUS_PT_read)
    live.refresh(smiling)
    beliefs = api.recognise(measured(smiling))
    bars = [(text, factor) for kind, text, factor in drawn(panel.RISORIUS_PT_read) if kind == "progress"]
    assert bars == [(f"{belief:.3f}", pytest.approx(belief)) for belief in beliefs.values()]
    assert "Joy" in labels(panel.RISORIUS_PT_read)
    faps = labels(panel.RISORIUS_PT_read_faps)
    assert beliefs.best_profile is not None
    for number, (low, high) in beliefs.best_profile.ranges.items():
        assert f"{number} {api.fap(number).name}" in [text.lstrip("+- ") for text in faps]
        assert f"{(low + high) / 2:.0f}±{(high - low) / 2:.0f}" in faps
    first, speaks = next(iter(beliefs.decisive.items()))
    assert f"{'+' if speaks > 0.0 else '-'} {first} {api.fap(first).name}" in faps
    assert "58 raise_b_lip_rm_o" not in faps
    bpy.context.scene.risorius.read.all_faps = True
    assert "58 raise_b_lip_rm_o" in labels(panel.RISORIUS_PT_read_faps)
    assert [text[:3] for text in labels(panel.RISORIUS_PT_read_features)][::3][:2] == ["f1 ", "f2 "]
    bpy.context.scene.frame_set(1)
    live.refresh(smiling)
    assert "At rest: almost no expression" in labels(panel.RISORIUS_PT_read)


def test_nothing_is_read_for_a_panel_that_nobody_sees(smiling: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []
    begin_session()
    monkeypatch.setattr(live, "_soon", lambda: asked.append(1))
    bpy.context.scene.frame_set(3)
    assert asked == []
    live.shown(smiling)
    live.refresh(smiling)
    asked.clear()
    bpy.context.scene.frame_set(4)
    assert asked == []
    live.shown(smiling)
    bpy.context.scene.frame_set(5)
    assert asked
    asked.clear()
    smiling.data.shape_keys.key_blocks["Mine"].mute = True
    bpy.context.view_layer.update()
    assert asked
    live.refresh(smiling)
    asked.clear()
    smiling.data.shape_keys.key_blocks["Mine"].mute = False
    bpy.context.view_layer.update()
    assert asked == []
    live.shown(smiling)
    assert asked, "a panel that is opened again shows what has changed meanwhile"


def test_a_bone_that_is_posed_is_heard_of(smiling: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []
    bone = with_bone(smiling)
    bpy.context.view_layer.update()
    begin_session()
    live.refresh(smiling)
    monkeypatch.setattr(live, "_soon", lambda: asked.append(1))
    live.shown(smiling)
    assert asked == []
    bone.rotation_euler = (0.3, 0.0, 0.0)
    bpy.context.view_layer.update()
    assert asked


def test_a_face_that_takes_long_to_read_is_read_less_often() -> None:
    state = begin_session().read
    assert live._wait(now=100.0) == 0.0
    state.last, state.cost = 100.0, 0.01
    assert live._wait(now=100.0) == pytest.approx(live.PACE)
    state.cost = 0.5
    assert live._wait(now=100.5) == pytest.approx(0.5 * live.SHARE - 0.5)


@pytest.mark.slow
def test_the_animation_becomes_curves_a_plot_and_files(smiling: Any, tmp_path: Path) -> None:
    scene = bpy.context.scene
    smiling.location.x = 0.5
    smiling.keyframe_insert("location", frame=1)
    mine = smiling.animation_data.action
    chosen = scene.risorius.read
    chosen.rule = "robust"
    chosen.stream, chosen.table, chosen.plot = (str(tmp_path / f"face.{end}") for end in ("fap", "csv", "png"))
    scene.frame_set(4)
    assert bpy.ops.risorius.read_animation() == {"FINISHED"}
    assert scene.frame_current == 4
    assert smiling.animation_data.action == mine
    stream = api.read_fap(tmp_path / "face.fap")
    assert len(stream.frames) == 11
    scene.frame_set(11)
    frame = measured(smiling)
    np.testing.assert_allclose(stream.frames[-1][2:], frame[2:], atol=0.51)
    for name, belief in api.recognise(frame, rule="robust").items():
        assert smiling[f"risorius_{name}"] == pytest.approx(belief, abs=1e-4)
    assert smiling["risorius_strength"] > 0.4
    scene.frame_set(1)
    assert smiling["risorius_strength"] == pytest.approx(0.0, abs=1e-3)
    assert (tmp_path / "face.csv").read_text().count("\n") == 12
    assert (tmp_path / "face.png").read_bytes()[1:4] == b"PNG"
    picture = bpy.data.images[f"{smiling.name} Beliefs"]
    assert picture.packed_file is not None
    assert bpy.ops.risorius.read_animation() == {"FINISHED"}
    assert bpy.ops.risorius.clear_reading() == {"FINISHED"}
    assert not belief_curves.has_curves(smiling)
    assert smiling.animation_data.action == mine
    assert smiling.location.x == 0.5
    assert not bpy.ops.risorius.clear_reading.poll()


def test_a_plot_is_its_object_s_own_whatever_either_is_called(smiling: Any) -> None:
    own = bpy.data.images.new(f"{smiling.name} Beliefs", 8, 8)
    smiling.name = "A head whose name is about as long as Blender lets a name be..."
    black = np.zeros((12, 16, 3))
    image = belief_plot.keep_plot(smiling, black)
    assert image not in (None, own)
    assert belief_plot.keep_plot(smiling, black) == image
    image.name = smiling.name = "Renamed"
    assert belief_plot.plot_of(smiling) == image
    copy = smiling.copy()
    bpy.context.collection.objects.link(copy)
    assert belief_plot.plot_of(copy) == image
    other = belief_plot.keep_plot(copy, black)
    assert other != image
    assert belief_plot.plot_of(smiling) == image
    belief_plot.remove_plot(smiling)
    assert belief_plot.plot_of(smiling) is None
    assert set(bpy.data.images) == {own, other}


@pytest.mark.parametrize("bare", [True, False])
def test_beliefs_leave_no_action_behind(smiling: Any, bare: bool) -> None:
    track = run(read_animation(smiling, bpy.context.scene, start=1, end=3))
    if bare:
        smiling.data.shape_keys.animation_data_clear()
        bpy.data.actions.remove(bpy.data.actions[0])
    before = [(action.name, [slot.identifier for slot in getattr(action, "slots", ())]) for action in bpy.data.actions]
    assert belief_curves.write_curves(smiling, track) == smiling.animation_data.action
    belief_curves.remove_curves(smiling)
    after = [(action.name, [slot.identifier for slot in getattr(action, "slots", ())]) for action in bpy.data.actions]
    assert after == before
    assert smiling.animation_data.action is None


def test_cancelled_reading_leaves_all_as_it_was(smiling: Any) -> None:
    scene = bpy.context.scene
    scene.frame_set(4)
    work = read_animation(smiling, scene, start=6, end=11)
    fractions = [next(work).fraction for _ in range(3)]
    assert fractions == sorted(fractions)
    assert scene.frame_current == 7
    work.close()
    assert scene.frame_current == 4
    assert not belief_curves.has_curves(smiling)


def test_a_file_that_cannot_be_written_is_refused_before_anything_is_read(
    smiling: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ops, "read_animation", lambda *_, **__: pytest.fail("it was read"))
    (tmp_path / "folder.csv").mkdir()
    bpy.context.scene.risorius.read.table = str(tmp_path / "folder.csv")
    with pytest.raises(RuntimeError, match=r"folder\.csv"):
        bpy.ops.risorius.read_animation()
    assert not belief_curves.has_curves(smiling)


def test_what_is_no_face_cannot_be_read(cube: Any) -> None:
    assert not bpy.ops.risorius.read_animation.poll()
    live.refresh(cube)
    assert "no feature points" in live.shown(cube)[1]


def test_by_the_robust_rule_a_resting_face_is_neutral_in_the_panel_and_in_curves(smiling: Any) -> None:
    scene = bpy.context.scene
    scene.risorius.read.rule = "robust"
    scene.frame_set(1)
    live.refresh(smiling)
    seen = drawn(panel.RISORIUS_PT_read)
    assert ("label", "Neutral", 0.0) in seen
    assert ("progress", "1.000", pytest.approx(1.0, abs=1e-3)) in seen
    scene.frame_set(11)
    live.refresh(smiling)
    assert "Joy" in labels(panel.RISORIUS_PT_read)
    track = run(read_animation(smiling, scene, start=1, end=11, rule="robust"))
    belief_curves.write_curves(smiling, track)
    scene.frame_set(1)
    assert smiling["risorius_neutral"] == pytest.approx(1.0, abs=1e-3)
    scene.frame_set(11)
    assert smiling["risorius_neutral"] < 0.2
    belief_curves.remove_curves(smiling)
    assert "risorius_neutral" not in smiling
    belief_curves.write_curves(smiling, run(read_animation(smiling, scene, start=1, end=2)))
    assert "risorius_neutral" not in smiling  # the paper's rule has none
