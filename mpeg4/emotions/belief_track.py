"""Beliefs over time: a FAP stream recognised frame by frame, the verdicts along it, and their table.

Beliefs are each frame's own. By the paper's rule so is the verdict. By the robust rule the verdicts are the sequence
that the whole stream makes most plausible: a face comes from rest and goes back to it, and does not show something else
for the moment between.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Floats, Ints
from ...errors import ParameterError
from ...progress import Progress, Report
from ...tables import write_csv
from ..standard import FAP_COUNT, FAPS
from .profile import ARCHETYPES
from .recognition import NEUTRAL, Rule, Verdict, checked_weights, recognise, shown_strength

#: What a change of the verdict costs, from or to the neutral face and from one emotion to another: so many seconds,
#: times the halvings by which the new one must be believed more (own choice). The first is what a first frame that is
#: not neutral costs, too; less in a stream of under a second, which need not begin at rest.
REST_CHANGE, CHANGE = 0.03, 0.15

#: Belief below which verdicts are all alike.
LEAST_BELIEF = 1e-3


@dataclass(frozen=True, eq=False)
class BeliefTrack:
    """What each frame of a stream shows.

    Attributes
    ----------
    frames : (T, 68) FAPs in FAP units, NaN where not observed.
    beliefs : (T, 6) in [0, 1]; columns as in `ARCHETYPES`.
    strengths : (T,) how strongly the most believed emotion is shown (`recognition.shown_strength`).
    fps : frames per second.
    first_frame : number of the first frame.
    neutral : (T,) belief that the face rests, NaN where too little was seen; None by the paper's rule.
    """

    frames: Floats
    beliefs: Floats
    strengths: Floats
    fps: float = 25.0
    first_frame: int = 0
    neutral: Floats | None = None

    @property
    def numbers(self) -> Floats:
        """(T,) numbers of the frames."""
        return self.first_frame + np.arange(len(self.frames), dtype=np.float64)

    @cached_property
    def best(self) -> tuple[Verdict, ...]:
        """The verdict on each frame; None where nothing is believed. By the robust rule also "neutral"."""
        if self.neutral is None:
            return tuple(ARCHETYPES[row.argmax()] if row.any() else None for row in self.beliefs)
        believed = np.column_stack([self.neutral, self.beliefs])
        known = ~np.isnan(self.neutral)
        path = _most_plausible(np.where(known[:, None], believed, 1.0), self.fps)
        verdicts: tuple[Verdict, ...] = (NEUTRAL, *ARCHETYPES)
        return tuple(verdicts[state] if there else None for state, there in zip(path, known, strict=True))


def _most_plausible(believed: Floats, fps: float) -> Ints:
    """(T,) the most plausible sequence of columns of beliefs (T, 7), the neutral face first: Viterbi's algorithm."""
    gains = np.log2(np.maximum(believed, LEAST_BELIEF)) / fps
    count = believed.shape[1]
    costs = np.full((count, count), CHANGE)
    costs[0], costs[:, 0] = REST_CHANGE, REST_CHANGE
    np.fill_diagonal(costs, 0.0)
    came = np.zeros(believed.shape, dtype=np.int64)
    total = np.where(np.arange(count) == 0, 0.0, -REST_CHANGE * min(1.0, len(gains) / fps))
    for step, gain in enumerate(gains):
        ways = total[:, None] - costs
        came[step] = ways.argmax(axis=0) if step else np.arange(count)
        total = (ways.max(axis=0) if step else total) + gain
    path = np.zeros(len(believed), dtype=np.int64)
    state = int(total.argmax())
    for step in range(len(believed) - 1, -1, -1):
        path[step] = state
        state = int(came[step, state])
    return path


def recognise_over_time(
    frames: ArrayLike,
    *,
    rule: str | Rule = Rule.PAPER,
    confidence: ArrayLike | None = None,
    doubt: ArrayLike | None = None,
    fps: float = 25.0,
    first_frame: int = 0,
    progress: Report | None = None,
) -> BeliefTrack:
    """Beliefs in the six emotions for each frame of a stream.

    Parameters
    ----------
    frames : (T, 68) FAPs in FAP units and MPEG-4 signs; NaN where not observed.
    rule, doubt : as for `recognise`. confidence : (T, 68) as there, for each frame.
    fps : frames per second. first_frame : number of the first frame.
    progress : called after each frame.

    Raises
    ------
    ParameterError
        When the frames have another shape or infinite values, and as `recognise`.

    Examples
    --------
    >>> frames = api.envelope(api.expression("joy"), onset=0.2, apex=0.2, offset=0.2, fps=10.0)
    >>> print(api.recognise_over_time(frames, fps=10.0).best[3])
    joy
    """
    values = np.asarray(frames, dtype=np.float64)
    if values.ndim != 2 or values.shape[1] != FAP_COUNT:
        raise ParameterError("frames", f"must have the shape (T, {FAP_COUNT})", values.shape)
    chosen = Rule.of(rule)
    sure, modes = checked_weights(chosen, confidence, doubt, values.shape)
    beliefs, strengths = np.zeros((len(values), len(ARCHETYPES))), np.zeros(len(values))
    neutral = np.full(len(values), np.nan)
    for index, frame in enumerate(values):
        found = recognise(frame, rule=chosen, confidence=None if sure is None else sure[index], doubt=modes)
        beliefs[index] = [found[name] for name in ARCHETYPES]
        neutral[index] = np.nan if found.neutral is None else found.neutral
        profile = found.best_profile
        strengths[index] = 0.0 if profile is None else shown_strength(frame, profile)
        if progress is not None:
            progress(Progress.counted(index + 1, len(values), "frames"))
    rests = neutral if chosen is Rule.ROBUST else None
    return BeliefTrack(values, beliefs, strengths, fps, first_frame, rests)


def write_belief_csv(path: str | Path, track: BeliefTrack) -> None:
    """Write a table: frame, seconds, the six beliefs (by the robust rule neutral's, too), the verdict, strength, and
    every FAP that some frame has.

    FAP columns are called F3_open_jaw and so on, in FAP units; a cell is empty where a FAP was not observed.

    Raises
    ------
    FormatError
        When the file cannot be written.

    Examples
    --------
    >>> frames = api.envelope(api.expression("joy"), onset=0.2, apex=0.2, offset=0.2, fps=10.0)
    >>> api.write_belief_csv("beliefs.csv", api.recognise_over_time(frames, fps=10.0))
    >>> open("beliefs.csv").readline()[:22]
    'frame,seconds,joy,sadn'
    """
    seen = [number for number in FAPS if not np.isnan(track.frames[:, number - 1]).all()]
    beliefs = track.beliefs if track.neutral is None else np.column_stack([track.beliefs, track.neutral])
    named = [*map(str, ARCHETYPES), *([NEUTRAL] if track.neutral is not None else [])]
    head = ["frame", "seconds", *named, "best", "strength"]
    rows = []
    for index, (number, best) in enumerate(zip(track.numbers, track.best, strict=True)):
        frame = track.frames[index]
        values = ["" if np.isnan(frame[n - 1]) else f"{frame[n - 1]:.2f}" for n in seen]
        time = [f"{number:.0f}", f"{index / track.fps:.4f}"]
        figures = ["" if np.isnan(belief) else f"{belief:.6g}" for belief in beliefs[index]]
        rows.append([*time, *figures, best or "", f"{track.strengths[index]:.4f}", *values])
    write_csv(path, [*head, *(f"F{number}_{FAPS[number].name}" for number in seen)], rows)
