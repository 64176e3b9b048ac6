"""What is said, with feeling, as a stream of FAPs for any face."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..face.drive.over_time import cue_plans
from ..face.drive.request import Drive
from ..mpeg4 import ARCHETYPES, FAP_COUNT, Cue, FapStream, Liveliness, Profile, emotion_weights, load_timings, strengths
from .articulation import articulate
from .feeling import mixed
from .phonemes import Alphabet
from .timings import read_timings
from .utterance import Utterance

#: The timing by which an emotion comes before speech and goes after it.
TIMING = "natural"


@dataclass(frozen=True, eq=False)
class Saying:
    """Speech as a face shows it.

    Attributes
    ----------
    utterance : what is said and when.
    stream : its FAPs, planned: play it with `planned=True` and `integrator="balance"` (`Face.simulation`).
    emotions : (T, 6) strength of each archetype in each frame.
    assumed : what was assumed, in words for people.
    """

    utterance: Utterance
    stream: FapStream
    emotions: Floats
    assumed: tuple[str, ...] = ()


def say(
    said: Utterance | str | Path,
    *,
    emotion: Profile | None = None,
    fps: float = 25.0,
    articulation: float = 1.0,
    jaw: float = 1.0,
    lean: float = 1.0,
    liveliness: Liveliness | None = None,
    seed: int | None = None,
    tier: str | None = None,
    alphabet: str | Alphabet | None = None,
) -> Saying:
    """Say something, with feeling: lips, jaw and tongue from speech, brows and eyes from the emotion.

    Parameters
    ----------
    said : an utterance, or a file of timings (`read_timings`, which takes tier and alphabet).
    emotion : what is felt all the while (`expression`); it goes when all is said.
    fps : frames per second.
    articulation : how distinctly lips and tongue move, 0 to 2. jaw : how far the jaw opens, 0 to 2.
    lean : how far the mouth leans to the emotion while speaking, 0 to 2.
    liveliness : blinks and small motions of head and eyes.
    seed : draws the way in which the emotion is shown.

    Raises
    ------
    FormatError : the file of timings cannot be read.
    ParameterError : a value outside its range.

    Examples
    --------
    >>> rows = ["start,end,phoneme", "0.1,0.2,m", "0.2,0.4,i"]
    >>> np.savetxt("line.csv", rows, fmt="%s")
    >>> saying = api.say("line.csv", emotion=api.expression("joy"))
    >>> lower_lip, upper_lip = (saying.stream.frames[4, n - 1] for n in (5, 4))  # at 0.16 s
    >>> bool(lower_lip + upper_lip > 0.0)  # closed
    True
    """
    utterance = said if isinstance(said, Utterance) else read_timings(said, tier=tier, alphabet=alphabet)
    spoken = articulate(utterance, fps, articulation=articulation, jaw=jaw)
    cues = [] if emotion is None else [_cue(emotion, utterance, seed)]
    count = max(len(spoken), math.ceil(cues[0].duration * fps - 1e-6) + 1 if cues else 0)
    spoken = _lasting(spoken, count)
    felt = _felt(cues, liveliness, count, fps)
    emotions = np.zeros((count, len(ARCHETYPES)))
    if cues:
        shown = emotion_weights(cues, fps=fps)
        emotions[: len(shown)] = shown[:count]
    frames = mixed(spoken, felt, utterance, fps, lean=lean)
    stream = FapStream(frames, fps=fps, name="speech", assumed=utterance.assumed)
    return Saying(utterance, stream, emotions, utterance.assumed)


def _cue(emotion: Profile, utterance: Utterance, seed: int | None) -> Cue:
    """An emotion that is there from the beginning, and goes when all is said."""
    timing = load_timings()[TIMING]
    return Cue(emotion, onset=0.0, apex=utterance.duration, offset=timing.offset, ramp=timing.ramp, seed=seed)


def _lasting(spoken: Floats, count: int) -> Floats:
    """Frames that last longer: the mouth stays at rest, as the last one has it."""
    return np.concatenate([spoken, np.repeat(spoken[-1:], count - len(spoken), axis=0)])


def _felt(cues: list[Cue], liveliness: Liveliness | None, count: int, fps: float) -> Floats:
    """(T, 68) what the natural drive plans for the emotion, and blinks and small motions; NaN where nothing."""
    felt = np.full((count, FAP_COUNT), np.nan)
    if cues:
        plans = [plan.goal for plan in cue_plans(cues, fps, Drive.NATURAL, None, None)]
        felt[: len(plans)] = plans[:count]
        felt[len(plans) :] = plans[-1]
    if liveliness is None:
        return felt
    overlay, shares = liveliness.over(count, fps), strengths(cues, fps=fps)[:, 0] if cues else np.zeros(0)
    for step in range(count):
        borne = [(cues[0], float(shares[step]))] if step < len(shares) else []
        felt[step] = overlay.upon(liveliness.borne(felt[step], borne), step)
    return felt
