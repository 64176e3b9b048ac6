"""FAPs that turn or push a body as a whole (23-30, 43-50): how their values are read from FAPs (68,)."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats


def value_of(faps: Floats, number: int) -> float:
    """One of FAPs (68,), 0 where silent."""
    value = float(faps[number - 1])
    return 0.0 if np.isnan(value) else value
