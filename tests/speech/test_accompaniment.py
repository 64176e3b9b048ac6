"""Lids, brows and head with speech: blinks at pauses, beats on stressed words, by seed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import risorius.api as api
from risorius.arrays import Floats
from risorius.mpeg4 import Drawn
from risorius.speech.accompaniment import accompanying, stressed
from risorius.speech.phonemes import phonemes

FPS = 50.0
BROW, NOD = 31 - 1, 48 - 1


def talk(*, stress: float = 1.0, phrases: int = 6) -> api.Utterance:
    """Phrases of 1.2 s with pauses of 0.4 s; every other vowel is stressed."""
    sounds, at = [], 0.2
    for _ in range(phrases):
        for number, symbol in enumerate(["m", "ɑ", "n", "i", "t", "ɒ", "s", "ɛ"]):
            marked = stress if number % 4 == 1 else 0.0
            sounds.append(api.Sound(at, at + 0.15, phonemes()[symbol], symbol, marked))
            at += 0.15
        at += 0.4
    return api.Utterance(tuple(sounds), at)


def over(said: api.Utterance, *, blinks: float = 0.0, head: float = 0.0, seed: int = 1) -> tuple[Floats, Floats]:
    """Closures (T,) and what is added (T, 68)."""
    lively = api.Liveliness(blinks=Drawn(blinks, seed), head=Drawn(head, seed))
    overlay = accompanying(said, lively, round(said.duration * FPS) + 1, FPS)
    return overlay.closure, overlay.added


def blinks(closure: Floats) -> list[float]:
    """Seconds at which the lids are shut."""
    shut = np.concatenate([[False], closure > 0.5, [False]])
    starts, ends = np.flatnonzero(~shut[:-1] & shut[1:]), np.flatnonzero(shut[:-1] & ~shut[1:])
    return [0.5 * (start + end) / FPS for start, end in zip(starts, ends, strict=True)]


def test_blinks_fall_into_pauses_and_none_is_lost() -> None:
    said = talk()
    closure, _ = over(said, blinks=20.0)
    plain = api.Liveliness(blinks=Drawn(20.0, 1)).over(len(closure), FPS).closure
    ends = [s.end for s, after in zip(said.sounds, said.sounds[1:], strict=False) if after.start > s.end] + [
        said.sounds[-1].end
    ]
    shut = blinks(closure)
    assert len(shut) == len(blinks(plain)) >= 3
    inside = [any(0.0 <= at - end <= 0.4 for end in ends) for at in shut]
    before = [any(0.0 <= at - end <= 0.4 for end in ends) for at in blinks(plain)]
    assert sum(inside) > sum(before)
    assert sum(inside) >= 0.6 * len(inside)


def test_brows_rise_and_the_head_nods_on_stressed_words_alone() -> None:
    said = talk()
    _, added = over(said, head=1.0)
    still = api.Liveliness(head=Drawn(1.0, 1)).over(len(added), FPS).added
    beats = np.nan_to_num(added[:, BROW])
    assert 15.0 < beats.max() < 40.0
    stressed = [s.middle for s in said.sounds if s.stress]
    for peak in np.flatnonzero(beats > 0.9 * beats.max()) / FPS:
        assert min(abs(peak - at) for at in stressed) < 0.15
    nods = np.nan_to_num(added[:, NOD]) - np.nan_to_num(still[:, NOD])
    assert nods.max() > 0.0
    _, unstressed = over(talk(stress=0.0), head=1.0)
    assert np.isnan(unstressed[:, BROW]).all()


def test_a_seed_gives_the_same_beats_and_another_others() -> None:
    beats = [np.nan_to_num(over(talk(), head=1.0, seed=seed)[1][:, BROW]) for seed in (1, 1, 2)]
    np.testing.assert_array_equal(beats[0], beats[1])
    assert np.abs(beats[0] - beats[2]).max() > 5.0


def test_a_still_face_has_neither() -> None:
    closure, added = over(talk())
    assert not closure.any()
    assert np.isnan(added).all()


def test_where_stress_is_not_marked_longer_words_are_stressed_by_rule() -> None:
    def sound(start: float, end: float) -> api.Sound:
        return api.Sound(start, end, api.Phoneme("a", 10, vowel=True), "a")

    sounds = (sound(0.0, 0.1), sound(0.2, 0.3), sound(0.4, 0.6))
    words = (api.SpokenWord(0.0, 0.15, "the"), api.SpokenWord(0.2, 0.6, "answer"))
    unmarked = api.Utterance(sounds, 0.7, words)
    assert stressed(unmarked) == [sounds[2]]
    marked = api.Utterance((replace(sounds[0], stress=1.0), *sounds[1:]), 0.7, words)
    assert [sound.start for sound in stressed(marked)] == [0.0]
    lively = api.Liveliness.usual(1)
    assert "stress is not marked" in api.say(unmarked, liveliness=lively).assumed[-1]
    assert not api.say(unmarked).assumed
    assert not api.say(marked, liveliness=lively).assumed
