"""Beliefs over time: a FAP stream recognised frame by frame, and the table that it is written as."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Floats
from ...errors import ParameterError
from ...progress import Progress, Report
from ...tables import write_csv
from ..standard import FAP_COUNT, FAPS
from .profile import ARCHETYPES, Archetype
from .recognition import Rule, recognise, shown_strength


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
    """

    frames: Floats
    beliefs: Floats
    strengths: Floats
    fps: float = 25.0
    first_frame: int = 0

    @property
    def numbers(self) -> Floats:
        """(T,) numbers of the frames."""
        return self.first_frame + np.arange(len(self.frames), dtype=np.float64)

    @property
    def best(self) -> tuple[Archetype | None, ...]:
        """The most believed emotion of each frame; None where nothing is believed."""
        return tuple(ARCHETYPES[row.argmax()] if row.any() else None for row in self.beliefs)


def recognise_over_time(
    frames: ArrayLike,
    *,
    rule: str | Rule = Rule.PAPER,
    fps: float = 25.0,
    first_frame: int = 0,
    progress: Report | None = None,
) -> BeliefTrack:
    """Beliefs in the six emotions for each frame of a stream.

    Parameters
    ----------
    frames : (T, 68) FAPs in FAP units and MPEG-4 signs; NaN where not observed.
    rule : as for `recognise`.
    fps : frames per second. first_frame : number of the first frame.
    progress : called after each frame.

    Raises
    ------
    ParameterError
        When the frames have another shape or infinite values, or there is no such rule.

    Examples
    --------
    >>> frames = api.envelope(api.expression("joy"), onset=0.2, apex=0.2, offset=0.2, fps=10.0)
    >>> print(api.recognise_over_time(frames, fps=10.0).best[3])
    joy
    """
    values = np.asarray(frames, dtype=np.float64)
    if values.ndim != 2 or values.shape[1] != FAP_COUNT:
        raise ParameterError("frames", f"must have the shape (T, {FAP_COUNT})", values.shape)
    beliefs, strengths = np.zeros((len(values), len(ARCHETYPES))), np.zeros(len(values))
    for index, frame in enumerate(values):
        found = recognise(frame, rule=rule)
        beliefs[index] = [found[name] for name in ARCHETYPES]
        profile = found.best_profile
        strengths[index] = 0.0 if profile is None else shown_strength(frame, profile)
        if progress is not None:
            progress(Progress.counted(index + 1, len(values), "frames"))
    return BeliefTrack(values, beliefs, strengths, fps, first_frame)


def write_belief_csv(path: str | Path, track: BeliefTrack) -> None:
    """Write a table: frame, seconds, the six beliefs, the best one, strength, and every FAP that some frame has.

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
    head = ["frame", "seconds", *map(str, ARCHETYPES), "best", "strength"]
    rows = []
    for index, (number, best) in enumerate(zip(track.numbers, track.best, strict=True)):
        frame = track.frames[index]
        values = ["" if np.isnan(frame[n - 1]) else f"{frame[n - 1]:.2f}" for n in seen]
        time = [f"{number:.0f}", f"{index / track.fps:.4f}"]
        figures = [f"{belief:.6g}" for belief in track.beliefs[index]]
        rows.append([*time, *figures, best or "", f"{track.strengths[index]:.4f}", *values])
    write_csv(path, [*head, *(f"F{number}_{FAPS[number].name}" for number in seen)], rows)
