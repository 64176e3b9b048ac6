"""How fast this machine's memory is: the triad of the STREAM benchmark, a = b + s c, by NumPy on one core."""

from __future__ import annotations

import time

import numpy as np

#: Figures of each of the three arrays, 160 MB: far more than any cache holds.
LENGTH = 20_000_000


def bandwidth(times: int = 5) -> float:
    """Bytes per second that go through memory, the best of some runs.

    NumPy does it in two passes: a = s c, then a += b. Five arrays are read or written; what a cache line is first read
    for to be written does not count, as in STREAM.
    """
    a, b, c = np.zeros(LENGTH), np.ones(LENGTH), np.ones(LENGTH)
    best = np.inf
    for _ in range(times):
        begin = time.perf_counter()
        np.multiply(c, 3.0, out=a)
        np.add(a, b, out=a)
        best = min(best, time.perf_counter() - begin)
    return float(5 * a.nbytes / best)
