"""What is meant in each frame: words and their strength, where it is known from, sounds and visemes."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.labels.felt import Felt
from risorius.speech.phonemes import Phoneme
from risorius.speech.utterance import Sound, SpokenWord, Utterance

FPS = 10.0
JOY = api.expression("joy")
#: m, then a long a, after a pause.
MA = Utterance(
    (Sound(0.5, 0.7, Phoneme("m", 1)), Sound(0.7, 1.2, Phoneme("a", 10, vowel=True))),
    1.5,
    (SpokenWord(0.5, 1.2, "ma"),),
)


def rows(felt: Felt) -> list[dict[str, object]]:
    return [dict(felt.at(step)) for step in range(len(felt.shares))]


def test_strength_and_phase_follow_the_envelope() -> None:
    cue = api.Cue(JOY, start=0.5, onset=0.4, apex=0.3, offset=0.5, peak=0.8)
    calm = api.Cue(api.expression("neutral"), start=1.7, onset=0.0, apex=0.4, offset=0.0)
    told = rows(Felt.of_cues([cue, calm], FPS))
    times = np.arange(len(told)) / FPS
    np.testing.assert_allclose([row["strength"] for row in told], cue.strength(times), atol=1e-12)
    by_time = {round(time, 1): row["phase"] for time, row in zip(times, told, strict=True)}
    assert [by_time[t] for t in (0.0, 0.4, 0.6, 0.9, 1.2, 1.3, 1.6, 1.8, 2.1)] == [
        *("neutral", "neutral", "onset", "apex", "apex", "offset", "offset", "neutral", "neutral")
    ]
    assert {row["word"] for row in told if row["phase"] == "neutral"} == {""}
    assert {row["emotion_from"] for row in told} == {"request"}
    assert all(np.isnan(float(str(row["angle"]))) == (row["phase"] == "neutral") for row in told)


def test_a_stream_that_tells_nothing_says_so_and_claims_nothing() -> None:
    (row,) = rows(Felt.of_stream(api.FapStream(np.zeros((1, 68)), fps=FPS), 1, FPS))
    assert (row["emotion_from"], row["word"], row["phase"]) == ("not asked", "", "")
    assert all(np.isnan(float(str(row[name]))) for name in ("strength", "other_strength", "joy", "fear"))


def test_visemes_and_expressions_of_a_stream_are_told_at_the_video_s_rate() -> None:
    stream = api.FapStream(
        np.full((3, 68), np.nan),
        fps=FPS,
        visemes={0: api.VisemeField(select1=1), 1: api.VisemeField(select1=0, select2=10, blend=21)},
        expressions={1: api.ExpressionField(select1=1, intensity1=63), 2: api.ExpressionField(3, 21, 1, 42)},
    )
    told = rows(Felt.of_stream(stream, 5, 2.0 * FPS))
    assert [row["viseme"] for row in told] == [1, 10, 10, 0, 0]
    at = [told[2 * step] for step in range(3)]
    assert [row["viseme_strength"] for row in at] == pytest.approx([1.0, 2.0 / 3.0, 0.0])
    assert [(row["word"], row["strength"]) for row in at[:2]] == [("", 0.0), ("joy", 1.0)]
    assert (at[2]["word"], at[2]["other_word"]) == ("joy", "anger")
    assert (at[2]["joy"], at[2]["anger"]) == (pytest.approx(2.0 / 3.0), pytest.approx(1.0 / 3.0))
    assert {row["emotion_from"] for row in told} == {"stream"}


def test_speech_tells_sound_viseme_word_and_the_emotion_it_is_spoken_with() -> None:
    saying = api.say(MA, emotion=JOY, fps=FPS)
    told = rows(Felt.of_saying(saying))
    assert [row["sound"] for row in told[:12]] == [*[""] * 5, "m", "m", *["a"] * 5]
    assert [row["spoken_word"] for row in told[4:13]] == ["", *["ma"] * 7, ""]
    assert told[5]["viseme"] == 1
    assert {row["word"] for row in told[:15]} == {"joy"}
    assert told[0]["strength"] == pytest.approx(1.0)
    fading = [float(str(row["strength"])) for row in told[15:]]
    assert fading == sorted(fading, reverse=True)
    assert fading[-1] == pytest.approx(0.0, abs=1e-9)
    assert told[3]["activation"] == JOY.activation
    assert told[-2]["phase"] == "offset"


def test_a_viseme_is_as_strong_as_its_share_of_the_mouth_and_as_it_is_articulated() -> None:
    full, half = (rows(Felt.of_saying(api.say(MA, fps=50.0, articulation=share))) for share in (1.0, 0.5))
    vowel = [float(str(row["viseme_strength"])) for row in full if row["sound"] == "a"]
    assert max(vowel) > 0.95  # in its middle the mouth is all its own
    assert vowel[0] < 0.8  # it comes out of the m
    first = next(row for row in full if row["sound"] == "a")
    assert first["other_viseme"] == 1
    assert float(str(first["other_viseme_strength"])) > 0.1
    for whole, weak in zip(full, half, strict=True):
        assert float(str(weak["viseme_strength"])) == pytest.approx(0.5 * float(str(whole["viseme_strength"])))
    assert all(row["viseme_strength"] == 0.0 for row in full if row["viseme"] == 0)
    assert {row["emotion_from"] for row in full} == {"request"}
    assert {row["strength"] for row in full} == {0.0}


def test_lips_that_close_for_a_short_sound_are_its_own() -> None:
    a, m = (Phoneme("a", 10, vowel=True), Phoneme("m", 1))
    quick = Utterance((Sound(0.0, 0.2, a), Sound(0.2, 0.24, m), Sound(0.24, 0.5, a)), 0.5)
    told = rows(Felt.of_saying(api.say(quick, fps=100.0)))
    assert max(float(str(row["viseme_strength"])) for row in told if row["sound"] == "m") > 0.7
