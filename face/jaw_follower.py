"""How the mandible follows what is asked of it: a damped oscillator, exact over every step, that teeth stop."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..physics.oscillator import Oscillator
from ..physics.tissue import Tissue, as_tissue
from .mechanisms.jaw import JawMotion


class JawFollower:
    """Takes a mandible (2, 3), its angle and slides and their rates, through steps of one length, seconds."""

    def __init__(self, tissue: str | Tissue, length: float) -> None:
        figures = as_tissue(tissue)
        self.length = length
        self._step = Oscillator(figures.jaw_frequency, figures.jaw_damping_ratio).propagator(length)

    def swung(self, jaw: Floats, start: Floats, end: Floats) -> Floats:
        """The mandible (2, 3) one step on, while what it follows goes evenly from start (3,) to end (3,).

        Teeth stop it: it does not close further than it rests, or than is asked.
        """
        after: Floats = self._step @ np.stack([*jaw, start, (end - start) / self.length])
        least = min(0.0, float(end[0]))
        if after[0, 0] < least:
            after[:, 0] = least, max(float(after[1, 0]), 0.0)
        return after


def resting(jaw: Floats) -> Floats:
    """The mandible (2, 3) at rest at an angle and slides (3,)."""
    return np.stack([jaw, np.zeros(3)])


def jaw_motion(jaw: Floats) -> JawMotion:
    """A mandible's angle and slides (3,) by name."""
    return JawMotion(*jaw.tolist())
