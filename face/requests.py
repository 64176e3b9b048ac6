"""The FAPs, drives and emotions that a caller gives, checked once: every refusal names the thing and the remedy."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Floats
from ..errors import ParameterError
from ..mpeg4 import ARCHETYPES, FAP_COUNT, FAP_LIMIT, Feeling
from .drive.request import ByHand, Contractions, Drive, EmotionShares, Request


def checked_request(
    frame: ArrayLike, drive: str | Drive, emotion: EmotionShares | None, contractions: Contractions | None
) -> Request:
    """The request that a caller makes; contractions are checked by the face that has the muscles."""
    by_hand = (ByHand(contractions),) if contractions else ()
    return Request(checked_faps(frame), checked_drive(drive), checked_emotion(emotion), by_hand)


def checked_faps(frame: ArrayLike) -> Floats:
    """(68,) float64, finite or NaN."""
    array = np.array(frame, dtype=np.float64)
    if array.shape != (FAP_COUNT,):
        raise ParameterError("frame", f"must have {FAP_COUNT} values, index = FAP number - 1", array.shape)
    wrong = np.flatnonzero(np.abs(array) > FAP_LIMIT)
    if len(wrong):
        raise ParameterError(f"FAP {wrong[0] + 1}", _fap_rule(array[wrong[0]]), float(array[wrong[0]]))
    return array


def _fap_rule(value: float) -> str:
    """The rule that a value breaks."""
    return "must be finite, or NaN where not stated" if np.isinf(value) else f"must be within ±{FAP_LIMIT:g}"


def checked_stream(frames: ArrayLike) -> Floats:
    """(T, 68) float64, at least one frame, each finite or NaN."""
    array = np.array(frames, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != FAP_COUNT or len(array) == 0:
        raise ParameterError("frames", f"must have the shape (T, {FAP_COUNT}) with one frame or more", array.shape)
    wrong = np.argwhere(np.abs(array) > FAP_LIMIT)
    if len(wrong):
        step, index = wrong[0]
        value = float(array[step, index])
        raise ParameterError(f"FAP {index + 1} of frame {step}", _fap_rule(value), value)
    return array


def checked_emotions(emotions: ArrayLike | None, count: int) -> Floats | None:
    """(T, 6) strengths of the archetypes over a clip's frames, or None."""
    if emotions is None:
        return None
    array = np.array(emotions, dtype=np.float64)
    if array.shape != (count, len(ARCHETYPES)):
        raise ParameterError("emotions", f"must have the shape ({count}, {len(ARCHETYPES)})", array.shape)
    wrong = array[~(np.isfinite(array) & (array >= 0.0))]
    if len(wrong):
        raise ParameterError("emotions", "must be finite strengths, none negative", float(wrong[0]))
    return array


def checked_drive(drive: str | Drive) -> Drive:
    """The drive of a name."""
    try:
        return Drive(drive)
    except ValueError:
        raise ParameterError("drive", f"must be one of {', '.join(Drive)}", drive) from None


def checked_emotion(emotion: EmotionShares | None) -> Feeling | None:
    """Archetype shares with known names."""
    if emotion is None:
        return None
    names = [str(name) for name in ARCHETYPES]
    for name in emotion:
        if str(name) not in names:
            raise ParameterError("emotion", f"must name archetypes ({', '.join(names)})", name)
    for name, share in emotion.items():
        if not (np.isfinite(share) and share >= 0.0):
            raise ParameterError(f"emotion {name}", "must be a share of 0 or more", share)
    felt = Feeling.of(emotion)
    return Feeling(
        felt, activation=felt.activation, strength=felt.strength, prototypes=felt.prototypes, shows=felt.shows
    )
