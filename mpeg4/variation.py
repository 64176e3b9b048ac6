"""What makes a performance look alive: expressions drawn within their ranges, blinks, small motions of head and eyes.

Everything is drawn from seeds: the same seed gives the same motion at any frame rate, and a longer one begins like a
shorter one. Figures and their sources stand in presets/variation.toml.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from pathlib import Path
from typing import TypeVar

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError
from ..resources import PRESETS
from ..tables import TomlTable, read_toml
from .emotions.profile import ARCHETYPES, Archetype, Profile
from .emotions.prototypes import load_prototypes
from .standard import ANGLE_UNIT, FAP_COUNT, FRAMES_LIMIT, check_fps
from .timing import Cue, Ramp

HABITS = PRESETS / "variation.toml"
"""The figures that come with Risorius."""

#: FAPs of the lids (upper left and right, lower left and right), the head (pitch, yaw, roll), the eyes (yaw, pitch).
UPPER_LIDS, LOWER_LIDS = (19, 20), (21, 22)
HEAD, EYES_ASIDE, EYES_DOWN = (48, 49, 50), (23, 24), (25, 26)

#: Blinks per minute, and multiples of the usual motions of head and eyes, at most.
MOST_BLINKS, MOST_MOVED = 300.0, 20.0

#: Seconds of blinks and looks, at most: a day and more.
LONGEST = 1e5

#: Units of IRISD0 that make the neutral gap of the lids.
GAP = 1024.0


@dataclass(frozen=True)
class BlinkHabit:
    """How blinks go: per minute, seconds, and shares of the lids' gap; see presets/variation.toml."""

    rate: float
    interval_spread: float
    closing: float
    closed: float
    opening: float
    duration_spread: float
    upper: float
    lower: float


@dataclass(frozen=True)
class HeadHabit:
    """How a head moves that is held still: hertz, number of waves an axis, degrees, seconds."""

    slowest: float
    fastest: float
    waves: int
    pitch: float
    yaw: float
    roll: float
    settle: float


@dataclass(frozen=True)
class EyesHabit:
    """How eyes look about: seconds, degrees."""

    fixation: float
    fixation_spread: float
    aside: float
    vertical: float
    shift_least: float
    shift_per_degree: float
    settle: float


@dataclass(frozen=True)
class Habits:
    """All of them."""

    blink: BlinkHabit
    head: HeadHabit
    eyes: EyesHabit


@lru_cache(maxsize=4)
def load_habits(path: str | Path = HABITS) -> Habits:
    """Read the figures.

    Raises
    ------
    FormatError : names the file, the key and what is wrong.
    """
    document = read_toml(path)
    return Habits(
        _habit(document.table("blink"), BlinkHabit),
        _habit(document.table("head"), HeadHabit),
        _habit(document.table("eyes"), EyesHabit),
    )


H = TypeVar("H")


def _habit(table: TomlTable, kind: type[H]) -> H:
    """One table: positive numbers and nothing else besides a source."""
    types = {field.name: field.type for field in fields(kind)}  # type: ignore[arg-type]
    table.only(*types, "source")
    table.text("source")
    return kind(
        **{
            name: table.integer(name, least=1) if of == "int" else table.number(name, above=0.0)
            for name, of in types.items()
        }
    )


@dataclass(frozen=True)
class Drawn:
    """How much of something is drawn, and from which seed."""

    amount: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        """Check both."""
        if not (math.isfinite(self.amount) and self.amount >= 0.0):
            raise ParameterError("amount", "must be 0 or more", self.amount)
        if not isinstance(self.seed, int | np.integer) or self.seed < 0:
            raise ParameterError("seed", "must be a whole number, 0 or more", self.seed)


@dataclass(frozen=True)
class Liveliness:
    """What a face does besides its expressions.

    Attributes
    ----------
    blinks : amount in blinks per minute. head, eyes : amount as a multiple of the usual. Words that turn head and eyes
        (`Bearing`) do so as far as these are above 0, and in full from 1 on.

    Raises
    ------
    ParameterError : more blinks than there is time for, or motions beyond head and eyes.
    """

    blinks: Drawn = Drawn()
    head: Drawn = Drawn()
    eyes: Drawn = Drawn()

    def __post_init__(self) -> None:
        """Check that a face can do so much."""
        for name, most in (("blinks", MOST_BLINKS), ("head", MOST_MOVED), ("eyes", MOST_MOVED)):
            amount = getattr(self, name).amount
            if amount > most:
                raise ParameterError(f"amount of {name}", f"must be {most:g} or less", amount)

    @classmethod
    def usual(cls, seed: int | None = None) -> Liveliness:
        """Blinks and small motions of head and eyes as usual at rest (presets/variation.toml), drawn by a seed."""
        number = 0 if seed is None else seed
        return cls(blinks=Drawn(load_habits().blink.rate, number), head=Drawn(1.0, number), eyes=Drawn(1.0, number))

    @property
    def any(self) -> bool:
        """Whether it does anything."""
        return any(drawn.amount > 0.0 for drawn in (self.blinks, self.head, self.eyes))

    def borne(self, frame: Floats, cues: Iterable[tuple[Cue, float]]) -> Floats:
        """A frame (68,) with what the words of cues, each in its share, do with head and eyes."""
        result = frame
        for cue, share in cues:
            if cue.profile.bearing is not None and share > 0.0:
                turned = share * cue.profile.bearing.frame(
                    eyes=min(self.eyes.amount, 1.0), head=min(self.head.amount, 1.0)
                )
                result = np.where(np.isnan(turned), result, np.nan_to_num(result) + np.nan_to_num(turned))
        return result

    def borne_all(self, frames: Floats, cues: Sequence[Cue], shares: Floats) -> Floats:
        """Frames (T, 68) with the same, of cues in shares (T, C)."""
        result = frames
        for cue, share in zip(cues, shares.T, strict=True):
            if cue.profile.bearing is not None:
                full = cue.profile.bearing.frame(eyes=min(self.eyes.amount, 1.0), head=min(self.head.amount, 1.0))
                turned = (share > 0.0)[:, None] & ~np.isnan(full)
                result = np.where(turned, np.nan_to_num(result) + share[:, None] * np.nan_to_num(full), result)
        return result

    def over(self, count: int, fps: float, habits: Habits | None = None) -> Overlay:
        """What is laid over `count` frames."""
        known = load_habits() if habits is None else habits
        moved = head_motion(count, fps, self.head, known.head)
        eyes = eye_motion(count, fps, self.eyes, known.eyes)
        closure = blink_closure(count, fps, self.blinks, known.blink)
        return Overlay(np.where(np.isnan(moved), eyes, moved), closure, known.blink)


@dataclass(frozen=True, eq=False)
class Overlay:
    """What is laid over frames of FAPs.

    Attributes
    ----------
    added : (T, 68) FAP units added to what is asked; NaN where nothing is.
    closure : (T,) how far the lids are closed on their way from where they are, 0..1.
    habit : how lids close.
    """

    added: Floats
    closure: Floats
    habit: BlinkHabit

    def __len__(self) -> int:
        """Frames."""
        return len(self.added)

    def upon(self, frame: Floats, number: int) -> Floats:
        """A frame (68,) with that of this number laid over it; NaN stays where neither says anything."""
        only = replace(self, added=self.added[number : number + 1], closure=self.closure[number : number + 1])
        return np.asarray(only.upon_all(frame[None])[0])

    def upon_all(self, frames: Floats) -> Floats:
        """Frames (T, 68) with all of it laid over them."""
        laid = np.where(np.isnan(self.added), frames, np.nan_to_num(frames) + np.nan_to_num(self.added))
        shut = np.flatnonzero(self.closure > 0.0)
        if not len(shut):
            return laid
        for lids, share in ((UPPER_LIDS, self.habit.upper), (LOWER_LIDS, self.habit.lower)):
            place = np.ix_(shut, np.array(lids) - 1)
            open_at = np.nan_to_num(laid[place])
            laid[place] = open_at + self.closure[shut, None] * (np.maximum(share * GAP, open_at) - open_at)
        return laid


def drawn_within(profile: Profile, drawn: Drawn) -> Profile:
    """A profile whose ranges have shrunk to one draw inside them.

    An amount of 0 is their middle, 1 a draw as `Profile.frame` makes it, and between on the way from one to the other.
    The way of showing it is drawn, too; see `way_drawn`.

    Raises
    ------
    ParameterError : the amount is above 1.

    Examples
    --------
    >>> joy = api.expression("joy")
    >>> low, high = api.drawn_within(joy, api.Drawn(amount=1.0, seed=3)).ranges[12]
    >>> low == high
    True
    >>> joy.ranges[12][0] <= low <= joy.ranges[12][1]
    True
    """
    if drawn.amount > 1.0:
        raise ParameterError("amount of draws", "must be in 0..1", drawn.amount)
    middle, draw = profile.frame(), profile.frame(np.random.default_rng(drawn.seed))
    frame = middle + drawn.amount * (draw - middle)
    ranges = {number: (float(frame[number - 1]),) * 2 for number in profile.ranges}
    return replace(way_drawn(profile, drawn), ranges=ranges)


def way_drawn(profile: Profile, drawn: Drawn) -> Profile:
    """A profile shown in one of the ways in which people show its emotions: anger with bared teeth or pressed lips.

    An emotion is shown as is usual unless the draw, by chance as large as the amount, picks one of its ways, each
    alike. What was chosen stays: a way, a variant of Table 5, a word's own action units.

    Returns
    -------
    The profile, whose `prototypes` name what was drawn, where there was a choice.

    Examples
    --------
    >>> anger = api.expression("anger")
    >>> sorted({api.way_drawn(anger, api.Drawn(1.0, seed)).prototypes["anger"] for seed in range(9)})
    ['bared', 'glaring', 'pressed']
    >>> api.way_drawn(api.expression("anger", variants="pressed"), api.Drawn(1.0, 2)).prototypes["anger"]
    'pressed'
    """
    if profile.shows is not None:
        return profile
    ways = {emotion: list(load_prototypes()[emotion]) for emotion in profile.weights}
    open_to_choice = {emotion for emotion, names in ways.items() if len(names) > 1} - set(profile.prototypes)
    shown: dict[Archetype, str] = dict(profile.prototypes)
    for number, emotion in enumerate(ARCHETYPES):
        if emotion in open_to_choice:
            chance, place = np.random.default_rng((drawn.seed, number)).random(2)
            names = ways[emotion]
            shown[emotion] = names[int(place * len(names))] if chance < drawn.amount else names[0]
    return replace(profile, prototypes=shown)


def blink_closure(count: int, fps: float, blinks: Drawn, habit: BlinkHabit) -> Floats:
    """(T,) closure 0..1 of blinks whose intervals are log-normal; the first comes within one interval."""
    times = _times(count, fps)
    closure = np.zeros(count)
    if blinks.amount == 0.0 or count == 0:
        return closure
    rng = np.random.default_rng(blinks.seed)
    mean = 60.0 / blinks.amount
    log_mean = math.log(mean) - habit.interval_spread**2 / 2.0
    begin = float(rng.uniform(0.0, 1.0) * rng.lognormal(log_mean, habit.interval_spread))
    while begin < times[-1]:
        slowness = float(rng.lognormal(0.0, habit.duration_spread))
        shut, hold = habit.closing * slowness, (habit.closing + habit.closed) * slowness
        lasts = hold + habit.opening * slowness
        near = slice(int(begin * fps), int((begin + lasts) * fps) + 2)
        since = times[near] - begin
        one = Ramp.MINIMUM_JERK.at(since, shut) - Ramp.MINIMUM_JERK.at(since - hold, lasts - hold)
        closure[near] = np.maximum(closure[near], one)
        begin += max(lasts, float(rng.lognormal(log_mean, habit.interval_spread)))
    return closure


def head_motion(count: int, fps: float, head: Drawn, habit: HeadHabit) -> Floats:
    """(T, 68) small turns of the head as FAPs 48-50: waves of several frequencies, at rest at both ends."""
    times = _times(count, fps)
    frames = np.full((count, FAP_COUNT), np.nan)
    if head.amount == 0.0:
        return frames
    rng = np.random.default_rng(head.seed)
    ends = _settled(times, habit.settle, habit.settle)
    for number, degrees in zip(HEAD, (habit.pitch, habit.yaw, habit.roll), strict=True):
        low, high = math.log(habit.slowest), math.log(habit.fastest)
        pace, phase = np.exp(rng.uniform(low, high, habit.waves)), rng.uniform(0.0, 2.0 * np.pi, habit.waves)
        waves = np.sin(2.0 * np.pi * times[:, None] * pace + phase).sum(axis=1) * math.sqrt(2.0 / habit.waves)
        frames[:, number - 1] = head.amount * _units(degrees) * ends * waves
    return frames


def eye_motion(count: int, fps: float, eyes: Drawn, habit: EyesHabit) -> Floats:
    """(T, 68) looks of both eyes as FAPs 23-26: saccades between fixations, straight ahead at both ends."""
    times = _times(count, fps)
    frames = np.full((count, FAP_COUNT), np.nan)
    if eyes.amount == 0.0:
        return frames
    rng = np.random.default_rng(eyes.seed)
    gaze, held, here, begin = np.zeros((count, 2)), np.zeros((count + 1, 2)), np.zeros(2), 0.0
    end = times[-1] - habit.settle if count else 0.0
    while True:
        begin += float(rng.lognormal(math.log(habit.fixation), habit.fixation_spread))
        there = eyes.amount * habit.aside * rng.standard_normal(2) * (1.0, habit.vertical)
        if begin >= end:
            begin, there = end, np.zeros(2)
        lasts = habit.shift_least + habit.shift_per_degree * float(np.linalg.norm(there - here))
        near = slice(max(int(begin * fps), 0), min(max(int((begin + lasts) * fps) + 2, 0), count))
        gaze[near] += Ramp.MINIMUM_JERK.at(times[near] - begin, lasts)[:, None] * (there - here)
        held[near.stop] += there - here  # from then on, whatever follows
        if begin >= end:
            break
        here, begin = there, begin + lasts
    gaze += np.cumsum(held[:count], axis=0)
    for numbers, axis in ((EYES_ASIDE, 0), (EYES_DOWN, 1)):
        frames[:, [number - 1 for number in numbers]] = _units(1.0) * gaze[:, axis, None]
    return frames


def _times(count: int, fps: float) -> Floats:
    """(T,) seconds of frames."""
    check_fps(fps)
    if not 0 <= count <= FRAMES_LIMIT:
        raise ParameterError("count", f"must be 0 to {FRAMES_LIMIT} frames", count)
    if count / fps > LONGEST:
        raise ParameterError("frames", f"must last {LONGEST:.0f} seconds at most", count / fps)
    return np.arange(count) / fps


def _settled(times: Floats, rise: float, fall: float) -> Floats:
    """(T,) 0 at both ends and 1 between."""
    last = times[-1] if len(times) else 0.0
    return Ramp.MINIMUM_JERK.at(times, rise) * Ramp.MINIMUM_JERK.at(last - times, fall)


def _units(degrees: float) -> float:
    """FAP units of an angle."""
    return math.radians(degrees) / ANGLE_UNIT
