"""Speech on the default head: lips that meet on the mesh, and a feeling that is still seen."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.arrays import Floats
from risorius.face import long_motion
from risorius.progress import run
from risorius.speech.phonemes import phonemes

FPS = 25.0
#: Points of the upper lip's inner edge, and those of the lower lip that they meet.
LIPS = (("2.2", "2.3"), ("2.6", "2.8"), ("2.7", "2.9"))
#: Metres: lips that are no farther apart are closed.
CLOSED = 2e-4


@pytest.fixture(scope="module")
def face() -> api.Face:
    """The default head."""
    return api.default_face()


def uttered(letters: str, length: float) -> api.Utterance:
    """Sounds of equal length after a tenth of a second."""
    sounds = [
        api.Sound(0.1 + n * length, 0.1 + (n + 1) * length, phonemes()[symbol], symbol)
        for n, symbol in enumerate(letters.split())
    ]
    return api.Utterance(tuple(sounds), sounds[-1].end + 0.1)


def gap(face: api.Face, positions: Floats) -> float:
    """The largest distance of the lips at their middle and beside it, metres; negative where they press."""

    def place(name: str) -> Floats:
        point = face.points[name]
        return np.asarray((positions[point.vertices] * np.asarray(point.weights)[:, None]).sum(axis=0))

    return max(float((place(upper) - place(lower))[2]) for upper, lower in LIPS)


@pytest.mark.slow
@pytest.mark.parametrize(("word", "length"), [(None, 0.12), (None, 0.05), ("joy", 0.08), ("surprise", 0.08)])
def test_lips_meet_on_the_mesh(face: api.Face, word: str | None, length: float) -> None:
    said = uttered("ɑ p ɑ m u b i", length)
    saying = api.say(said, emotion=None if word is None else api.expression(word), fps=FPS)
    moved = face.simulation(saying.stream.frames, FPS, emotions=saying.emotions, planned=True, integrator="balance")
    positions = list(moved)
    opened = gap(face, positions[round(said.sounds[0].middle * FPS)])
    for sound in said.sounds:
        if sound.phoneme.viseme == 1:
            assert gap(face, positions[round(sound.middle * FPS)]) < CLOSED
    assert opened > 10 * CLOSED


@pytest.mark.slow
def test_lips_meet_in_minutes_of_speech_too(face: api.Face, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(long_motion, "POSED", 60)
    said = uttered("ɑ p u m ɪ b ɛ n ɒ s " * 12, 0.1)
    saying = api.say(said, emotion=api.expression("joy"), fps=FPS)
    motion = run(face.long_motion(saying.stream.frames, planned=True))
    assert len(motion.posed) < len(motion) / 3
    positions = list(motion)
    for sound in said.sounds:
        if sound.phoneme.viseme == 1:
            assert gap(face, positions[round(sound.middle * FPS)]) < CLOSED


@pytest.mark.slow
@pytest.mark.parametrize("word", ["joy", "anger", "sadness"])
def test_a_feeling_is_seen_while_something_is_said(face: api.Face, word: str) -> None:
    saying = api.say(uttered("m ɑ m i n ə m o", 0.12), emotion=api.expression(word), fps=FPS)
    frames = saying.stream.frames[::4]
    moved = face.simulation(frames, FPS, emotions=saying.emotions[::4], planned=True, integrator="balance")
    seen = [str(api.recognise(face.measure(positions), rule="robust").best) for positions in moved]
    spoken = [emotion for emotion, felt in zip(seen, saying.emotions[::4].max(axis=1), strict=True) if felt > 0.9]
    assert spoken.count(word) >= 0.8 * len(spoken), seen


def test_a_planned_stream_is_not_added_to(face: api.Face) -> None:
    """The natural drive sees joy in such a profile, and bares teeth, which the profile says nothing of."""
    frames = api.expression("joy").frame()[None]
    (plain,), (planned,) = (face.simulation(frames, FPS, planned=planned) for planned in (False, True))
    lower_lip = [float(face.measure(np.asarray(positions))[5 - 1]) for positions in (plain, planned)]
    assert lower_lip[1] > lower_lip[0] + 40.0
