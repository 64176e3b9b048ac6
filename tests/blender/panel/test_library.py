"""Presets go from face to face; .fap files are baked where the playhead is; both may be dropped on the viewport."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.face.contractible import contractibles
from risorius.operators.emotion.performance import performance_of
from risorius.operators.library import exchange
from risorius.operators.library.exchange import BUNDLED, expression_of, preset_files, timeline_of
from risorius.operators.library.panel import RISORIUS_FH_preset
from risorius.operators.muscles.props import by_hand_of, set_by_hand
from risorius.operators.recording.handler import RISORIUS_FH_fap
from risorius.scene.bake.motion import at_rate
from risorius.scene.bake.shape_keys import read_own
from risorius.scene.head import add_default_head


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's presets, in a folder of the test's own."""
    monkeypatch.setattr("risorius.operators.library.ops.own_folder", lambda **_: tmp_path)
    monkeypatch.setattr(exchange, "own_folder", lambda **_: tmp_path)
    return tmp_path


def clip(obj: Any, word: str, start: int) -> Any:
    timeline = obj.risorius.timeline
    timeline.linked = False
    obj.risorius.emotion.word = word
    bpy.context.scene.frame_set(start)
    bpy.ops.risorius.add_clip()
    return timeline.clips[timeline.active]


def test_a_timeline_saved_from_one_face_plays_alike_on_another(head: Any, folder: Path) -> None:
    scene = bpy.context.scene
    clip(head, "joy", 10)
    second = clip(head, "fear", 34)
    second.emotion.by, second.emotion.angle, second.emotion.seed = "WHEEL", 1.25, 4
    second.peak, second.ramp, second.name, second.apex = 0.6, "cosine", "doubt", 0.3
    head.risorius.timeline.variation.blinks = 20.0
    assert bpy.ops.risorius.save_preset(preset="My: play", kind="timeline") == {"FINISHED"}
    (path,) = folder.iterdir()
    assert path.name == "My_ play.toml"
    assert preset_files()[0] == path
    other = add_default_head()
    assert bpy.context.object == other
    other.risorius.timeline.clips.add()
    scene.frame_set(100)
    assert bpy.ops.risorius.load_preset(filepath=str(path)) == {"FINISHED"}
    assert [c.start for c in other.risorius.timeline.clips] == [100, 124]
    here, there = performance_of(head, scene), performance_of(other, scene)
    assert there.titles == here.titles == ("joy", "doubt")
    assert there.liveliness == here.liveliness
    np.testing.assert_allclose(api.sequence(there.cues), api.sequence(here.cues), atol=0.02)
    assert timeline_of(other, scene) == timeline_of(head, scene)


def test_an_expression_brings_its_contractions(head: Any, folder: Path) -> None:
    emotion = head.risorius.emotion
    emotion.word, emotion.variant, emotion.activation, emotion.seed = "fear", "8", 6.0, 3
    set_by_hand(head, next(iter(contractibles())), 0.4)
    hands = by_hand_of(head)
    assert hands
    bpy.ops.risorius.save_preset(preset="shock")
    saved = expression_of(head)
    other = add_default_head()
    bpy.ops.risorius.load_preset(filepath=str(folder / "shock.toml"))
    assert expression_of(other) == saved
    assert by_hand_of(other) == hands
    emotion.word = "joy"
    assert expression_of(head) != saved


def test_an_unknown_muscle_is_refused_and_nothing_changes(head: Any, tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    text = 'risorius = "expression"\n[emotion]\nword = "fear"\nactivation = 3\n[contractions]\nbiceps_l = 0.5\n'
    path.write_text(text, encoding="utf-8")
    with pytest.raises(RuntimeError, match="biceps_l"):
        bpy.ops.risorius.load_preset(filepath=str(path))
    assert head.risorius.emotion.word == "joy"
    path.write_text(text.partition("[contr")[0], encoding="utf-8")
    bpy.ops.risorius.load_preset(filepath=str(path))
    assert head.risorius.emotion.word == "fear"


@pytest.mark.parametrize("path", sorted(BUNDLED.glob("*.toml")), ids=lambda path: path.stem)
def test_bundled_timelines_load(head: Any, path: Path) -> None:
    assert bpy.ops.risorius.load_preset(filepath=str(path)) == {"FINISHED"}
    assert len(performance_of(head, bpy.context.scene).cues) > 1


def test_saving_a_timeline_without_clips_is_refused(head: Any, folder: Path) -> None:
    with pytest.raises(RuntimeError, match="no clip"):
        bpy.ops.risorius.save_preset(preset="nothing", kind="timeline")
    assert not list(folder.iterdir())


@pytest.mark.slow
def test_a_fap_file_is_baked_from_the_current_frame_on(head: Any, tmp_path: Path) -> None:
    frames = np.full((5, 68), np.nan)
    frames[:, 2] = [0.0, 200.0, 400.0, 200.0, 0.0]
    path = tmp_path / "yawn.fap"
    api.write_fap(path, api.FapStream(frames, fps=12.5))
    bpy.context.scene.render.fps = 25
    bpy.context.scene.frame_set(20)
    assert bpy.ops.risorius.import_fap(filepath=str(path)) == {"FINISHED"}
    action = head.data.shape_keys.animation_data.action
    assert tuple(action.frame_range) == (20.0, 28.0)
    assert list(read_own(head.data).clips) == ["yawn"]
    assert head.data.shape_keys.animation_data.action == action


@pytest.mark.slow
def test_a_recording_is_baked_and_what_was_assumed_is_said(
    head: Any, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "take.csv"
    path.write_text("frame;jawOpen;earWiggle\n0;0,1;0\n1;0,5;0\n2;0,1;0\n")
    bpy.context.scene.render.fps = 30
    assert bpy.ops.risorius.import_fap(filepath=str(path)) == {"FINISHED"}
    assert list(read_own(head.data).clips) == ["take"]
    said = capfd.readouterr()
    for assumed in ("the file contains no times: 30 frames per second", "not read: earWiggle"):
        assert f"Warning: take.csv: {assumed}" in said.out + said.err


def test_frames_keep_their_seconds_at_another_rate() -> None:
    frames = np.full((3, 68), np.nan)
    frames[:, 2] = [0.0, 100.0, 0.0]
    frames[1:, 3] = 8.0
    finer = at_rate(frames, 10.0, 40.0)
    np.testing.assert_allclose(finer[:, 2], [0, 25, 50, 75, 100, 75, 50, 25, 0])
    np.testing.assert_array_equal(np.isnan(finer[:, 3]), [True, True] + 7 * [False])
    assert at_rate(frames, 10.0, 10.0) is frames
    assert len(at_rate(np.zeros((26, 68)), 25.0, 24.0)) == 25


def test_files_may_be_dropped_on_a_viewport_with_a_face(head: Any) -> None:
    viewport, timeline = SimpleNamespace(type="VIEW_3D"), SimpleNamespace(type="DOPESHEET_EDITOR")
    cube = bpy.data.objects.new("cube", bpy.data.meshes.new("cube"))
    for handler, extension in ((RISORIUS_FH_preset, ".toml"), (RISORIUS_FH_fap, ";".join(api.READABLE_STREAMS))):
        assert handler.bl_file_extensions == extension
        assert handler.bl_import_operator.partition(".")[2] in dir(bpy.ops.risorius)
        assert handler.poll_drop(SimpleNamespace(area=viewport, object=head))
        assert not handler.poll_drop(SimpleNamespace(area=timeline, object=head))
        assert not handler.poll_drop(SimpleNamespace(area=viewport, object=cube))
