"""An utterance becomes frames of FAPs: mouth, jaw and tongue."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ...mpeg4 import FAP_COUNT, check_fps
from ...progress import Progress, Work, part_of, run
from ..phonemes import Phoneme
from ..utterance import Sound, Utterance
from .blending import AT_ONCE, Aim, blended, shared
from .closures import DRAWN, closed, closing_shares
from .parts import FAPS_OF, JAW, Manner, beside_jaw, carried_by_jaw, manner, target

#: FAPs that speech moves.
SPOKEN = tuple(sorted(number for numbers in FAPS_OF.values() for number in numbers))
#: The mouth at rest.
REST = Phoneme("", 0)
#: Sliders reach from nothing to twice.
MOST = 2.0


def articulate(utterance: Utterance, fps: float = 25.0, *, articulation: float = 1.0, jaw: float = 1.0) -> Floats:
    """What the mouth does while something is said.

    Parameters
    ----------
    fps : frames per second.
    articulation : how distinctly lips and tongue move, 0 to 2; closures are reached in any case.
    jaw : how far the jaw opens, 0 to 2.

    Returns
    -------
    (T, 68) float64, FAP units, from 0 s to the end of the utterance; NaN for FAPs that speech leaves alone.

    Raises
    ------
    ParameterError : a value outside its range.
    """
    return run(articulate_steps(utterance, fps, articulation=articulation, jaw=jaw))


def articulate_steps(
    utterance: Utterance, fps: float = 25.0, *, articulation: float = 1.0, jaw: float = 1.0, least: int = 0
) -> Work[Floats]:
    """`articulate`, bit by bit, and on for at least so many frames: the mouth comes to rest after the last sound.

    Raises
    ------
    ParameterError : a value outside its range.
    """
    check_fps(fps)
    for name, value in (("articulation", articulation), ("jaw", jaw)):
        if not 0.0 <= value <= MOST:
            raise ParameterError(name, f"must be from 0 to {MOST:g}", value)
    how = manner()
    times = np.arange(max(spoken_frames(utterance, fps), least)) / fps
    share = np.full(FAP_COUNT, articulation)
    share[JAW - 1] = jaw
    if utterance.mouth is not None:
        frames = carried_by_jaw(share * beside_jaw(utterance.mouth.at(times)))
    else:
        aims = yield from part_of(_aims(utterance, how), 0.0, 0.2)
        mixed = yield from part_of(blended(aims, times, how), 0.2, 0.8)
        frames = yield from part_of(closed(carried_by_jaw(share * mixed), aims, times, how), 0.8, 1.0)
    silent = [number - 1 for number in range(1, FAP_COUNT + 1) if number not in SPOKEN]
    frames[:, silent] = np.nan
    return frames


def viseme_shares(utterance: Utterance, times: Floats) -> Work[Floats]:
    """How much of the mouth's shape is each viseme's at some times.

    Parameters
    ----------
    times : (T,) seconds, ascending, evenly apart.

    Returns
    -------
    (T, 15) by number of the viseme, 0 the mouth at rest: shares, mean over the mouth's parts, that add up to 1 where
    all sounds are said as distinctly as usual; each is multiplied by the strength of its sounds.
    """
    how = manner()
    aims = yield from part_of(_aims(utterance, how), 0.0, 0.2)
    of_parts = yield from part_of(shared(aims, times, how), 0.2, 0.8)
    for viseme, closing in (yield from part_of(closing_shares(aims, times, how), 0.8, 1.0)).items():
        for part in DRAWN:
            of_parts[part] *= (1.0 - closing)[:, None]
            of_parts[part][:, viseme] += closing
    return np.asarray(np.mean(list(of_parts.values()), axis=0))


def spoken_frames(utterance: Utterance, fps: float) -> int:
    """How many frames an utterance lasts, from 0 s to its end."""
    return math.floor(utterance.duration * fps + 1e-9) + 1


def _aims(utterance: Utterance, how: Manner) -> Work[list[Aim]]:
    """What each sound, and each pause between them, asks of the mouth."""
    marked = any(sound.stress for sound in utterance.sounds)
    aims, at = list[Aim](), 0.0
    for number, sound in enumerate(utterance.sounds):
        if number % AT_ONCE == 0:
            yield Progress.counted(number, len(utterance.sounds), "sounds read")
        if sound.start - at >= how.pause or (not aims and sound.start > 0.0):
            aims.append(_rest(at, sound.start))
        at = sound.end
        if sound.phoneme.own:
            opening = _stress(sound, how) if marked else 1.0
            aims.append(_aim(sound, opening))
    # The mouth comes to rest after the last sound, whether or not the file lasts so long.
    return [*aims, _rest(at, max(utterance.duration, at + how.pause))]


#: Each sound of a language is asked for again and again; nobody changes what is asked.
_target = lru_cache(maxsize=512)(target)


def _aim(sound: Sound, opening: float) -> Aim:
    """What a sound asks, as strongly as it is said; opening is the share of the jaw's, for stress."""
    shape = sound.strength * _target(sound.phoneme, jaw=opening)
    return Aim(sound.start, sound.end, sound.phoneme.viseme, shape, sound.strength)


def _rest(start: float, end: float) -> Aim:
    """The mouth at rest for a while."""
    return Aim(start, end, REST.viseme, target(REST))


def _stress(sound: Sound, how: Manner) -> float:
    """Share of the jaw's opening where the source marks stress: vowels with it open more, without it less."""
    if not sound.phoneme.vowel:
        return 1.0
    return how.stressed if sound.stress == 1.0 else how.unstressed
