"""Expressions in time: onset, apex, offset, and several expressions blended where they overlap.

How fast, how strongly and along which ramp the kinds of expressions come and go stands in presets/timing.toml.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from enum import StrEnum
from pathlib import Path
from types import MappingProxyType

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError
from ..resources import PRESETS
from ..tables import TomlTable, read_toml
from .emotions.profile import ARCHETYPES, Profile
from .standard import FRAMES_LIMIT, check_fps

TIMINGS = PRESETS / "timing.toml"
"""The timing presets that come with Risorius."""

# A film's rate where the caller names none: the rate of most .fap files met.
DEFAULT_FPS = 25.0


def _check_seconds(name: str, value: float) -> None:
    """A duration: finite, not negative."""
    if not (isinstance(value, int | float | np.number) and math.isfinite(value) and value >= 0.0):
        raise ParameterError(name, "must be a number of seconds, 0 or more", value)


def _check_peak(value: float) -> None:
    """A strength: 0 to 1."""
    if not 0.0 <= value <= 1.0:
        raise ParameterError("peak", "must be in 0..1", value)


class Ramp(StrEnum):
    """How an expression comes and goes within its onset and offset.

    minimum_jerk : 10 s^3 - 15 s^4 + 6 s^5, as aimed movements go (T. Flash, N. Hogan 1985, J. Neurosci. 5:1688-1703):
        no speed and acceleration at its ends, and the fastest in between, 15/8 of the mean speed.
    cosine : (1 - cos(pi s)) / 2, gentler: pi/2 of the mean speed at most.
    """

    MINIMUM_JERK = "minimum_jerk"
    COSINE = "cosine"

    def at(self, since: Floats, duration: float) -> Floats:
        """From 0 to 1 as times (T,) since its beginning go through a duration, seconds; a step if it is none."""
        if duration < 1e-12:
            return np.where(since >= 0.0, 1.0, 0.0)
        s = np.clip(since / duration, 0.0, 1.0)
        if self is Ramp.COSINE:
            return np.asarray(0.5 - 0.5 * np.cos(np.pi * s))
        return np.clip(s**3 * (10.0 - 15.0 * s + 6.0 * s**2), 0.0, 1.0)  # rounding may pass 1


@dataclass(frozen=True)
class Timing:
    """How one kind of expression goes through time.

    Attributes
    ----------
    name, reason, source : what it is called, what it is for, where its figures come from.
    onset, apex, offset : seconds it takes to appear, stays, and takes to fade.
    peak : strength at the apex of an expression that is asked for in full, 0..1.
    ramp : how it appears and fades.

    Raises
    ------
    ParameterError
        When a time is negative or the peak is outside 0..1.
    """

    name: str
    onset: float
    apex: float
    offset: float
    reason: str
    _: KW_ONLY
    peak: float = 1.0
    ramp: Ramp = Ramp.MINIMUM_JERK
    source: str = ""

    def __post_init__(self) -> None:
        """Check durations and peak."""
        for key in ("onset", "apex", "offset"):
            _check_seconds(key, getattr(self, key))
        _check_peak(self.peak)

    def cue(self, profile: Profile, *, start: float = 0.0, seed: int | None = None) -> Cue:
        """An expression with this timing, beginning at `start` seconds; seed as in `Cue`."""
        return Cue(
            profile,
            start=start,
            onset=self.onset,
            apex=self.apex,
            offset=self.offset,
            peak=self.peak,
            seed=seed,
            ramp=self.ramp,
        )


@dataclass(frozen=True)
class Cue:
    """One expression at one time.

    Attributes
    ----------
    profile : what is shown.
    start : seconds at which the onset begins.
    onset, apex, offset : seconds it takes to appear, stays, and takes to fade.
    peak : strength at the apex, 0..1.
    seed : None for the midpoints of the ranges, else a draw inside them.
    ramp : how it appears and fades.

    Raises
    ------
    ParameterError
        When a time is negative, nothing lasts, or the peak is outside 0..1.

    Examples
    --------
    >>> cue = api.Cue(api.expression("joy"), onset=0.4, apex=1.0, offset=0.6)
    >>> cue.strength(np.array([0.0, 0.2, 0.4, 1.4, 2.0])).round(3).tolist()
    [0.0, 0.5, 1.0, 1.0, 0.0]
    """

    profile: Profile
    _: KW_ONLY
    start: float = 0.0
    onset: float
    apex: float
    offset: float
    peak: float = 1.0
    seed: int | None = None
    ramp: Ramp = Ramp.MINIMUM_JERK

    def __post_init__(self) -> None:
        """Check times and peak."""
        for key in ("start", "onset", "apex", "offset"):
            _check_seconds(key, getattr(self, key))
        if not self.duration > 0.0:
            raise ParameterError("onset + apex + offset", "must be more than 0 seconds", self.duration)
        _check_peak(self.peak)

    @property
    def duration(self) -> float:
        """Seconds from the first sign to the last."""
        return self.onset + self.apex + self.offset

    def strength(self, times: Floats) -> Floats:
        """Strength 0..peak at times (T,) in seconds, rising and falling along the ramp."""
        since = times - self.start
        rise = self.ramp.at(since, self.onset)
        fall = self.ramp.at(since - self.onset - self.apex, self.offset)
        inside = (since >= 0.0) & (since <= self.duration)
        return np.asarray(np.where(inside, self.peak * np.minimum(rise, 1.0 - fall), 0.0), dtype=np.float64)


def envelope(
    profile: Profile,
    *,
    onset: float,
    apex: float,
    offset: float,
    fps: float = DEFAULT_FPS,
    peak: float = 1.0,
    seed: int | None = None,
    ramp: Ramp | str = Ramp.MINIMUM_JERK,
) -> Floats:
    """FAP frames of one expression that appears, stays and fades.

    Parameters
    ----------
    profile, onset, apex, offset, peak, seed, ramp : as in `Cue`.
    fps : frames per second.

    Returns
    -------
    (T, 68) float64, FAP units, frame k at k / fps seconds, the first and the last at rest; NaN columns where the
    profile is silent.

    Raises
    ------
    ParameterError
        When a time, the rate, the peak or the ramp breaks its rule.

    Examples
    --------
    >>> frames = api.envelope(api.expression("joy"), onset=0.4, apex=1.0, offset=0.6, fps=25.0)
    >>> frames.shape
    (51, 68)
    >>> frames[[0, 10, -1], 12 - 1].round(1).tolist()  # raise_l_cornerlip
    [0.0, 300.0, 0.0]
    """
    if ramp not in list(Ramp):
        raise ParameterError("ramp", f"must be one of {', '.join(Ramp)}", ramp)
    cue = Cue(profile, onset=onset, apex=apex, offset=offset, peak=peak, seed=seed, ramp=Ramp(ramp))
    return sequence([cue], fps=fps)


def sequence(cues: Sequence[Cue], *, fps: float = DEFAULT_FPS) -> Floats:
    """FAP frames of several expressions.

    Each FAP is the mean of what the cues that ask for it want, weighted by their strength, times their summed
    strength where that is below 1: one cue alone is as strong as it says, a cross-fade keeps a FAP that both hold,
    and two at full strength share it instead of doubling it.

    Parameters
    ----------
    cues : at least one, in any order.
    fps : frames per second.

    Returns
    -------
    (T, 68) float64, FAP units, frame k at k / fps seconds, from 0 to the end of the last cue; NaN columns for FAPs
    that no cue asks for, 0 where a FAP is asked for at other times only.

    Raises
    ------
    ParameterError
        When there is no cue or the rate is not positive.

    Examples
    --------
    >>> joy = api.Cue(api.expression("joy"), onset=0.4, apex=1.0, offset=0.6)
    >>> fear = api.Cue(api.expression("fear"), start=1.4, onset=0.4, apex=1.0, offset=0.6)
    >>> api.sequence([joy, fear], fps=25.0).shape
    (86, 68)
    """
    return _mixed(cues, strengths(cues, fps=fps))


def sequence_at(cues: Sequence[Cue], times: Floats) -> Floats:
    """(T, 68) as `sequence`, at any times (T,) in seconds, before the first cue and after the last one too."""
    return _mixed(cues, np.array([cue.strength(times) for cue in cues]).reshape(len(cues), len(times)).T)


def _mixed(cues: Sequence[Cue], strength: Floats) -> Floats:
    """(T, 68) FAPs of cues at strengths (T, C)."""
    wanted = np.array([cue.profile.frame(cue.seed) for cue in cues])  # (C, 68)
    asks = ~np.isnan(wanted)
    summed = strength @ asks.astype(np.float64)
    frames = strength @ np.where(asks, wanted, 0.0) / np.maximum(summed, 1.0)
    return np.asarray(np.where(asks.any(axis=0), frames, np.nan), dtype=np.float64)


def emotion_weights(cues: Sequence[Cue], *, fps: float = DEFAULT_FPS) -> Floats:
    """How strongly each archetype is shown at each frame of `sequence`.

    Returns
    -------
    (T, 6) float64 in 0..1, columns in the order of `ARCHETYPES`. A word's category counts whole; a word between two
    archetypes is split by nearness in angle; overlapping cues share as their FAPs do, so a row never exceeds 1.

    Raises
    ------
    ParameterError
        As `sequence`.

    Examples
    --------
    >>> joy = api.Cue(api.expression("joy"), onset=0.4, apex=1.0, offset=0.6)
    >>> shown = api.emotion_weights([joy], fps=25.0)
    >>> shown[10, api.ARCHETYPES.index("joy")].tolist()
    1.0
    """
    strength = strengths(cues, fps=fps)
    shares = np.array([[cue.profile.weights.get(name, 0.0) for name in ARCHETYPES] for cue in cues])
    return np.asarray(strength @ shares / np.maximum(strength.sum(axis=1, keepdims=True), 1.0), dtype=np.float64)


def strengths(cues: Sequence[Cue], *, fps: float = DEFAULT_FPS) -> Floats:
    """(T, C) strength 0..1 of every cue at every frame, up to the first frame at or after the last cue's end.

    Raises
    ------
    ParameterError
        As `sequence`.
    """
    times = np.arange(step_count(cues, fps)) / fps
    return np.stack([cue.strength(times) for cue in cues], axis=1)


def step_count(cues: Sequence[Cue], fps: float) -> int:
    """How many frames cues last: up to the first one at or after the last cue's end.

    Raises
    ------
    ParameterError
        As `sequence`.
    """
    check_fps(fps)
    if not cues:
        raise ParameterError("cues", "must contain at least one cue", 0)
    end = max(cue.start + cue.duration for cue in cues)
    if not end * fps < FRAMES_LIMIT:
        raise ParameterError("cues", f"must end within {FRAMES_LIMIT} frames", end * fps)
    return math.ceil(end * fps - 1e-6) + 1  # a millionth of a frame is rounding, not time


def load_timings(path: str | Path = TIMINGS) -> Mapping[str, Timing]:
    """Timing presets by name out of a TOML file.

    Tables with onset, apex, offset (seconds) and reason; peak (1 if left out), ramp (minimum_jerk) and source if known.

    Raises
    ------
    FormatError
        Names the file, the key and the rule it breaks.

    Examples
    --------
    >>> timing = api.load_timings()["spontaneous"]
    >>> timing.onset < timing.offset
    True
    """
    document = read_toml(path)
    return MappingProxyType({name: _timing(name, document.table(name)) for name in document})


def _timing(name: str, table: TomlTable) -> Timing:
    """One preset."""
    table.only("onset", "apex", "offset", "reason", "peak", "ramp", "source")
    return Timing(
        name,
        onset=table.number("onset", least=0.0),
        apex=table.number("apex", least=0.0),
        offset=table.number("offset", least=0.0),
        reason=table.text("reason"),
        peak=table.number("peak", 1.0, least=0.0, most=1.0),
        ramp=table.choice("ramp", Ramp, Ramp.MINIMUM_JERK),
        source=table.text("source", ""),
    )
