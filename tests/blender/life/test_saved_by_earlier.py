"""Files that earlier versions saved open with everything kept: tests/blender/files/VERSION/, by tools/saved_file.py."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import bpy
import pytest
import saved_file
from places import ROOT
from risorius import api
from risorius.mpeg4.preset_file import read_preset
from risorius.operators.bake.settings import stale_clips
from risorius.scene.following.kinds import Follows
from risorius.scene.points.kept import read_kept
from saved_state import saved_state

pytestmark = pytest.mark.smoke
FILES = ROOT / "tests" / "blender" / "files"
VERSIONS = sorted(path.parent for path in FILES.glob("*/kept.json"))
#: What 0.1.0 itself saved, in two versions of Blender.
FIRST = sorted(path.parent for path in FILES.glob("0.1.0-*/saved.blend"))
#: All files whose state is known.
STATES = sorted(FILES.glob("*/*.state.json"))


@pytest.fixture(params=VERSIONS, ids=lambda path: path.name)
def folder(request: pytest.FixtureRequest) -> Any:
    """The files of one version."""
    return request.param


def opened(path: Path) -> Any:
    """The head of a file."""
    bpy.ops.wm.open_mainfile(filepath=str(path))
    return next(obj for obj in bpy.data.objects if obj.type == "MESH")


def test_a_blend_opens_with_everything_kept(folder: Path) -> None:
    expected = json.loads((folder / "kept.json").read_text(encoding="utf-8"))
    found = saved_file.kept(opened(folder / "saved.blend"))
    assert found.pop("joy") == pytest.approx(expected.pop("joy"), rel=1e-6)
    assert found == expected


@pytest.mark.slow
def test_it_is_worked_on_as_a_new_one(folder: Path, tmp_path: Path) -> None:
    """Its points serve, a bake replaces its clip, Clear takes it away, and the user's own key stays."""
    head = opened(folder / "saved.blend")
    bpy.context.view_layer.objects.active = head
    assert len(read_kept(head).points) > 60
    head.risorius.bake.clip = ""
    head.risorius.emotion.word = "joy"
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    assert [key.name for key in head.data.shape_keys.key_blocks] == ["Basis", "My Key", "joy"]
    bpy.ops.risorius.clear()
    assert [key.name for key in head.data.shape_keys.key_blocks] == ["Basis", "My Key"]
    assert not bpy.data.actions


def test_presets_and_streams_are_read(folder: Path) -> None:
    timeline, alone = read_preset(folder / "timeline.toml"), read_preset(folder / "expression.toml")
    assert [clip.emotion.word for clip in timeline.clips] == ["sadness", "worried"]
    assert (timeline.clips[1].name, timeline.clips[1].peak, timeline.clips[1].mute) == ("the sad one", 0.5, True)
    assert (alone.emotion.word, alone.emotion.activation, alone.emotion.seed) == ("worried", 5.5, 7)
    assert api.read_fap(folder / "stream.fap").name == "kept"


@pytest.fixture(params=FIRST, ids=lambda path: path.name)
def first(request: pytest.FixtureRequest) -> Any:
    """The files of 0.1.0."""
    return request.param


def lost(before: Any, after: Any, place: str = "") -> list[str]:
    """What of a state is gone or otherwise."""
    if isinstance(before, dict) and isinstance(after, dict):
        return [
            line
            for name, value in before.items()
            for line in (lost(value, after[name], f"{place}.{name}") if name in after else [f"{place}.{name} is gone"])
        ]
    if isinstance(before, list) and isinstance(after, list) and len(before) == len(after):
        pairs = enumerate(zip(before, after, strict=True))
        return [line for index, (one, other) in pairs for line in lost(one, other, f"{place}[{index}]")]
    same = before == pytest.approx(after, rel=1e-4, abs=1e-4) if isinstance(before, float) else before == after
    return [] if same else [f"{place}: {before!r} is now {after!r}"]


@pytest.mark.parametrize("path", STATES, ids=lambda path: f"{path.parent.name} {path.name}")
def test_all_that_was_saved_is_there(path: Path) -> None:
    blend = path.with_name(path.name.replace(".state.json", ".blend"))
    bpy.ops.wm.open_mainfile(filepath=str(blend))
    before = json.loads(path.read_text(encoding="utf-8"))
    assert sum(len(obj["keys"]) for obj in before["objects"].values()) > 2
    assert lost(before, json.loads(json.dumps(saved_state()))) == []


def test_eyes_that_the_first_version_named_follow(first: Path) -> None:
    bpy.ops.wm.open_mainfile(filepath=str(first / "saved.blend"))
    rows = {row.object.name: row.follows for row in bpy.data.objects["Parts"].risorius.face.followers}
    assert rows == {"Left Eye": Follows.EYE_L.name, "Right Eye": Follows.EYE_R.name}


@pytest.mark.slow
def test_what_the_first_version_baked_is_worked_on(first: Path) -> None:
    """Its strips are marked as out of date, are baked again, and cleared; the user's own key and property stay."""
    bpy.ops.wm.open_mainfile(filepath=str(first / "saved.blend"))
    head = bpy.data.objects["Strips"]
    bpy.context.view_layer.objects.active = head
    bpy.ops.object.select_all(action="DESELECT")
    head.select_set(True)
    assert stale_clips(head, bpy.context.scene)
    keys = {block.name for block in head.data.shape_keys.key_blocks}
    assert bpy.ops.risorius.bake_strips() == {"FINISHED"}
    assert {block.name for block in head.data.shape_keys.key_blocks} == keys
    assert not stale_clips(head, bpy.context.scene)
    bpy.ops.risorius.clear()
    assert [block.name for block in head.data.shape_keys.key_blocks] == ["Basis", "My Key"]
    assert head["mine"] == 3


def test_files_that_the_first_version_wrote_are_read(first: Path) -> None:
    timeline, alone = read_preset(first / "timeline.toml"), read_preset(first / "expression.toml")
    assert [clip.emotion.word for clip in timeline.clips] == ["sadness", "joy", "joy"]
    assert timeline.contractions == alone.contractions == {"zygomaticus_major_l": 0.4, "frontalis_med_r": 0.25}
    assert (alone.emotion.angle, alone.emotion.seed) == (pytest.approx(math.degrees(1.25), abs=1e-3), 7)
    assert set(timeline.variation) == {"draws", "blinks", "head", "eyes"}
    text, binary = api.read_fap(first / "stream.fap"), api.read_fba(first / "stream.fba")
    assert text.name == "kept"
    assert len(text.frames) == len(binary.frames) == 26
