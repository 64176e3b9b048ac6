"""One moment of speech with feeling, told from what is near it: the rest of an hour need not be worked out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..arrays import Floats
from ..face.drive.over_time import goals_at
from ..mpeg4 import FAP_COUNT, Cue, step_count
from ..progress import run
from .articulation import articulate
from .feeling import mixed
from .utterance import Utterance

#: Seconds on either side from which a moment is told: no sound reaches farther.
AROUND = 2.0


def glimpse(
    utterance: Utterance,
    cues: Sequence[Cue],
    time: float,
    fps: float,
    *,
    articulation: float = 1.0,
    jaw: float = 1.0,
    lean: float = 1.0,
) -> Floats:
    """(68,) FAPs at a time in seconds, as `saying.say_steps` has them, but without blinks and small motions."""
    first = 0 if utterance.mouth is not None else max(round((time - AROUND) * fps), 0)
    near = _between(utterance, first / fps, time + AROUND)
    step = round(time * fps) - first
    spoken = articulate(near, fps, articulation=articulation, jaw=jaw)
    spoken = spoken[np.minimum(np.arange(step + 2), len(spoken) - 1)]  # after the last sound the mouth is at rest
    felt = np.full((len(spoken), FAP_COUNT), np.nan)
    if cues:  # when they are over, nothing is asked
        steps = np.arange(first, min(first + len(spoken), step_count(cues, fps)))
        felt[: len(steps)] = run(goals_at(cues, steps / fps))
    return np.asarray(mixed(spoken, felt, near, fps, lean=lean)[step])


def _between(utterance: Utterance, start: float, end: float) -> Utterance:
    """The sounds that last into a span of time, seconds, whose beginning is their time 0."""
    if utterance.mouth is not None:  # as it was recorded, it is there at once
        return utterance
    within = [sound for sound in utterance.sounds if sound.end > start and sound.start < end]
    sounds = tuple(replace(s, start=max(s.start - start, 0.0), end=s.end - start) for s in within)
    return Utterance(sounds, max(end - start, sounds[-1].end if sounds else 0.0))
