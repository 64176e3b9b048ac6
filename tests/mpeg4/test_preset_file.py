"""Preset files: read as they were written, refused with file and key where they break a rule."""

from __future__ import annotations

from pathlib import Path

import pytest
from risorius.errors import FormatError
from risorius.mpeg4 import Ramp
from risorius.mpeg4.preset_file import Choice, Clip, Preset, PresetKind, read_preset, write_preset

BUNDLED = sorted((Path(__file__).resolve().parents[2] / "presets" / "timelines").glob("*.toml"))


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    clips = (
        Clip(Choice(5.4, word="joy", variant=1, seed=3), 0.0, 0.1, 1.0, 0.4, name='say "cheese" é 😀'),
        Clip(Choice(4.0, angle=102.25), 1.5, 0.2, 0.0, 0.3, peak=0.5, ramp=Ramp.COSINE, mute=True),
    )
    presets = (
        Preset(PresetKind.TIMELINE, clips=clips, variation={"blinks": (17.0, 4)}),
        Preset(PresetKind.EXPRESSION, Choice(3.0, word="guilty"), contractions={"frontalis_l": 0.25}),
    )
    for preset in presets:
        write_preset(path, preset)
        assert read_preset(path) == preset


@pytest.mark.parametrize("path", BUNDLED, ids=lambda path: path.stem)
def test_bundled_timelines_can_be_read(path: Path) -> None:
    preset = read_preset(path)
    assert preset.kind is PresetKind.TIMELINE
    assert preset.clips[0].start == 0.0


def test_there_are_bundled_timelines() -> None:
    assert BUNDLED


GOOD = """risorius = "timeline"
[[clips]]
word = "joy"
activation = 5.0
start = 0
onset = 0.1
apex = 1
offset = 0.1
"""


@pytest.mark.parametrize(
    ("old", "new", "key"),
    [
        ("timeline", "dance", "key risorius"),
        ('"joy"', '"jy"', "key clips.0.*did you mean joy"),
        ("activation = 5.0", "activation = 9.0", "key clips.0"),
        ("activation = 5.0", 'activation = "5"', "key clips.0.activation"),
        ("start = 0", "start = -1", "key clips.0"),
        ("apex = 1", "apx = 1", "key clips.0.apx"),
        ('word = "joy"', 'word = "joy"\nangle = 3.0', "key clips.0"),
        ("[[clips]]", "[clip]", "key clip"),
        ("offset = 0.1", "offset = 0.1\n[contractions]\nmasseter_l = 1.5", "masseter_l"),
        ("offset = 0.1", "offset = 0.1\n[variation]\nears = { amount = 1.0, seed = 1 }", "key variation.ears"),
        ("risorius", "= risorius", "not valid TOML"),
    ],
)
def test_what_breaks_a_rule_is_refused_with_its_key(tmp_path: Path, old: str, new: str, key: str) -> None:
    path = tmp_path / "bad.toml"
    path.write_text(GOOD, encoding="utf-8")
    read_preset(path)
    path.write_text(GOOD.replace(old, new), encoding="utf-8")
    with pytest.raises(FormatError, match=key) as refusal:
        read_preset(path)
    assert "bad.toml" in str(refusal.value)
