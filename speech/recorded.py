"""What is said when, by a file of timings, or by one that has the mouth's motion itself: Audio2Face, a tracker.

Of a mouth that was recorded, sounds are known as far as the rule of sharing needs them: when something is said, and
when the lips are closed.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np

from ..arrays import Bools, Floats
from ..errors import FormatError, ParameterError
from ..face.tracked.recording import read_recording
from ..mpeg4 import FapStream
from .articulation.talking import SPOKEN
from .phonemes import Alphabet, Phoneme
from .timings import read_marks
from .utterance import Mouth, Sound, Utterance

#: FAPs by which the lips are apart: the upper and the lower one towards each other. Own choice: a share of the widest
#: opening that counts as closed, and one that counts as open; FAP units that a mouth must open at least to speak.
LIPS, CLOSED, OPEN, LEAST = (4, 5), 0.12, 0.2, 40.0
#: Seconds of stillness that make a pause, and of the shortest closing that is one.
PAUSE, SHORTEST = 0.25, 0.03
#: What the sounds of a recorded mouth are called.
SHUT, SPEAKING = Phoneme("closed", 1), Phoneme("open", 10, vowel=True)
SAID = "the mouth is the recording's own; what else it shows is left to the emotion"


def read_timings(path: str | Path, *, tier: str | None = None, alphabet: str | Alphabet | None = None) -> Utterance:
    """What is said when, by the file of an aligner or of a lip-sync tool.

    Parameters
    ----------
    path : a TextGrid, Rhubarb's JSON, TSV or XML, the JSON of the Montreal Forced Aligner, Gentle or Amazon Polly, a
        label file, a table or JSON of sounds or visemes with their times, a stream with visemes (.fap, .fba), or a
        timeline saved as a preset (.toml). A sound (.wav) opens the mouth as loud as it is, and a recording of a face
        (Audio2Face's weights, any that `read_recording` reads) gives its mouth; both are said.
    tier : which tier of a TextGrid holds the sounds; found if not given.
    alphabet : how sounds are written: ipa, arpabet or xsampa; found if not given.

    Raises
    ------
    FormatError : it cannot be read, says nothing, or its times overlap or run backwards; says where, and the remedy.
    ParameterError : no such alphabet.

    Examples
    --------
    >>> rows = ["start,end,phoneme", "0.1,0.2,m", "0.2,0.4,i"]
    >>> np.savetxt("line.csv", rows, fmt="%s")
    >>> [(sound.symbol, sound.start, sound.phoneme.viseme) for sound in api.read_timings("line.csv").sounds]
    [('m', 0.1, 1), ('i', 0.2, 12)]
    """
    try:
        return read_marks(path, tier=tier, alphabet=alphabet)
    except FormatError as no_timings:
        if tier is not None or alphabet is not None:
            raise
        try:
            recording = read_recording(path)
        except (FormatError, ParameterError):
            raise no_timings from None
        frames, said = recording.played()
        stream = FapStream(frames, fps=recording.stream.fps)
        return utterance_of_mouth(stream, path, (*recording.assumed, *said))


def utterance_of_mouth(stream: FapStream, path: str | Path, assumed: tuple[str, ...] = ()) -> Utterance:
    """A recorded mouth as something said.

    Raises
    ------
    FormatError : the mouth does not move.
    """
    mouth = np.zeros_like(stream.frames)
    columns = [number - 1 for number in SPOKEN]
    mouth[:, columns] = np.nan_to_num(stream.frames[:, columns])
    apart = -mouth[:, [number - 1 for number in LIPS]].sum(axis=1)
    widest = float(np.percentile(apart, 98.0))
    if widest < LEAST:
        raise FormatError(path, "has no mouth that speaks: its lips do not part")
    sounds = _sounds(apart / widest, stream.fps)
    duration = max(len(mouth) / stream.fps, sounds[-1].end)
    return Utterance(sounds, duration, assumed=(*assumed, SAID), mouth=Mouth(mouth, stream.fps))


def _sounds(opening: Floats, fps: float) -> tuple[Sound, ...]:
    """When lips are open and closed while something is said; opening (T,) as a share of the widest."""
    speaking = _closed_gaps(opening > OPEN, round(PAUSE * fps))
    shut = speaking & ~_closed_gaps(opening > CLOSED, max(round(SHORTEST * fps) - 1, 0))
    sounds = []
    for first, last in _runs(speaking):
        edges = [first, *(first + 1 + np.flatnonzero(np.diff(shut[first:last]))).tolist(), last]
        for start, end in pairwise(edges):
            phoneme = SHUT if shut[start] else SPEAKING
            sounds.append(Sound(start / fps, end / fps, phoneme, phoneme.symbol))
    return tuple(sounds)


def _closed_gaps(mask: Bools, frames: int) -> Bools:
    """A mask without gaps of so many frames or fewer between what is true."""
    filled = mask.copy()
    for first, last in _runs(~mask):
        if first > 0 and last < len(mask) and last - first <= frames:
            filled[first:last] = True
    return filled


def _runs(mask: Bools) -> list[tuple[int, int]]:
    """First of each run of what is true, and the one after its last."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(np.int8)))
    return [(int(first), int(last)) for first, last in edges.reshape(-1, 2)]
