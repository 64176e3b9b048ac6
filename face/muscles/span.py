"""Muscles that span from the bone to the skin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from .row import MuscleRow

#: Strands of a muscle that springs from a line, and points along a strand.
STRANDS, ALONG = 4, 7


@dataclass(frozen=True, kw_only=True, eq=False)
class SpanRow(MuscleRow):
    """A muscle with an attachment and an insertion, (3,) or (2, 3) each."""

    attachment: Floats
    insertion: Floats

    def strands(self) -> tuple[Floats, Floats]:
        """From attachment to insertion: still at the bone, with the skin at the end."""
        start, end = (np.atleast_2d(line) for line in (self.attachment, self.insertion))
        across = np.linspace(0.0, 1.0, STRANDS if max(len(start), len(end)) > 1 else 1)
        first, last = (line[:1] + across[:, None] * (line[-1:] - line[:1]) for line in (start, end))
        along = np.linspace(0.0, 1.0, ALONG)
        return first[:, None] + along[None, :, None] * (last - first)[:, None], along
