"""Speech of any length, for tests of speech with and without Blender."""

from __future__ import annotations

import risorius.api as api
from risorius.speech.phonemes import phonemes


def lasting(seconds: float) -> api.Utterance:
    """Syllables without end, a pause after every eighth sound."""
    sounds, at = list[api.Sound](), 0.3
    while at < seconds - 0.5:
        symbol = ["m", "a", "p", "i", "f", "u", "t", "o"][len(sounds) % 8]
        sounds.append(api.Sound(at, at + 0.12, phonemes()[symbol], symbol))
        at += 0.12 if len(sounds) % 8 else 0.7
    return api.Utterance(tuple(sounds), seconds)
