"""Recordings of every format come onto a face; fields say what they leave open, and show where they apply."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import file_state
import numpy as np
import pytest
import risorius.api as api
from risorius.operators.recording import ops
from risorius.operators.recording.fields import OF_TRACKERS, leaves_open
from risorius.operators.recording.ops import RISORIUS_OT_import_fap
from risorius.progress import Progress
from risorius.scene.bake.baking import BakeResult
from risorius.scene.bake.motion import FapMotion, at_rate
from risorius.scene.bake.shape_keys import read_own
from risorius.scene.mesh import evaluated_vertices

JAW, LID = 3 - 1, 19 - 1


@pytest.fixture
def played(monkeypatch: pytest.MonkeyPatch) -> list[FapMotion]:
    """What is to be shown, which is not baked: that takes long, and is tested elsewhere."""
    motions: list[FapMotion] = []

    def noted(obj: Any, scene: Any, motion: FapMotion, *, clip: str, start: float) -> Iterator[Progress]:
        motions.append(motion)
        yield Progress(1.0, "")
        return BakeResult(clip, clip, ("a", "b"), 0.0, (start, start + len(motion.stream) - 1.0))

    monkeypatch.setattr(ops, "stream_work", noted)
    bpy.context.scene.render.fps = 25
    return motions


def imported(path: Path, **fields: Any) -> None:
    """Import a file as a script does."""
    assert bpy.ops.risorius.import_fap(filepath=str(path), **fields) == {"FINISHED"}


@pytest.mark.parametrize("ending", [".fap", ".fba", ".json", ".csv"])
def test_streams_of_our_own_are_imported(ending: str, head: Any, played: list[FapMotion], tmp_path: Path) -> None:
    frames = np.full((4, 68), np.nan)
    frames[:, JAW] = [0.0, 128.0, 256.0, 0.0]
    api.write_stream(tmp_path / f"yawn{ending}", api.FapStream(frames, fps=25.0))
    imported(tmp_path / f"yawn{ending}")
    np.testing.assert_allclose(played[0].stream[:, JAW], frames[:, JAW], atol=2.0)
    assert head.risorius.recording.clip == "yawn"
    assert head.risorius.recording.said == ""


ARKIT = "timestamp,jawOpen,eyeBlinkLeft,eyeBlinkRight\n0.00,0,0,0\n0.04,1,0.5,0.5\n0.08,0,0,0\n"
TRACKERS = {
    "arkit.csv": ARKIT,
    "arkit.txt": ARKIT.replace(",", ";").replace(".", ","),
    "livelink.csv": "\n".join(
        ["Timecode,BlendShapeCount,JawOpen", *(f"00:00:01:{row:02d}.0,61,{row / 10}" for row in range(7))]
    ),
    "openface.csv": "frame,timestamp,confidence,success,AU26_r\n1,0.00,1,1,0\n2,0.04,1,1,5\n3,0.08,1,1,0\n",
    "mediapipe.json": json.dumps(
        [{"timestamp": t, "blendshapes": {"jawOpen": v}} for t, v in ((0.0, 0), (0.04, 1), (0.08, 0))]
    ),
    "a2f.json": json.dumps({"exportFps": 25, "facsNames": ["jawOpen"], "weightMat": [[0], [1], [0]]}),
    "lines.jsonl": "\n".join(json.dumps({"time": t, "blendshapes": {"jawOpen": v}}) for t, v in ((0, 0), (0.04, 1))),
}


@pytest.mark.parametrize("name", TRACKERS)
def test_recordings_of_trackers_are_imported(name: str, head: Any, played: list[FapMotion], tmp_path: Path) -> None:
    (tmp_path / name).write_text(TRACKERS[name])
    assert leaves_open(tmp_path / name)
    imported(tmp_path / name)
    recording = api.read_recording(tmp_path / name)
    expected = at_rate(recording.played()[0], recording.stream.fps, 25.0)
    np.testing.assert_array_equal(played[0].stream, expected)
    assert played[0].stream[0, JAW] == 0.0 < played[0].stream[1, JAW]


def test_fields_overrule_the_file(head: Any, played: list[FapMotion], tmp_path: Path) -> None:
    path = tmp_path / "take.csv"
    path.write_text(
        "timestamp,face_id,jawOpen,HeadYaw\n"
        "2.00,4,0.2,0.1\n2.00,7,0.9,0\n2.04,4,0.6,0.3\n2.04,7,0.9,0\n2.08,4,0.2,0.1\n2.08,7,0.9,0\n"
    )
    with pytest.raises(RuntimeError, match=r"(?s)2 faces.*--face"):
        bpy.ops.risorius.import_fap(filepath=str(path))
    imported(path, face=4)
    plain = played[-1].stream
    imported(path, face=4, rate=12.5)
    assert len(played[-1].stream) == 2 * len(plain) - 1
    imported(path, face=4, start="1.92")
    assert len(played[-1].stream) == len(plain) + 2
    imported(path, face=4, flip={"yaw"})
    np.testing.assert_allclose(played[-1].stream[:, 48], -plain[:, 48])
    imported(path, face=4, neutral=1)
    np.testing.assert_allclose(played[-1].stream[:, JAW], plain[:, JAW] - plain[1, JAW])
    np.testing.assert_allclose(played[-1].stream[:, 48], plain[:, 48] - plain[1, 48])


@pytest.mark.parametrize(("fields", "inertia"), [({}, False), ({"inertia": True}, True)])
def test_inertia_is_added_to_what_was_computed_alone(
    fields: dict[str, bool],
    inertia: bool,
    head: Any,
    played: list[FapMotion],
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
) -> None:
    (tmp_path / "take.csv").write_text(ARKIT)
    imported(tmp_path / "take.csv", **fields)
    assert played[0].inertia is inertia
    output = capfd.readouterr()
    done = "skin and jaw follow with inertia" if inertia else "each frame is shown as it is, without added inertia"
    assert f"Info: take.csv: {done}" in output.out + output.err


def test_a_trembling_face_is_steadied_where_that_is_asked(head: Any, played: list[FapMotion], tmp_path: Path) -> None:
    rows = [f"{n / 25:.2f},{0.5 + 0.01 * (-1) ** n}" for n in range(60)]
    (tmp_path / "take.csv").write_text("\n".join(["timestamp,jawOpen", *rows]))
    imported(tmp_path / "take.csv")
    imported(tmp_path / "take.csv", steady=True)
    trembling, steady = (np.ptp(motion.stream[5:-5, JAW]) for motion in played)
    assert steady < 0.5 * trembling


def test_what_a_stream_states_cannot_be_overruled(head: Any, played: list[FapMotion], tmp_path: Path) -> None:
    api.write_stream(tmp_path / "a.fap", api.FapStream(np.zeros((3, 68)), fps=25.0))
    for fields in ({"rate": 30.0}, {"neutral": 1}, {"flip": {"yaw"}}):
        with pytest.raises(RuntimeError, match="must be left out"):
            bpy.ops.risorius.import_fap(filepath=str(tmp_path / "a.fap"), **fields)


def test_what_was_assumed_is_reported_and_kept_for_the_panel(
    head: Any, played: list[FapMotion], tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "take.csv"
    path.write_text("frame;jawOpen;earWiggle\n0;0,1;0\n1;0,5;0\n3;0,1;0\n4;0,1;0\n5;0,1;0\n")
    imported(path)
    output = capfd.readouterr()
    lines = head.risorius.recording.said.splitlines()
    assert lines == [
        "the file contains no times: 30 frames per second",
        "not read: earWiggle",
        "1 unknown frame (2): bridged from those around",
    ]
    for line in lines:
        assert f"Warning: take.csv: {line}" in output.out + output.err
    assert not np.isnan(played[0].stream[:, JAW]).any()


def test_what_a_tracker_cannot_know_stays_with_the_timeline(head: Any, played: list[FapMotion], tmp_path: Path) -> None:
    head.risorius.timeline.linked = False
    head.risorius.emotion.word = "joy"
    bpy.context.scene.frame_set(11)
    bpy.ops.risorius.add_clip()
    clip = head.risorius.timeline.clips[0]
    clip.onset, clip.apex, clip.offset = 0.2, 2.0, 0.2
    rows = [f"{0.04 * row:.2f},{'' if 20 <= row < 40 else 0.0}" for row in range(60)]
    (tmp_path / "take.csv").write_text("\n".join(["timestamp,jawOpen", *rows]))
    bpy.context.scene.frame_set(21)
    imported(tmp_path / "take.csv")
    shown, joy = played[-1].stream, np.array(api.expression("joy").frame())
    corner = 12 - 1
    assert shown[:40, corner] == pytest.approx(joy[corner])
    assert shown[5, JAW] == 0.0
    assert shown[30, JAW] == pytest.approx(np.nan_to_num(joy)[JAW])
    said = head.risorius.recording.said
    assert "from the timeline, as the recording does not have them: " in said
    assert "the face shows the timeline alone" in said
    imported(tmp_path / "take.csv", with_timeline=False)
    assert np.isnan(played[-1].stream[:, corner]).all()
    assert "timeline" not in head.risorius.recording.said


def test_a_refused_file_changes_nothing(head: Any, tmp_path: Path) -> None:
    path = tmp_path / "take.csv"
    file_state.file_state()  # looking at a material's settings of Cycles makes them
    before = file_state.file_state()
    for text, problem in (("a,b\n1,2\n", "has none of the columns"), ("timestamp,jawOpen\n", "nothing was recorded")):
        path.write_text(text)
        with pytest.raises(RuntimeError, match=problem):
            bpy.ops.risorius.import_fap(filepath=str(path))
    path.unlink()
    with pytest.raises(RuntimeError, match=r"take\.csv"):
        bpy.ops.risorius.import_fap(filepath=str(path))
    assert file_state.differences(before, file_state.file_state()) == []


class Layout:
    """A layout that records which fields are drawn."""

    def __init__(self, names: list[str]) -> None:
        self.names = names

    def column(self) -> Layout:
        return self

    def prop(self, data: Any, name: str) -> None:
        self.names.append(name)


def drawn(obj: Any, path: Path) -> list[str]:
    """The fields that the file browser or the dialog of a drop shows for a file."""
    names: list[str] = []
    RISORIUS_OT_import_fap.draw_fields(SimpleNamespace(), Layout(names), path, obj)
    return names


def test_fields_show_where_they_apply(head: Any, tmp_path: Path) -> None:
    tracked, own = tmp_path / "take.csv", tmp_path / "take.fap"
    tracked.write_text(ARKIT)
    for stream in (own, tmp_path / "own.fba", tmp_path / "own.json"):
        api.write_stream(stream, api.FapStream(np.zeros((3, 68)), fps=25.0))
        assert drawn(head, stream) == ["steady", "inertia", "onto"]
    assert drawn(head, tracked) == [*OF_TRACKERS, "steady", "inertia", "onto"]
    assert drawn(head, tmp_path / "gone.csv") == drawn(head, tmp_path) == ["steady", "inertia", "onto"]
    head.risorius.timeline.clips.add()
    assert drawn(head, own) == ["with_timeline", "steady", "inertia", "onto"]
    tracked.write_text(own.read_text())  # the content counts, as it is now
    assert drawn(head, tracked) == ["with_timeline", "steady", "inertia", "onto"]


@pytest.mark.slow
def test_a_recording_with_a_hole_is_baked_without_a_pop(head: Any, tmp_path: Path) -> None:
    rows = ["timestamp,eyeBlinkLeft,eyeBlinkRight,jawOpen", "0.00,1,1,0.5", "0.04,1,1,0.5", "0.08,,,", "0.12,1,1,0.5"]
    (tmp_path / "take.csv").write_text("\n".join(rows))
    bpy.context.scene.render.fps = 25
    bpy.context.scene.frame_set(7)
    imported(tmp_path / "take.csv")
    clips = read_own(head.data).clips
    assert list(clips) == ["take"]
    shown = []
    for frame in range(7, 11):
        bpy.context.scene.frame_set(frame)
        shown.append([head.data.shape_keys.key_blocks[name].value for name in clips["take"]])
    assert np.ptp(shown, axis=0).max() < 0.02
    assert np.abs(shown).max() > 0.5


@pytest.mark.slow
@pytest.mark.parametrize("onto", ["NEW", "KEYS"])
def test_a_long_recording_shows_the_poses_of_its_frames(
    onto: str, head: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("risorius.scene.bake.motion.SIMULATED", 50)
    rows = [f"{t / 25:.2f},{0.5 - 0.5 * np.cos(t / 9):.4f},{0.2 * np.sin(t / 14):.4f}" for t in range(120)]
    (tmp_path / "take.csv").write_text("\n".join(["timestamp,jawOpen,HeadYaw", *rows]))
    scene, path = bpy.context.scene, tmp_path / "take.csv"
    scene.render.fps = 25
    scene.frame_set(1)
    if onto == "KEYS":
        head.shape_key_add(name="Basis")
        key = head.shape_key_add(name="drop", from_mix=False)
        faps = np.full(68, np.nan)
        faps[JAW] = 400.0
        key.data.foreach_set("co", api.default_face().pose(faps).positions.ravel())
        head.risorius.bake.onto = onto
    said: list[str] = []
    monkeypatch.setattr(RISORIUS_OT_import_fap, "report", lambda self, kind, text: said.append(text), raising=False)
    imported(path)
    frames, _ = api.read_recording(path).played()
    shown = []
    for step in (0, 28, 60):
        scene.frame_set(1 + step)
        shown.append(evaluated_vertices(head))
        expected = api.default_face().pose(frames[step]).positions
        if onto == "NEW":
            assert np.abs(shown[-1] - expected).max() < 0.5e-3
    assert np.abs(shown[1] - shown[0]).max() > 5e-3
    if onto == "KEYS":
        scene.frame_set(29)
        assert head.data.shape_keys.key_blocks["drop"].value > 0.3
