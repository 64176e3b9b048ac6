"""Requests held within anatomical ranges: softly, and without what the jaw or a mouth drawn aside takes along."""

from __future__ import annotations

import numpy as np

from ....arrays import Floats
from ....mpeg4 import FAP_COUNT
from .synergies import JAW, JAW_FAP, Synergies

#: Left and right corner of the mouth, drawn outwards: inner lip, outer lip.
CORNERS = ((6, 7), (53, 54))


def saturate(value: Floats, low: Floats, high: Floats, low_linear: Floats, high_linear: Floats) -> Floats:
    """Values softly held within ranges: unchanged up to a share of the range, then approaching it exponentially."""
    limit = np.where(value < 0, -low, high)
    size = np.abs(value)
    knee = np.where(value < 0, low_linear, high_linear) * limit
    rest = limit - knee
    beyond = knee + rest * (1.0 - np.exp(-np.maximum(size - knee, 0.0) / rest))
    held: Floats = np.sign(value) * np.where(size <= knee, size, beyond)
    return held


def carried_by_jaw(data: Synergies, asked: Floats) -> Floats:
    """(m,) metres by which the asked opening of the jaw moves every FAP's point, itself left out; asked (m,) metres."""
    row = data.row_of[JAW_FAP]
    opening = float(saturate(asked, data.low, data.high, data.low_linear, data.high_linear)[row])
    jaw = data.units[:, data.unit_names.index(JAW)]
    carried: Floats = jaw * max(opening / float(jaw[row]), 0.0)
    carried[row] = 0.0
    return carried


def held(data: Synergies, asked: Floats, carried: Floats) -> Floats:
    """(m,) requests in metres (0 = none) softly held within the anatomical ranges.

    Ranges are of what each part does by itself: what the jaw carries along, and what both corners of a mouth that is
    drawn to one side have in common, is not held back.
    """
    free = _free(data, asked, carried)
    return free + saturate(asked - free, data.low, data.high, data.low_linear, data.high_linear)


def possible_shares(data: Synergies, faps: Floats) -> Floats:
    """(68,) share of each request that lies within its anatomical range, 0..1; 1 where a FAP is silent or has none."""
    asked = np.nan_to_num(faps[data.numbers - 1] * data.per_fap)
    own = asked - _free(data, asked, carried_by_jaw(data, asked))
    limit = np.where(own < 0.0, -data.low, data.high)
    shares = np.ones(FAP_COUNT)
    shares[data.numbers - 1] = limit / np.maximum(np.abs(own), limit)
    return shares


def _free(data: Synergies, asked: Floats, carried: Floats) -> Floats:
    """(m,) metres of requests that no range holds: what goes with the jaw, or with a mouth that is drawn aside."""
    free = np.where(asked * carried > 0.0, np.sign(asked) * np.minimum(np.abs(asked), np.abs(carried)), 0.0)
    for pair in CORNERS:
        left, right = (data.row_of[number] for number in pair)
        one, other = asked[left] - free[left], asked[right] - free[right]
        if one * other < 0.0:
            aside = np.sign(one) * min(abs(one), abs(other))
            free[left] += aside
            free[right] -= aside
    return free
