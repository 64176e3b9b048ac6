"""What is said, with feeling, as a stream of FAPs for any face."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError
from ..face.drive.over_time import cue_goals
from ..mpeg4 import (
    ARCHETYPES,
    FAP_COUNT,
    Cue,
    FapStream,
    Liveliness,
    Profile,
    emotion_weights,
    load_timings,
    step_count,
    strengths,
)
from ..progress import Progress, Report, Work, part_of, run
from .accompaniment import accompanying, by_rule
from .articulation import articulate_steps, spoken_frames
from .feeling import mixed_steps
from .phonemes import Alphabet
from .recorded import read_timings
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
    cues : the expressions that are felt, and their strengths (T, C). begin : seconds of their time at the first frame.
    articulation : how distinctly lips and tongue move, 0 to 2.
    """

    utterance: Utterance
    stream: FapStream
    emotions: Floats
    assumed: tuple[str, ...] = ()
    cues: tuple[Cue, ...] = ()
    strengths: Floats = field(default_factory=lambda: np.zeros((0, 0)))
    begin: float = 0.0
    articulation: float = 1.0


def say(
    said: Utterance | str | Path,
    *,
    emotion: Profile | None = None,
    cues: Sequence[Cue] = (),
    begin: float = 0.0,
    fps: float = 25.0,
    articulation: float = 1.0,
    jaw: float = 1.0,
    lean: float = 1.0,
    liveliness: Liveliness | None = None,
    seed: int | None = None,
    tier: str | None = None,
    alphabet: str | Alphabet | None = None,
    progress: Report | None = None,
) -> Saying:
    """Say something, with feeling: lips, jaw and tongue from speech, brows and eyes from the emotion.

    Parameters
    ----------
    said : an utterance, or a file of timings (`read_timings`, which takes tier and alphabet).
    emotion : what is felt all the while (`expression`); it goes when all is said.
    cues : instead, expressions that come and go; `begin` : seconds of their time at which the speech begins.
    fps : frames per second.
    articulation : how distinctly lips and tongue move, 0 to 2. jaw : how far the jaw opens, 0 to 2.
    lean : how far the mouth leans to the emotion while speaking, 0 to 2.
    liveliness : blinks, at pauses where there are some, small motions of head and eyes, and beats of brows and head on
        stressed words, as large as the head's motions.
    seed : draws the way in which the emotion is shown.
    progress : called with each step; an hour of speech takes seconds.

    Raises
    ------
    FormatError : the file of timings cannot be read.
    ParameterError : a value outside its range, or both an emotion and cues.

    Examples
    --------
    >>> rows = ["start,end,phoneme", "0.1,0.2,m", "0.2,0.4,i"]
    >>> np.savetxt("line.csv", rows, fmt="%s")
    >>> saying = api.say("line.csv", emotion=api.expression("joy"))
    >>> lower_lip, upper_lip = (saying.stream.frames[4, n - 1] for n in (5, 4))  # at 0.16 s
    >>> bool(lower_lip + upper_lip > 0.0)  # closed
    True
    """
    work = say_steps(
        said if isinstance(said, Utterance) else read_timings(said, tier=tier, alphabet=alphabet),
        emotion=emotion,
        cues=cues,
        begin=begin,
        fps=fps,
        articulation=articulation,
        jaw=jaw,
        lean=lean,
        liveliness=liveliness,
        seed=seed,
    )
    return run(work, progress)


def say_steps(
    utterance: Utterance,
    *,
    emotion: Profile | None = None,
    cues: Sequence[Cue] = (),
    begin: float = 0.0,
    fps: float = 25.0,
    articulation: float = 1.0,
    jaw: float = 1.0,
    lean: float = 1.0,
    liveliness: Liveliness | None = None,
    seed: int | None = None,
) -> Work[Saying]:
    """`say` an utterance, bit by bit, for who shows progress or cancels.

    Raises
    ------
    ParameterError : as `say`.

    Examples
    --------
    >>> rows = ["start,end,phoneme", "0.1,0.2,m", "0.2,0.4,i"]
    >>> np.savetxt("line.csv", rows, fmt="%s")
    >>> next(api.say_steps(api.read_timings("line.csv"))).text
    '0 of 2 sounds read'
    """
    if emotion is not None and cues:
        raise ParameterError("cues", "must be left out where an emotion is given", len(cues))
    felt_cues = tuple(cues) if emotion is None else (_throughout(emotion, utterance, seed),)
    ahead, count = round(begin * fps), frames_of(utterance, felt_cues, begin=begin, fps=fps)
    speaking = articulate_steps(utterance, fps, articulation=articulation, jaw=jaw, least=count)
    spoken = yield from part_of(speaking, 0.0, 0.6)
    yield Progress(0.6, "Laying out the feeling")
    shown = emotion_weights(felt_cues, fps=fps) if felt_cues else np.zeros((0, len(ARCHETYPES)))
    emotions = _shifted(shown, ahead, count, 0.0)
    felt = _shifted((yield from part_of(_planned(felt_cues, fps), 0.6, 0.7)), ahead, count, np.nan)
    strong = _shifted(strengths(felt_cues, fps=fps) if felt_cues else np.zeros((0, 0)), ahead, count, 0.0)
    if liveliness is not None:
        yield Progress(0.7, "Laying out blinks and beats")
        felt = liveliness.borne_all(felt, felt_cues, strong)
        laid = accompanying(utterance, liveliness, count, fps)
        yield Progress(0.8, "Laying out blinks and beats")
        felt = laid.upon_all(felt)
    frames = yield from part_of(mixed_steps(spoken, felt, utterance, fps, lean=lean), 0.8, 1.0)
    assumed = (*utterance.assumed, *by_rule(utterance, liveliness))
    return Saying(
        utterance,
        FapStream(frames, fps=fps, name="speech", assumed=assumed),
        emotions,
        assumed,
        felt_cues,
        strong,
        ahead / fps,
        articulation,
    )


def frames_of(utterance: Utterance, cues: Sequence[Cue] = (), *, begin: float = 0.0, fps: float = 25.0) -> int:
    """How many frames speech with cues lasts (`say_steps`), without working it out."""
    felt = step_count(cues, fps) - round(begin * fps) if cues else 0
    return max(spoken_frames(utterance, fps), felt)


def _throughout(emotion: Profile, utterance: Utterance, seed: int | None) -> Cue:
    """An emotion that is there from the beginning, and goes when all is said."""
    timing = load_timings()[TIMING]
    return Cue(emotion, onset=0.0, apex=utterance.duration, offset=timing.offset, ramp=timing.ramp, seed=seed)


def _planned(cues: Sequence[Cue], fps: float) -> Work[Floats]:
    """(T, 68) what the natural drive plans for cues; NaN where nothing."""
    return (yield from cue_goals(cues, fps)) if cues else np.zeros((0, FAP_COUNT))


def _shifted(rows: Floats, ahead: int, count: int, otherwise: float) -> Floats:
    """(count, m) rows from one of them on, which may be before the first; what is not there is otherwise."""
    result = np.full((count, rows.shape[1]), otherwise)
    first, last = max(-ahead, 0), min(len(rows) - ahead, count)
    if last > first:
        result[first:last] = rows[first + ahead : last + ahead]
    return result
