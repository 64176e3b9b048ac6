"""What a decoder does about FAPs that a stream does not state: copy the other side or the other lip contour, or hold.

Source: the rules of ISO/IEC 14496-2 by way of public decoders (left and right: Visage; inner and outer lips: Xface). A
FAP that no rule reaches stays unknown, which is not zero: anatomy decides.
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ..standard import FAP_COUNT, LIP_TWINS, PAIRS


class Filling(StrEnum):
    """How unknown FAPs are filled.

    copy : from the same place on the other lip contour (inner, outer), then from the other side of the face.
    hold : the last value stated before; nothing before the first.
    standard : copy, then hold.
    """

    COPY = "copy"
    HOLD = "hold"
    STANDARD = "standard"


def checked_filling(rule: str | Filling) -> Filling:
    """The rule of that name.

    Raises
    ------
    ParameterError : no rule has it.
    """
    if rule not in list(Filling):
        raise ParameterError("rule", f"must be one of {', '.join(Filling)}", rule)
    return Filling(rule)


def fill(frames: Floats, rule: str | Filling = Filling.STANDARD) -> Floats:
    """Frames with unknown FAPs filled by a rule.

    The lip contour comes before the other side, so that a mouth that is stated crooked on one contour is crooked on
    both. Equal values are a symmetric face (and, for the eyeballs' yaw, a parallel gaze), so sides are copied as they
    are.

    Parameters
    ----------
    frames : (T, 68) float64, FAP units, NaN where not stated.
    rule : see `Filling`.

    Returns
    -------
    (T, 68) float64; stated values are untouched, NaN where no rule gives a value.

    Raises
    ------
    ParameterError : frames of another shape, an unknown rule.
    """
    rule = checked_filling(rule)
    filled = np.array(frames, dtype=np.float64)
    if filled.ndim != 2 or filled.shape[1] != FAP_COUNT:
        raise ParameterError("frames", f"must have the shape (T, {FAP_COUNT})", filled.shape)
    if rule is not Filling.HOLD:
        for pairs in (LIP_TWINS, PAIRS):
            for one, other in pairs:
                _exchange(filled, one - 1, other - 1)
    return filled if rule is Filling.COPY else _held(filled)


def _exchange(frames: Floats, one: int, other: int) -> None:
    """Give each of two columns what only the other one states."""
    for to, source in ((one, other), (other, one)):
        silent = np.isnan(frames[:, to])
        frames[silent, to] = frames[silent, source]


def _held(frames: Floats) -> Floats:
    """Every NaN replaced by the last value above it in its column."""
    if not len(frames):
        return frames
    rows = np.where(np.isnan(frames), 0, np.arange(len(frames))[:, None])
    return np.asarray(np.take_along_axis(frames, np.maximum.accumulate(rows, axis=0), axis=0), dtype=np.float64)
