"""What lids, brows and head do with speech: blinks at pauses, beats on stressed words."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from ..arrays import Floats
from ..mpeg4 import ANGLE_UNIT, FAP_COUNT, Liveliness, Overlay, Ramp
from ..tables import read_toml
from .articulation.closures import span
from .phonemes import FOLDER
from .utterance import Sound, Utterance

#: Brows, inner, middle and outer of both sides; the head, down.
BROWS, HEAD_DOWN = ((31, 32), (33, 34), (35, 36)), 48
#: Seconds of the shortest pause in which a blink may fall.
PAUSE = 0.12
#: Letters of the shortest word that counts as one of content, where stress is not marked: the commonest words, which
#: carry grammar, are the shortest (Zipf 1949).
CONTENT = 4
#: What is then to be said.
BY_RULE = f"stress is not marked: the longest vowel of each word of {CONTENT} letters or more counts as stressed"


@dataclass(frozen=True)
class Accompaniment:
    """The figures of accompaniment.toml: seconds, shares, FAP units, degrees."""

    reach: float
    share: float
    rise: float
    fall: float
    least: float
    brows: tuple[float, ...]
    nod: float


@cache
def figures() -> Accompaniment:
    """The figures, read once."""
    table = read_toml(FOLDER / "accompaniment.toml")
    blink, beat = table.table("blink"), table.table("beat")
    seconds = {name: beat.number(name, above=0.0) for name in ("rise", "fall", "least")}
    return Accompaniment(
        blink.number("reach", least=0.0),
        beat.number("share", least=0.0, most=1.0),
        brows=tuple(beat.numbers("brows", len(BROWS)).tolist()),
        nod=beat.number("nod", least=0.0),
        **seconds,
    )


def accompanying(utterance: Utterance, liveliness: Liveliness, count: int, fps: float) -> Overlay:
    """What is laid over `count` frames of speech: blinks, small motions of head and eyes, beats.

    Beats are as large as the head's motions (`Liveliness.head`), and drawn by its seed.
    """
    overlay = liveliness.over(count, fps)
    beats = _beats(utterance, liveliness, np.arange(count) / fps)
    beating, added = ~np.isnan(beats).all(axis=0), overlay.added.copy()
    added[:, beating] = np.nan_to_num(added[:, beating]) + beats[:, beating]
    return replace(overlay, added=added, closure=_in_pauses(overlay.closure, utterance, fps))


def _beats(utterance: Utterance, liveliness: Liveliness, times: Floats) -> Floats:
    """(T, 68) brows that rise and a head that nods on some stressed vowels; NaN elsewhere."""
    frames, how, amount = np.full((len(times), FAP_COUNT), np.nan), figures(), liveliness.head.amount
    if amount == 0.0:
        return frames
    rng, last = np.random.default_rng((liveliness.head.seed, len(utterance.sounds))), -math.inf
    size = np.zeros(len(times))
    for sound in stressed(utterance):
        chance, strength = rng.random(), rng.uniform(0.6, 1.2)
        if chance < how.share and sound.middle - last >= how.least:
            last = sound.middle
            near = span(times, sound.middle - how.rise, sound.middle + how.fall)
            up = Ramp.MINIMUM_JERK.at(times[near] - sound.middle + how.rise, how.rise)
            down = Ramp.MINIMUM_JERK.at(times[near] - sound.middle, how.fall)
            size[near] = np.maximum(size[near], strength * (up - down))
    if size.any():
        for numbers, units in zip(BROWS, how.brows, strict=True):
            frames[:, [number - 1 for number in numbers]] = amount * units * size[:, None]
        frames[:, HEAD_DOWN - 1] = amount * math.radians(how.nod) / ANGLE_UNIT * size
    return frames


def stressed(utterance: Utterance) -> list[Sound]:
    """Its stressed vowels: those that are marked; where none is, by rule the longest vowel of each longer word."""
    vowels = [sound for sound in utterance.sounds if sound.phoneme.vowel]
    if is_marked(utterance):
        return [sound for sound in vowels if sound.stress == 1.0]
    found, middles = [], [sound.middle for sound in vowels]
    for word in utterance.words:
        within = vowels[bisect_left(middles, word.start) : bisect_right(middles, word.end)]
        if within and sum(letter.isalpha() for letter in word.text) >= CONTENT:
            found.append(max(within, key=lambda sound: sound.duration))
    return found


def by_rule(utterance: Utterance, liveliness: Liveliness | None) -> tuple[str, ...]:
    """What is to be said where brows and head beat on words of which nobody has marked the stress."""
    beats = liveliness is not None and liveliness.head.amount > 0.0
    return (BY_RULE,) if beats and utterance.words and not is_marked(utterance) else ()


def is_marked(utterance: Utterance) -> bool:
    """Whether its source says what is stressed."""
    return any(sound.stress for sound in utterance.sounds)


def _in_pauses(closure: Floats, utterance: Utterance, fps: float) -> Floats:
    """(T,) closures of blinks, each moved into the nearest pause in reach, where one is; two do not fall together."""
    moved = np.zeros(len(closure))
    pauses, reach, taken = _pauses(utterance, len(closure) / fps), figures().reach, set[float]()
    shut = np.concatenate([[False], closure > 0.0, [False]])
    starts, ends = np.flatnonzero(~shut[:-1] & shut[1:]), np.flatnonzero(shut[:-1] & ~shut[1:])
    for start, end in zip(starts.tolist(), ends.tolist(), strict=True):
        middle = 0.5 * (start + end) / fps
        within = pauses[bisect_left(pauses, middle - reach) : bisect_right(pauses, middle + reach)]
        near = [pause for pause in within if pause not in taken]
        shift = 0
        if near:
            nearest = min(near, key=lambda pause: abs(pause - middle))
            taken.add(nearest)
            shift = round((nearest - middle) * fps)
        first = min(max(start + shift, 0), len(closure) - (end - start))
        place = slice(first, first + end - start)
        moved[place] = np.maximum(moved[place], closure[start:end])
    return moved


def _pauses(utterance: Utterance, end: float) -> list[float]:
    """Where in a pause a blink falls: soon after the sound before it, and not later than its middle."""
    if not utterance.sounds:  # a silence has no pauses, and blinks are where they are
        return []
    starts = [sound.start for sound in utterance.sounds[1:]] + [end]
    gaps = [(sound.end, start) for sound, start in zip(utterance.sounds, starts, strict=True)]
    return [min(before + 0.15, 0.5 * (before + after)) for before, after in gaps if after - before >= PAUSE]
