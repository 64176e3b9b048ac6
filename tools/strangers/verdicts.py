"""What was named: the judges' mean, who is taken for whom, and whether an emotion grows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias

from .judges import Said
from .sittings import EMOTIONS, Sitting

#: Sitting -> what is said of it.
Judged: TypeAlias = Mapping[Sitting, Said]

#: Where no judge found a face.
NO_FACE = "no face"

#: A fall of the probability that is none.
LEAST_FALL = 0.02


def mean_said(said: Iterable[Said]) -> Said:
    """The mean of the judges that found a face; None where none did."""
    heard = [each for each in said if each is not None]
    return {name: sum(each[name] for each in heard) / len(heard) for name in heard[0]} if heard else None


def named(said: Said) -> str:
    """The likeliest of the six; neutral does not count, for it is known that something is shown."""
    return NO_FACE if said is None else max(EMOTIONS, key=lambda emotion: said[emotion])


def likeliest(said: Said, count: int = 3) -> list[tuple[str, float]]:
    """The likeliest classes, neutral among them."""
    return sorted(said.items(), key=lambda each: -each[1])[:count] if said else []


def probability(said: Said, emotion: str) -> float:
    """Of an emotion; 0 where no face was found."""
    return 0.0 if said is None else said[emotion]


def chosen(judged: Judged, how: str, turned: int = 0) -> dict[Sitting, Said]:
    """The six emotions made in one way, seen from one side."""
    return {
        sitting: said
        for sitting, said in judged.items()
        if (sitting.how, sitting.turned) == (how, turned) and sitting.word in EMOTIONS
    }


@dataclass(frozen=True)
class Tally:
    """One emotion over some heads: how many were named, the mean probability, what others were taken for."""

    named: int
    of: int
    mean: float
    taken_for: tuple[str, ...]


def tallies(judged: Judged) -> dict[str, Tally]:
    """Emotion -> its tally, over all sittings given."""
    found = {}
    for emotion in EMOTIONS:
        mine = [said for sitting, said in judged.items() if sitting.word == emotion]
        if mine:
            wrong = Counter(named(said) for said in mine if named(said) != emotion)
            mean = sum(probability(said, emotion) for said in mine) / len(mine)
            found[emotion] = Tally(
                len(mine) - wrong.total(), len(mine), mean, tuple(name for name, _ in wrong.most_common())
            )
    return found


def share_named(judged: Judged) -> float:
    """Share of the sittings whose emotion is named."""
    return sum(named(said) == sitting.word for sitting, said in judged.items()) / max(len(judged), 1)


def confusion(judged: Judged) -> dict[str, Counter[str]]:
    """Emotion asked -> what it was named, counted."""
    counts: dict[str, Counter[str]] = {emotion: Counter() for emotion in EMOTIONS}
    for sitting, said in judged.items():
        counts[sitting.word][named(said)] += 1
    return counts


def growth(judged: Judged, head: str, emotion: str) -> dict[int, float]:
    """Activation 1..7 -> probability of the emotion, from the front, as far as it was asked."""
    asked = {how: judged.get(Sitting(head, emotion, str(how))) for how in range(1, 8)}
    seen = {how for how in asked if Sitting(head, emotion, str(how)) in judged}
    return {how: probability(said, emotion) for how, said in asked.items() if how in seen}


def mean_growth(judged: Judged, heads: Iterable[str], emotion: str) -> dict[int, float]:
    """The same, the mean over those heads of which it was asked."""
    told = [line for line in (growth(judged, head, emotion) for head in heads) if line]
    common = [how for how in range(1, 8) if told and all(how in line for line in told)]
    return {how: sum(line[how] for line in told) / len(told) for how in common}


def grows(values: Sequence[float]) -> bool:
    """Whether values rise from the first to the last, and never fall by more than `LEAST_FALL`."""
    return values[-1] > values[0] and all(after >= before - LEAST_FALL for before, after in pairwise(values))


def of_judge(heard: Mapping[str, Said], files: Mapping[Sitting, str]) -> Judged:
    """What one judge, or the mean, says of each sitting, by the names of the files."""
    return {sitting: heard[name] for sitting, name in files.items()}
