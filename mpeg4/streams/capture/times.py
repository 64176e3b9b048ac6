"""When the rows of a recording are, and what had to be assumed to say so."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....arrays import Floats


@dataclass(frozen=True, eq=False)
class Times:
    """Times of a recording's rows.

    Attributes
    ----------
    seconds : (T,) as the file tells them.
    assumed : what the file does not say and was assumed, in words for people.
    """

    seconds: Floats
    assumed: tuple[str, ...] = ()

    @classmethod
    def even(cls, count: int, rate: float | None, usual: float) -> Times:
        """Rows of a file without times: at the rate that the caller names, else at the usual one."""
        assumed = () if rate is not None else (f"the file contains no times: {usual:g} frames per second",)
        return cls(np.arange(count) / (rate or usual), assumed)

    def from_first(self) -> Times:
        """The same with the first row at 0."""
        return Times(self.seconds - self.seconds[0], self.assumed)
