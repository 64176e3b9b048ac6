"""What a motion is meant to show in each frame: words and emotions, their strength, what is said."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Floats, Ints
from ..mpeg4 import ARCHETYPES, Cue, emotion_weights, strengths
from ..speech.saying import Saying
from .tables import Column, Kind, Values

COLUMNS = (
    Column("word", Kind.TEXT, "emotion word that shows most; empty where none shows"),
    Column("strength", Kind.NUMBER, "how much of it shows, from 0 to 1 at its apex"),
    Column("other_word", Kind.TEXT, "second word, where two overlap"),
    Column("other_strength", Kind.NUMBER, "how much of that shows, 0 to 1"),
    Column("angle", Kind.NUMBER, "direction of the word on the emotion wheel", "degree", 3),
    Column("activation", Kind.NUMBER, "activation of the word, 1 to 7, at strength 1", "", 3),
    *(
        Column(str(emotion), Kind.NUMBER, f"strength of {emotion} as a share of what is meant, 0 to 1")
        for emotion in ARCHETYPES
    ),
    Column("viseme", Kind.INTEGER, "viseme of FAP 1 of the sound that is spoken, 1 to 14; 0: none, or nothing is said"),
    Column("sound", Kind.TEXT, "sound that is spoken, in the International Phonetic Alphabet"),
    Column("spoken_word", Kind.TEXT, "word that is spoken"),
)


@dataclass(frozen=True, eq=False)
class Felt:
    """What is meant in T frames.

    Attributes
    ----------
    cues : expressions and their strengths (T, C). shares : (T, 6) strength of each archetype; NaN where not known.
    visemes : (T,). sounds, words : what is spoken in each frame.
    """

    cues: Sequence[Cue]
    strengths: Floats
    shares: Floats
    visemes: Ints
    sounds: Sequence[str]
    words: Sequence[str]

    @classmethod
    def of_cues(cls, cues: Sequence[Cue], fps: float) -> Felt:
        """What expressions in time mean."""
        strength = strengths(cues, fps=fps)
        count = len(strength)
        none = [""] * count
        return cls(cues, strength, emotion_weights(cues, fps=fps), np.zeros(count, dtype=np.int64), none, none)

    @classmethod
    def of_stream(cls, count: int, emotions: Floats | None = None) -> Felt:
        """What a stream of so many frames means, as far as its emotions (T, 6) are known."""
        shares = np.full((count, len(ARCHETYPES)), np.nan) if emotions is None else emotions
        none = [""] * count
        return cls((), np.zeros((count, 0)), shares, np.zeros(count, dtype=np.int64), none, none)

    @classmethod
    def of_saying(cls, saying: Saying) -> Felt:
        """What speech means and says."""
        fps, count = saying.stream.fps, len(saying.stream.frames)
        sounds, words, visemes = [""] * count, [""] * count, np.zeros(count, dtype=np.int64)
        for frame in range(count):
            when = frame / fps
            sound = next((each for each in saying.utterance.sounds if each.start <= when < each.end), None)
            word = next((each for each in saying.utterance.words if each.start <= when < each.end), None)
            if sound is not None:
                sounds[frame], visemes[frame] = sound.phoneme.symbol, sound.phoneme.viseme
            if word is not None:
                words[frame] = word.text
        return replace(cls.of_stream(count, saying.emotions), visemes=visemes, sounds=sounds, words=words)

    def at(self, step: int) -> Mapping[str, object]:
        """What a table says of one frame."""
        order = sorted(range(len(self.cues)), key=lambda cue: -float(self.strengths[step, cue]))
        shown = [(self.cues[cue].profile, float(self.strengths[step, cue])) for cue in order]
        shown = [(profile, strength) for profile, strength in shown if strength > 0.0]
        names = [profile.word or f"{profile.angle:g} degrees" for profile, _ in shown] + ["", ""]
        amounts = [strength for _, strength in shown] + [0.0, 0.0]
        known = bool(self.cues)
        return {
            "word": names[0],
            "strength": amounts[0] if known else np.nan,
            "other_word": names[1],
            "other_strength": amounts[1] if known else np.nan,
            "angle": shown[0][0].angle if shown else np.nan,
            "activation": shown[0][0].activation if shown else np.nan,
            **{str(emotion): float(share) for emotion, share in zip(ARCHETYPES, self.shares[step], strict=True)},
            "viseme": int(self.visemes[step]),
            "sound": self.sounds[step],
            "spoken_word": self.words[step],
        }


def columns_of(rows: Sequence[Mapping[str, object]], columns: Sequence[Column]) -> dict[str, Values]:
    """Rows as columns."""
    kinds = {Kind.INTEGER: np.int64, Kind.NUMBER: np.float64, Kind.FLAG: np.bool_}
    return {
        each.name: [str(row[each.name]) for row in rows]
        if each.kind is Kind.TEXT
        else np.array([row[each.name] for row in rows], dtype=kinds[each.kind])
        for each in columns
    }
