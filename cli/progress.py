"""Progress on standard error, so that --json stays clean."""

from __future__ import annotations

import math
import sys
import time

from ..progress import Progress

#: Seconds between lines of a work whose end is not known.
PAUSE = 1.0

#: Seconds of work after which its progress is said, where it is often quick.
PATIENCE = 1.0


class ShowProgress:
    """A line for every so many percent; of quick work, none.

    Parameters
    ----------
    percent : from line to line.
    patience : seconds of work before the first line.
    """

    def __init__(self, *, percent: int = 1, patience: float = 0.0) -> None:
        self._percent, self._patience = percent, patience
        self._began = time.monotonic()
        self._said_at, self._said = -math.inf, -1

    def __call__(self, step: Progress) -> None:
        """Say how far it is."""
        now = time.monotonic()
        if now - self._began < self._patience:
            return
        if math.isnan(step.fraction):
            if now - self._said_at >= PAUSE:
                self._say(step.text, now)
            return
        percent = int(100.0 * step.fraction) // self._percent
        if percent != self._said:
            self._said = percent
            self._say(f"{int(100.0 * step.fraction):3d} %  {step.text}", now)

    def _say(self, line: str, now: float) -> None:
        """Print a line."""
        self._said_at = now
        print(line, file=sys.stderr, flush=True)


def when_slow() -> ShowProgress:
    """Progress of work that is often quick: a line for every tenth, once it has taken a while."""
    return ShowProgress(percent=10, patience=PATIENCE)
