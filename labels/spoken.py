"""What is said in each frame: the sound, its viseme, how much of the mouth's shape is that viseme's, the word."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..mpeg4.high_level import FULL, VisemeField
from ..progress import run
from ..speech.articulation import viseme_shares
from ..speech.saying import Saying
from ..speech.utterance import Sound, SpokenWord

#: Times that lie closer together than this are one: seconds.
SAME = 1e-9


@dataclass(frozen=True, eq=False)
class Spoken:
    """What is said in T frames.

    Attributes
    ----------
    visemes : (T, 2) the viseme and the one beside it; 0: none. strengths : (T, 2) of each; NaN where not known.
    sounds, words : of each frame; "" where there is none.
    """

    visemes: Ints
    strengths: Floats
    sounds: Sequence[str]
    words: Sequence[str]

    @classmethod
    def nothing(cls, count: int) -> Spoken:
        """Nothing is said."""
        none = [""] * count
        return cls(np.zeros((count, 2), dtype=np.int64), np.zeros((count, 2)), none, none)

    @classmethod
    def of_fields(cls, fields: Mapping[int, VisemeField], steps: Ints) -> Spoken:
        """What FAP 1 of a stream says at some of its steps (T,)."""
        spoken = cls.nothing(len(steps))
        for frame, step in enumerate(steps.tolist()):
            if step in fields:
                first, second, blend, _ = fields[step].values
                share = blend / FULL
                both = sorted([(first, share), (second, 1.0 - share)], key=lambda each: each[0] == 0 or each[1] == 0.0)
                for place, (viseme, strength) in enumerate(both):
                    if viseme and strength:
                        spoken.visemes[frame, place], spoken.strengths[frame, place] = viseme, strength
        return spoken

    @classmethod
    def of_saying(cls, saying: Saying) -> Spoken:
        """What speech says."""
        utterance, count = saying.utterance, len(saying.stream.frames)
        times = np.arange(count) / saying.stream.fps
        spoken = cls.nothing(count)
        sounds, words = list(spoken.sounds), list(spoken.words)
        for frame, sound in enumerate(_when(utterance.sounds, times)):
            if sound >= 0:
                phoneme = utterance.sounds[sound].phoneme
                sounds[frame], spoken.visemes[frame, 0] = phoneme.symbol, phoneme.viseme
        for frame, word in enumerate(_when(utterance.words, times)):
            words[frame] = utterance.words[word].text if word >= 0 else ""
        if utterance.mouth is not None:  # it moves as it was recorded, and nobody knows by how much of which viseme
            return cls(spoken.visemes, np.where(spoken.visemes > 0, np.nan, 0.0), sounds, words)
        shares = saying.articulation * run(viseme_shares(utterance, times))
        every = np.arange(count)
        own = np.where(spoken.visemes[:, 0] > 0, shares[every, spoken.visemes[:, 0]], 0.0)
        shares[every, spoken.visemes[:, 0]] = shares[:, 0] = 0.0
        other = shares.argmax(axis=1)
        beside = shares[every, other]
        other[np.round(beside, 6) == 0.0] = 0
        return cls(
            np.stack([spoken.visemes[:, 0], other], axis=1),
            np.stack([own, np.where(other > 0, beside, 0.0)], axis=1),
            sounds,
            words,
        )

    def at(self, step: int) -> Mapping[str, object]:
        """What a table says of one frame."""
        return {
            "viseme": int(self.visemes[step, 0]),
            "viseme_strength": float(self.strengths[step, 0]),
            "other_viseme": int(self.visemes[step, 1]),
            "other_viseme_strength": float(self.strengths[step, 1]),
            "sound": self.sounds[step],
            "spoken_word": self.words[step],
        }


def _when(those: Sequence[Sound] | Sequence[SpokenWord], times: Floats) -> list[int]:
    """(T,) which of those, in order of time, is said at each time; -1 where none is."""
    if not those:
        return [-1] * len(times)
    starts, ends = np.array([(each.start, each.end) for each in those]).T
    found = np.searchsorted(starts, times + SAME, side="right") - 1
    said = (found >= 0) & (times + SAME < ends[found])
    which: list[int] = np.where(said, found, -1).tolist()
    return which
