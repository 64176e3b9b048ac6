"""A recording on a face as it is: nothing comes late, however long it is; inertia is there for who asks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.arrays import Floats
from risorius.progress import run
from risorius.speech.phonemes import phonemes

FPS = 60.0
JAW, LID, CORNER = 3, 19, 12
#: Points of the upper lip's inner edge, and those of the lower lip that they meet.
LIPS = (("2.2", "2.3"), ("2.6", "2.8"), ("2.7", "2.9"))
#: Metres: lips that are no farther apart are closed.
CLOSED = 2e-4


@pytest.fixture(scope="module")
def face() -> api.Face:
    """The default head."""
    return api.default_face()


def recorded(count: int) -> Floats:
    """(count, 68) a jaw that goes up and down, corners that follow it, and blinks of a tenth of a second."""
    seconds, frames = np.arange(count) / FPS, np.full((count, 68), np.nan)
    frames[:, JAW - 1] = 150.0 - 150.0 * np.cos(9.0 * seconds)
    frames[:, CORNER - 1] = frames[:, CORNER] = 60.0 * np.sin(5.0 * seconds)
    frames[:, LID - 1] = frames[:, LID] = 900.0 * np.exp(-(((seconds + 0.5) % 2.0 - 1.0) ** 2) / 0.004)
    return frames


def lateness(told: Floats, seen: Floats) -> float:
    """Seconds by which seen values follow told ones: where they correlate best, between frames by a parabola."""
    shifts = np.arange(-9, 10)
    inside = slice(9, len(told) - 9)
    fits = np.array([np.corrcoef(told[inside], np.roll(seen, -shift)[inside])[0, 1] for shift in shifts])
    best = int(np.clip(fits.argmax(), 1, len(fits) - 2))
    before, at, after = fits[best - 1 : best + 2]
    return float(shifts[best] + 0.5 * (before - after) / (before - 2.0 * at + after)) / FPS


@pytest.mark.slow
def test_what_was_recorded_is_seen_in_its_frame(face: api.Face) -> None:
    stream = api.FapStream(recorded(240), fps=FPS)
    seen = np.array([face.measure(positions) for positions in api.play(face, stream)])
    heavy = np.array([face.measure(positions) for positions in api.play(face, stream, inertia=True)])
    for number in (JAW, LID, CORNER):
        told = stream.frames[:, number - 1]
        assert abs(lateness(told, seen[:, number - 1])) < 0.002
    assert lateness(stream.frames[:, JAW - 1], heavy[:, JAW - 1]) > 0.03


@pytest.mark.slow
def test_a_frame_more_changes_nothing(face: api.Face) -> None:
    """Bakes of more than a thousand frames lie between posed frames: the same faces as of fewer, at the same time."""
    frames = recorded(1001)
    longer, some = run(face.long_motion(frames)), np.arange(60, 400)
    whole = list(api.play(face, api.FapStream(frames[:400], fps=FPS)))
    apart = np.linalg.norm(longer.positions(some) - np.array(whole)[some], axis=2).max(axis=1)
    assert np.median(apart) < 0.3e-3
    assert apart.max() < 1.5e-3
    for number in (JAW, LID, CORNER):
        seen = np.array([face.measure(positions)[number - 1] for positions in longer.positions(some)])
        assert abs(lateness(frames[some, number - 1], seen)) < 0.002


@pytest.mark.slow
@pytest.mark.parametrize(("word", "length"), [(None, 0.12), ("joy", 0.08), ("surprise", 0.08), ("anger", 0.08)])
@pytest.mark.parametrize("ending", [".fap", ".csv"])
def test_lips_of_speech_in_a_file_meet_in_their_frames(
    face: api.Face, word: str | None, length: float, ending: str, tmp_path: Path
) -> None:
    sounds = [
        api.Sound(0.1 + n * length, 0.1 + (n + 1) * length, phonemes()[symbol], symbol)
        for n, symbol in enumerate(["ɑ", "p", "ɑ", "m", "u", "b", "i"])
    ]
    said = api.Utterance(tuple(sounds), sounds[-1].end + 0.1)
    path = tmp_path / f"said{ending}"
    api.write_stream(path, api.say(said, emotion=None if word is None else api.expression(word), fps=25.0).stream)
    shown = list(api.play(face, api.read_recording(path)))
    closures = [round(sound.middle * 25.0) for sound in sounds if sound.phoneme.viseme == 1]
    assert len(closures) == 3
    assert max(_gap(face, shown[frame]) for frame in closures) < CLOSED
    assert _gap(face, shown[round(sounds[0].middle * 25.0)]) > 10 * CLOSED


def _gap(face: api.Face, positions: Floats) -> float:
    """The largest distance of the lips at their middle and beside it, metres; negative where they press."""

    def place(name: str) -> Floats:
        point = face.points[name]
        return np.asarray((positions[point.vertices] * np.asarray(point.weights)[:, None]).sum(axis=0))

    return max(float((place(upper) - place(lower))[2]) for upper, lower in LIPS)
