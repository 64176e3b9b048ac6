"""A sound that lasts longer or shorter at the same pitch: pieces of it laid over one another where they agree.

Source: Verhelst and Roelands 1993, An overlap-add technique based on waveform similarity (WSOLA).
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError

#: Seconds of a piece, of which half lies over the next; how far a better fit is looked for: a period of a low voice.
PIECE, SEARCHED = 0.04, 0.012


def stretched(samples: Floats, rate: float, amount: float) -> Floats:
    """A sound (n, c) that lasts `amount` times as long, its pitch kept.

    Raises
    ------
    ParameterError : an amount that is not positive.
    """
    if not amount > 0.0:
        raise ParameterError("amount", "must be above 0", amount)
    half = max(round(0.5 * PIECE * rate), 1)
    reach = round(SEARCHED * rate)
    count = round(len(samples) * amount)
    if len(samples) < 2 * (2 * half + reach) or amount == 1.0:
        return samples.copy()
    held = np.pad(samples, ((reach, 2 * half + 2 * reach), (0, 0)))
    mono = held.mean(axis=1)
    window = np.hanning(2 * half + 1)[:-1, None]
    made = np.zeros((count + 2 * half, samples.shape[1]))
    weight = np.zeros((len(made), 1))
    place = reach
    for out in range(0, count, half):
        made[out : out + 2 * half] += (window * held[place : place + 2 * half])[: len(made) - out]
        weight[out : out + 2 * half] += window[: len(made) - out]
        follows = mono[place + half : place + 3 * half]
        wanted = reach + min(round((out + half) / amount), len(samples))
        place = wanted + _best(mono[wanted - reach : wanted + reach + 2 * half], follows)
        place = min(max(place - reach, 0), len(held) - 2 * half)
    return np.asarray((made / np.maximum(weight, 1e-3))[:count])


def _best(where: Floats, follows: Floats) -> int:
    """Where in a stretch of sound a piece agrees most with what would have followed."""
    if len(where) < len(follows):
        return 0
    size = len(where) + len(follows)
    alike = np.fft.irfft(np.fft.rfft(where, size) * np.conj(np.fft.rfft(follows, size)), size)
    alike = alike[: len(where) - len(follows) + 1]
    energy = np.cumsum(np.concatenate([[0.0], where**2]))
    energy = energy[len(follows) :] - energy[: -len(follows)]
    return int(np.argmax(alike / np.sqrt(np.maximum(energy, 1e-12))))
