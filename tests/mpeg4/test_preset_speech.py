"""Speech in preset files: read as it was written, refused with file and key where it breaks a rule."""

from __future__ import annotations

from pathlib import Path

import pytest
from risorius.errors import FormatError
from risorius.mpeg4.preset_file import Preset, PresetKind, read_preset, write_preset
from risorius.mpeg4.preset_speech import KeptSound, KeptSpeech, KeptWord

ME = KeptWord(
    "me", 0.1, 0.4, (KeptSound("m", 1, 0.1, 0.2, own=False), KeptSound("i", 12, 0.2, 0.4, 0.5, 1.0, 0.8)), 1.5
)
QUIET = KeptWord('a "quote"', 0.5, 0.6, (KeptSound("a", 10, 0.5, 0.6, vowel=True),))


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    speech = (KeptSpeech(0.0, (ME, QUIET), "line", 1.25, True, "line.wav", "de"), KeptSpeech(2.0, ()))
    preset = Preset(PresetKind.TIMELINE, speech=speech)
    write_preset(path, preset)
    assert read_preset(path) == preset


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ("visemes = [1, 12]", "visemes = [1, 15]", "must be a number from 0 to 14"),
        ("visemes = [1, 12]", "visemes = [1]", "visemes"),
        ("times = [0.1, 0.2, 0.2, 0.4]", "times = [0.2, 0.1, 0.2, 0.4]", "the later one second"),
        ("times = [0.1, 0.2, 0.2, 0.4]", "times = [0.1, 0.3, 0.2, 0.4]", "must be in order and inside 'me'"),
        ("start = 0.5", "start = 0.3", "starts or ends too early"),
        ("stretch = 1.0", "stretch = 0.0", "must be above 0"),
        ("stretch = 1.0", "tempo = 1.0", "tempo"),
    ],
)
def test_what_breaks_a_rule_is_refused(tmp_path: Path, old: str, new: str, problem: str) -> None:
    path = tmp_path / "mine.toml"
    write_preset(path, Preset(PresetKind.TIMELINE, speech=(KeptSpeech(0.0, (ME, QUIET)),)))
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(FormatError, match=problem):
        read_preset(path)
