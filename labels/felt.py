"""What a motion is meant to show in each frame: words and emotions, their strength, what is said."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..arrays import Floats
from ..mpeg4 import ARCHETYPES, Cue, FapStream, emotion_weights, expression, strengths
from ..mpeg4.high_level import EXPRESSIONS, FULL
from ..speech.saying import Saying
from .spoken import Spoken
from .tables import Column, Kind, Values

#: Where an emotion is known from: it was asked for, FAP 2 of a stream tells it, or nobody has said.
REQUEST, STREAM, NOT_ASKED = "request", "stream", "not asked"
NEUTRAL, ONSET, APEX, OFFSET = "neutral", "onset", "apex", "offset"

COLUMNS = (
    Column(
        "emotion_from",
        Kind.TEXT,
        f"{REQUEST}: words, a point of the wheel, or speech, with a feeling or without, were asked for; {STREAM}: "
        f"FAP 2 of the stream tells it; {NOT_ASKED}: a stream of FAPs that tells none; the columns from word to the "
        "six archetypes are then empty",
    ),
    Column(
        "word", Kind.TEXT, "emotion word that shows most, or the angle of a point of the wheel; empty: neutral face"
    ),
    Column("strength", Kind.NUMBER, "how much of it shows: 0 neutral, 1 as strong as the word is"),
    Column("phase", Kind.TEXT, f"of that expression: {NEUTRAL} (none shows), {ONSET}, {APEX} or {OFFSET}"),
    Column("other_word", Kind.TEXT, "second word, where two overlap"),
    Column("other_strength", Kind.NUMBER, "how much of that shows, 0 to 1"),
    Column("angle", Kind.NUMBER, "direction of the word on the emotion wheel; empty in a neutral face", "degree", 3),
    Column("activation", Kind.NUMBER, "activation of the word, 1 to 7, at strength 1; empty in a neutral face", "", 3),
    *(
        Column(str(emotion), Kind.NUMBER, f"strength of {emotion} as a share of what is meant, 0 to 1")
        for emotion in ARCHETYPES
    ),
    Column("viseme", Kind.INTEGER, "viseme of FAP 1 of the sound that is spoken, 1 to 14; 0: none, or nothing is said"),
    Column(
        "viseme_strength",
        Kind.NUMBER,
        "share of it in the mouth's shape, among all sounds around, times how distinctly it is said; empty where not "
        "known",
    ),
    Column("other_viseme", Kind.INTEGER, "viseme that the mouth shows beside it, coming or going; 0: none"),
    Column("other_viseme_strength", Kind.NUMBER, "the same of that"),
    Column("sound", Kind.TEXT, "sound that is spoken, in the International Phonetic Alphabet"),
    Column("spoken_word", Kind.TEXT, "word that is spoken"),
)


@dataclass(frozen=True, eq=False)
class Felt:
    """What is meant in T frames at a rate.

    Attributes
    ----------
    source : one of `REQUEST`, `STREAM`, `NOT_ASKED`.
    cues : expressions, and their strengths (T, C). ahead : seconds of their time at the first frame.
    shares : (T, 6) strength of each archetype; NaN where not known.
    spoken : what is said.
    """

    fps: float
    source: str
    shares: Floats
    spoken: Spoken
    cues: Sequence[Cue] = ()
    strengths: Floats = field(default_factory=lambda: np.zeros((0, 0)))
    ahead: float = 0.0

    @classmethod
    def of_cues(cls, cues: Sequence[Cue], fps: float) -> Felt:
        """What expressions in time mean."""
        strength = strengths(cues, fps=fps)
        shares = emotion_weights(cues, fps=fps)
        return cls(fps, REQUEST, shares, Spoken.nothing(len(strength)), cues, strength)

    @classmethod
    def of_faps(cls, count: int, fps: float) -> Felt:
        """What so many frames of FAPs mean that say nothing of it."""
        shares = np.full((count, len(ARCHETYPES)), np.nan)
        return cls(fps, NOT_ASKED, shares, Spoken.nothing(count))

    @classmethod
    def of_stream(cls, stream: FapStream, count: int, fps: float) -> Felt:
        """What FAP 1 and 2 of a stream say, shown in so many frames at a rate."""
        steps = np.minimum(np.floor(np.arange(count) / fps * stream.fps + 0.5), len(stream.frames) - 1).astype(np.int64)
        felt = replace(cls.of_faps(count, fps), spoken=Spoken.of_fields(stream.visemes, steps))
        if not stream.expressions:
            return felt
        # Each expression of the standard is a cue without a time of its own; the stream tells its strength.
        known = {code: each.archetype for code, each in EXPRESSIONS.items() if each.archetype is not None}
        cues = [Cue(expression(str(emotion)), onset=0.0, apex=count / fps, offset=0.0) for emotion in known.values()]
        place = {code: number for number, code in enumerate(known)}
        strength = np.zeros((count, len(cues)))
        for frame, step in enumerate(steps.tolist()):
            told = stream.expressions.get(step)
            for code, intensity in () if told is None else (told.values[:2], told.values[2:4]):
                if code in place:
                    strength[frame, place[code]] += intensity / FULL
        order = [list(known.values()).index(emotion) for emotion in ARCHETYPES]
        shares = strength[:, order] / np.maximum(strength.sum(axis=1, keepdims=True), 1.0)
        return replace(felt, source=STREAM, shares=shares, cues=cues, strengths=strength)

    @classmethod
    def of_saying(cls, saying: Saying) -> Felt:
        """What speech means and says."""
        fps = saying.stream.fps
        spoken = Spoken.of_saying(saying)
        return cls(fps, REQUEST, saying.emotions, spoken, saying.cues, saying.strengths, saying.begin)

    def at(self, step: int) -> Mapping[str, object]:
        """What a table says of one frame."""
        shown = self._shown(step)
        names = [_name(cue) for cue, _ in shown] + ["", ""]
        known = self.source != NOT_ASKED
        amounts = [strength for _, strength in shown] + [0.0 if known else np.nan] * 2
        cue = shown[0][0] if shown else None
        return {
            "emotion_from": self.source,
            "word": names[0],
            "strength": amounts[0],
            "phase": self._phase(cue, step) if known else "",
            "other_word": names[1],
            "other_strength": amounts[1],
            "angle": np.nan if cue is None else cue.profile.angle,
            "activation": np.nan if cue is None else cue.profile.activation,
            **{str(emotion): float(share) for emotion, share in zip(ARCHETYPES, self.shares[step], strict=True)},
            **self.spoken.at(step),
        }

    def _shown(self, step: int) -> list[tuple[Cue, float]]:
        """What shows in one frame and how much of it, the most first; a neutral face is nothing that shows."""
        found = [
            (cue, float(strength))
            for cue, strength in zip(self.cues, self.strengths[step] if self.cues else (), strict=True)
            if strength > 0.0 and cue.profile.ranges
        ]
        return sorted(found, key=lambda each: -each[1])

    def _phase(self, cue: Cue | None, step: int) -> str:
        """Where an expression stands in its time; a stream does not tell."""
        if cue is None:
            return NEUTRAL
        if self.source == STREAM:
            return ""
        since = step / self.fps + self.ahead - cue.start
        if since < cue.onset:
            return ONSET
        return APEX if since <= cue.onset + cue.apex else OFFSET


def _name(cue: Cue) -> str:
    """The word of an expression, or where it is on the wheel."""
    return cue.profile.word or f"{cue.profile.angle:g} degrees"


def columns_of(rows: Sequence[Mapping[str, object]], columns: Sequence[Column]) -> dict[str, Values]:
    """Rows as columns."""
    kinds = {Kind.INTEGER: np.int64, Kind.NUMBER: np.float64, Kind.FLAG: np.bool_}
    return {
        each.name: [str(row[each.name]) for row in rows]
        if each.kind is Kind.TEXT
        else np.array([row[each.name] for row in rows], dtype=kinds[each.kind])
        for each in columns
    }
