"""The neutral face of a recording: which of its rows show it, and scores counted from it.

A tracker's zero is the usual face of many people, and some person's rest is another: lips that part, brows that hang.
What the chosen rows show at all is taken off every row.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeAlias

import numpy as np

from ...arrays import Floats, Ints
from ...errors import ParameterError
from ...mpeg4.streams.capture import Samples

#: Seconds from and to which the face is neutral, or the number of a frame at the recording's own rate; both count from
#: the first row.
Neutral: TypeAlias = tuple[float, float] | int

#: A row is at a frame where it is within this share of an interval.
AT_FRAME = 0.5


def neutral_rows(neutral: Neutral, times: Floats, rate: float) -> Ints:
    """Rows, at times (T,) in seconds, that show the neutral face.

    Raises
    ------
    ParameterError : there is no such row; names the last one.
    """
    if isinstance(neutral, int):
        rows = np.flatnonzero(np.abs(times * rate - neutral) <= AT_FRAME)
        within = f"must be a frame with a face, 0..{round(times[-1] * rate)}"
    else:
        rows = np.flatnonzero((times >= neutral[0]) & (times <= neutral[1]))
        within = f"must be in 0..{times[-1]:.2f} seconds"
    if len(rows) == 0:
        raise ParameterError("neutral", within, neutral)
    return np.asarray(rows, dtype=np.int64)


def counted_from(samples: Samples, neutral: Neutral) -> Samples:
    """Samples of which every FAP is 0 where the face is neutral.

    Raises
    ------
    ParameterError : there is no such row, or none in which a face was seen.
    """
    shown = samples.frames[neutral_rows(neutral, samples.times, samples.fps)]
    seen = ~np.isnan(shown)
    if not seen.any():
        raise ParameterError("neutral", "must contain a frame with a face", neutral)
    rest = np.nan_to_num(shown).sum(axis=0) / np.maximum(seen.sum(axis=0), 1)
    return replace(samples, frames=samples.frames - rest)
