"""A timeline saved as a preset is read as what it says."""

from __future__ import annotations

from pathlib import Path

import pytest
import risorius.api as api
from risorius.errors import FormatError
from risorius.mpeg4.preset_file import Choice, Clip, Preset, PresetKind, write_preset
from risorius.mpeg4.preset_speech import KeptSpeech
from risorius.speech.kept import kept_words, line_of_kept
from risorius.speech.line import line_of

SAID = api.Utterance(
    (api.Sound(0.0, 0.1, api.Phoneme("m", 1), "m", strength=0.5), api.Sound(0.1, 0.4, api.Phoneme("i", 12), "i")), 0.4
)


def test_words_are_kept() -> None:
    line = line_of(SAID)
    assert line_of_kept(KeptSpeech(0.0, kept_words(line))) == line


def test_speech_that_plays_is_read_with_its_stretch(tmp_path: Path) -> None:
    path, words = tmp_path / "mine.toml", kept_words(line_of(SAID))
    speech = (KeptSpeech(1.0, words, stretch=2.0), KeptSpeech(3.0, words, mute=True))
    write_preset(path, Preset(PresetKind.TIMELINE, clips=(Clip(Choice(5.0, word="joy"), 0, 1, 1, 1),), speech=speech))
    said = api.read_timings(path)
    assert [(s.symbol, s.start, s.end, s.strength) for s in said.sounds] == [("m", 1.0, 1.2, 0.5), ("i", 1.2, 1.8, 1.0)]
    assert said.assumed == ("clips of the timeline are left out (1): only its speech is read",)
    write_preset(path, Preset(PresetKind.TIMELINE, speech=speech[1:]))
    with pytest.raises(FormatError, match="says nothing: it needs speech that is not muted"):
        api.read_timings(path)
