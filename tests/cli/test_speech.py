"""The verb say: streams without Blender, what it tells, what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.cli import main

TIMINGS = "0.1 0.2 p\n0.2 0.45 a\n0.45 0.5 ɲ\n"


@pytest.fixture
def timings(tmp_path: Path) -> Path:
    """Three sounds as a label file."""
    path = tmp_path / "timings.txt"
    path.write_text(TIMINGS, encoding="utf-8")
    return path


def test_timings_become_a_stream(timings: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "a.fap"
    arguments = ["say", "--timings", str(timings), "--emotion", "joy", "--seed", "3", "--out", str(out), "--json"]
    assert main(arguments) == 0
    said = capsys.readouterr()
    data = json.loads(said.out)
    assert (data["sounds"], data["fps"]) == (3, 25.0)
    assumed = ["the sounds are read as IPA", "shown as the nearest sound: ɲ as ŋ"]
    assert data["assumed"] == assumed
    assert [f"note: {line}" for line in assumed] == said.err.splitlines()
    stream = api.read_fap(out)
    saying = api.say(timings, emotion=api.expression("joy"), seed=3, liveliness=api.Liveliness.usual(3))
    np.testing.assert_allclose(stream.frames, saying.stream.frames, atol=0.5 + 1e-9)


def test_options_are_heeded(timings: Path, tmp_path: Path) -> None:
    out = tmp_path / "a.json"
    arguments = ["say", "--timings", str(timings), "--still", "--fps", "50", "--jaw", "1.5", "--out", str(out)]
    assert main(arguments) == 0
    stream = api.read_stream(out)
    assert stream.fps == 50.0
    expected = api.say(timings, fps=50.0, jaw=1.5).stream.frames
    np.testing.assert_allclose(stream.frames, expected, atol=1e-6)


def test_a_text_becomes_a_stream_and_a_sound(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out, sound = tmp_path / "a.fap", tmp_path / "a.wav"
    arguments = ["say", "Pat my map.", "--voice", "en", "--emotion", "afraid", "--speed", "150", "--sound", str(sound)]
    assert main([*arguments, "--out", str(out), "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert (data["words"], data["sound"]) == (["Pat", "my", "map"], str(sound))
    voiced = api.speak("Pat my map.", speed=150)
    assert sound.stat().st_size == 44 + 2 * len(voiced.sound)
    saying = api.say(voiced.utterance, emotion=api.expression("afraid"), liveliness=api.Liveliness.usual())
    np.testing.assert_allclose(api.read_fap(out).frames, saying.stream.frames, atol=0.5 + 1e-9)


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        ([], "give a text, or --timings with what is said when, or at least a --sound"),
        (["Hello", "--timings", "a.txt"], "give either a text, or --timings"),
        (["--timings", "a.txt", "--voice", "de"], "--voice needs a text"),
        (["Hello", "--tier", "phones"], "--tier needs --timings"),
    ],
)
def test_texts_and_timings_exclude_each_other(
    arguments: list[str], problem: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["say", *arguments, "--out", str(tmp_path / "a.fap")]) == 2
    assert problem in capsys.readouterr().err


@pytest.mark.parametrize(
    ("more", "code", "problem"),
    [
        (["--out", "a.wav"], 2, "--out must end in one of"),
        (["--out", "a.fap", "--sound", "a.wav"], 2, "--sound needs --out to end in .blend or .mp4"),
        (["--out", "a.fap", "--jaw", "9"], 1, "jaw must be from 0 to 2"),
        (["--out", "a.fap", "--emotion", "hangry"], 1, "hangry"),
        (["--out", "a.fap", "--tier", "x", "--alphabet", "arpabet"], 1, "has no sound that is known"),
    ],
)
def test_wrong_use_is_refused(
    timings: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], more: list[str], code: int, problem: str
) -> None:
    timings.write_text("0.1 0.2 ñ̃ю\n", encoding="utf-8") if "arpabet" in more else None
    placed = [str(tmp_path / part) if part.startswith("a.") else part for part in more]
    assert main(["say", "--timings", str(timings), *placed]) == code
    assert problem in capsys.readouterr().err
    assert not list(tmp_path.glob("a.*"))
