"""What controls cannot show of a motion, FAP by FAP."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...mpeg4 import FAPS

#: A FAP falls short where the controls show less than this share of it, or the rest moves the other way.
SHARE = 0.5
#: FAPs that a motion asks for with less than this share of its largest are not worth naming.
SMALL = 0.15


@dataclass(frozen=True)
class Shortfall:
    """A FAP that controls show too little of: `asked` and `shown` in FAP units where most is asked."""

    number: int
    asked: float
    shown: float

    @property
    def line(self) -> str:
        """In words."""
        return f"FAP {self.number} {FAPS[self.number].name}: {self.shown:.0f} of {self.asked:.0f}"


def shortfalls(asked: Floats, shown: Floats, units: Floats) -> Sequence[Shortfall]:
    """The FAPs that fall short, the worst in metres first.

    Parameters
    ----------
    asked, shown : (T, 68) FAP units; NaN where the face has no such point.
    units : (68,) metres per FAP unit; NaN where it is no displacement.
    """
    known = ~np.isnan(units) & ~np.isnan(asked).any(axis=0)
    columns = np.flatnonzero(known)
    if len(columns) == 0 or len(asked) == 0:
        return []
    frames = np.argmax(np.abs(asked[:, columns]), axis=0)
    most, got = asked[frames, columns], shown[frames, columns]
    length = np.abs(most * units[columns])
    short = (got * np.sign(most) < SHARE * np.abs(most)) & (length >= SMALL * length.max(initial=0.0)) & (length > 0.0)
    order = np.argsort(-np.abs((most - got) * units[columns]))
    return [Shortfall(int(columns[i]) + 1, float(most[i]), float(got[i])) for i in order if short[i]]
