"""Files that earlier versions saved open with everything kept: tests/blender/files/VERSION/, by tools/saved_file.py."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import bpy
import pytest
import saved_file
from places import ROOT
from risorius import api
from risorius.mpeg4.preset_file import read_preset
from risorius.scene.points.kept import read_kept

pytestmark = pytest.mark.smoke
VERSIONS = sorted(path for path in (ROOT / "tests" / "blender" / "files").iterdir() if path.is_dir())


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
