"""Speech and emotion share a face: the mouth obeys speech where it must and leans to the emotion elsewhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError
from ..mpeg4 import FAP_COUNT
from ..progress import Progress, Work, part_of, run
from ..tables import KeyedTable, read_toml
from .articulation.blending import AT_ONCE, Aim
from .articulation.closures import closing, reached, span
from .articulation.parts import FAPS_OF, Manner, MouthPart, beside_jaw, carried_by_jaw, manner
from .phonemes import FOLDER
from .utterance import Utterance

#: How far the mouth may lean to the emotion: not at all, to twice.
MOST = 2.0


@dataclass(frozen=True)
class Sharing:
    """The figures of feeling.toml: shares by part while speaking and while closed; rounding; seconds of a turn."""

    speaking: Mapping[MouthPart, float]
    closed: Mapping[MouthPart, float]
    rounded_width: float
    rounded_full: float
    turn: float


@cache
def sharing() -> Sharing:
    """The figures, read once."""
    table = read_toml(FOLDER / "feeling.toml")
    rounded = table.table("rounded")
    return Sharing(
        _shares(table.table("speaking")),
        _shares(table.table("closed")),
        rounded.number("width", least=0.0, most=1.0),
        rounded.number("full", above=0.0),
        table.table("time").number("turn", above=0.0),
    )


def _shares(table: KeyedTable) -> dict[MouthPart, float]:
    """A share for each part."""
    return {part: table.number(part, least=0.0, most=1.0) for part in MouthPart}


def mixed(spoken: Floats, felt: Floats, utterance: Utterance, fps: float, *, lean: float = 1.0) -> Floats:
    """Frames that show an emotion while something is said.

    Parameters
    ----------
    spoken : (T, 68) what is said (`articulate`), FAP units; NaN for FAPs that speech leaves alone.
    felt : (T, 68) what the emotion shows, FAP units; NaN where it shows nothing.
    fps : frames per second of both.
    lean : how far the mouth leans to the emotion while speaking, 0 to 2.

    Returns
    -------
    (T, 68) float64, FAP units; NaN where neither asks.

    Raises
    ------
    ParameterError : shapes that differ, or a value outside its range.
    """
    return run(mixed_steps(spoken, felt, utterance, fps, lean=lean))


def mixed_steps(spoken: Floats, felt: Floats, utterance: Utterance, fps: float, *, lean: float = 1.0) -> Work[Floats]:
    """`mixed`, bit by bit."""
    if spoken.shape != felt.shape or spoken.shape[1:] != (FAP_COUNT,):
        raise ParameterError("felt", f"must have the shape of spoken, {spoken.shape}", felt.shape)
    if not 0.0 <= lean <= MOST:
        raise ParameterError("lean", f"must be from 0 to {MOST:g}", lean)
    how, figures = manner(), sharing()
    times = np.arange(len(spoken)) / fps
    speaking = yield from part_of(_speaking(utterance, times, figures.turn, how.pause), 0.0, 0.4)
    closure = yield from part_of(_closure(utterance, times, how), 0.4, 0.7)
    rounding = np.clip(
        np.nan_to_num(spoken[:, [number - 1 for number in FAPS_OF[MouthPart.ROUNDING]]]).mean(axis=1)
        / figures.rounded_full,
        0.0,
        1.0,
    )
    yield Progress(0.7, "Speech and feeling mixed")
    frames, kept = np.where(np.isnan(spoken), felt, spoken), beside_jaw(np.nan_to_num(felt))
    for part in MouthPart:
        share = np.full(len(times), lean * figures.speaking[part])
        if part is MouthPart.WIDTH:
            share = share * (1.0 - rounding * (1.0 - figures.rounded_width))
        share = np.minimum(share * (1.0 - closure * (1.0 - figures.closed[part])), 1.0)
        kept[:, [number - 1 for number in FAPS_OF[part]]] *= (1.0 - speaking * (1.0 - share))[:, None]
    yield Progress(0.9, "Speech and feeling mixed")
    # A jaw that opens less takes less of the lower lip along.
    both = np.nan_to_num(spoken) + carried_by_jaw(kept)
    shared = [number - 1 for part in MouthPart for number in FAPS_OF[part]]
    asked = ~(np.isnan(spoken[:, shared]) & np.isnan(felt[:, shared]))
    frames[:, shared] = np.where(asked, both[:, shared], np.nan)
    return frames


def _speaking(utterance: Utterance, times: Floats, turn: float, pause: float) -> Work[Floats]:
    """(T,) how far the mouth is speech's: 1 while sounds last, 0 in pauses, evenly between."""
    share = np.zeros(len(times))
    runs = _runs(utterance, pause)
    for number, (start, end) in enumerate(runs):
        if number % AT_ONCE == 0:
            yield Progress.counted(number, len(runs), "stretches of speech found")
        near = span(times, start - turn, end + turn)
        away = np.maximum(np.maximum(start - times[near], times[near] - end), 0.0)
        share[near] = np.maximum(share[near], 0.5 + 0.5 * np.cos(np.pi * np.clip(away / turn, 0.0, 1.0)))
    return share


def _runs(utterance: Utterance, pause: float) -> list[tuple[float, float]]:
    """From when to when something is said without a pause."""
    runs: list[tuple[float, float]] = []
    for sound in utterance.sounds:
        if runs and sound.start - runs[-1][1] < pause:
            runs[-1] = (runs[-1][0], sound.end)
        else:
            runs.append((sound.start, sound.end))
    return runs


def _closure(utterance: Utterance, times: Floats, how: Manner) -> Work[Floats]:
    """(T,) how far lips are held closed or at the teeth."""
    step = float(times[1] - times[0]) if len(times) > 1 else 0.0
    share = np.zeros(len(times))
    for number, sound in enumerate(utterance.sounds):
        if number % AT_ONCE == 0:
            yield Progress.counted(number, len(utterance.sounds), "closures found")
        if sound.phoneme.own and (closure := how.closures.get(sound.phoneme.viseme)) is not None:
            aim = Aim(sound.start, sound.end, sound.phoneme.viseme, np.empty(0), sound.strength)
            near = span(times, *reached(aim, closure, step))
            share[near] = np.maximum(share[near], closing(aim, closure, times[near], step))
    return share
