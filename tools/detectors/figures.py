"""Which detector sees what: how blend shapes rise over rest, how FAPs that were read follow the true ones, verdicts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from risorius.arrays import Floats

from .stills import EMOTIONS, HEADS, REST, Action, Still, unit_faps

#: A score that rises by so much over that at rest says that something moves.
SEEN = 0.1

#: A score or a FAP that changes by less than this does not move; of fewer values there is no correlation.
LEAST_SCORE, LEAST_MOTION, FEW = 0.01, 30.0, 3

#: Shapes that tell where the eyes look, and the one that stands for none.
GAZE = ("eyeLook", "_neutral")


@dataclass(frozen=True)
class Rise:
    """How the score of one blend shape rises over rest.

    Attributes
    ----------
    by_strength : strength in per cent -> mean over heads, from the front.
    by_yaw : degrees -> the same at full strength. by_light : in each other light, from the front.
    turned_by : lights in which it is seen and is not in the first one, or the other way round, on the same heads.
    seen_from : the least strength at which it rises by `SEEN` on most heads; None where it never does.
    heads : on how many it rises by `SEEN` at full strength. first : on how many no other shape rises more.
    instead : the other shape that rises most, mean over heads, and by how much.
    """

    by_strength: Mapping[int, float]
    by_yaw: Mapping[int, float]
    by_light: Mapping[str, float]
    turned_by: tuple[str, ...]
    seen_from: int | None
    heads: int
    first: int
    instead: tuple[str, float]


Scores = Mapping[Still, Mapping[str, float]]
"""Still -> shape of both sides -> score; stills without a face are left out."""


def both_sides(shapes: Mapping[str, float]) -> dict[str, float]:
    """Blend shapes with left and right as one, their mean; without those of gaze."""
    found: dict[str, list[float]] = {}
    for name, score in shapes.items():
        if not name.startswith(GAZE):
            found.setdefault(name.removesuffix("Left").removesuffix("Right"), []).append(score)
    return {name: float(np.mean(scores)) for name, scores in found.items()}


def risen(scores: Scores, still: Still) -> dict[str, float]:
    """Shape -> its score over that of the head at rest, seen in the same way; empty where no face was found."""
    if still not in scores or still.at_rest not in scores:
        return {}
    rest = scores[still.at_rest]
    return {name: score - rest[name] for name, score in scores[still].items()}


def rise_of(
    scores: Scores,
    action: Action,
    *,
    strengths: Sequence[int],
    yaws: Sequence[int],
    lights: Sequence[str],
    heads: Sequence[str] = HEADS,
) -> Rise:
    """How the blend shape of an action rises."""

    def mean(stills: Iterable[Still]) -> float:
        found = [rises[action.shape] for each in stills if (rises := risen(scores, each))]
        return float(np.mean(found)) if found else float("nan")

    def is_turned(light: str) -> bool:
        lit = [Still(head, action.unit, light=light) for head in heads]
        same = [Still(each.head, action.unit) for each in lit if risen(scores, each)]
        return bool(same) and (mean(lit) >= SEEN) != (mean(same) >= SEEN)

    at = {s: [Still(head, action.unit, s) for head in heads] for s in strengths}
    full = [rises for still in at[strengths[-1]] if (rises := risen(scores, still))]
    counts = {s: sum(risen(scores, still).get(action.shape, 0.0) >= SEEN for still in at[s]) for s in strengths}
    enough = [s for s in strengths if counts[s] > len(heads) / 2]
    others = {name: float(np.mean([rises[name] for rises in full])) for name in (full[0] if full else ())}
    others.pop(action.shape, None)
    instead = max(others, key=others.__getitem__, default="")
    return Rise(
        {s: mean(at[s]) for s in strengths},
        {yaw: mean(Still(head, action.unit, yaw=yaw) for head in heads) for yaw in yaws},
        {light: mean(Still(head, action.unit, light=light) for head in heads) for light in lights},
        tuple(light for light in lights if is_turned(light)),
        enough[0] if enough else None,
        counts[strengths[-1]],
        sum(max(rises, key=rises.__getitem__) == action.shape for rises in full),
        (instead, others.get(instead, float("nan"))),
    )


@dataclass(frozen=True)
class Follows:
    """How a FAP that was read follows the true one: correlation, slope (read over true), and over how many pictures."""

    correlation: float
    slope: float
    count: int


def follows(read: Floats, true: Floats) -> Follows:
    """Of values (n,) that were read and are true, FAP units; NaN where one of them is unknown."""
    known = ~np.isnan(read) & ~np.isnan(true)
    a, b = read[known], true[known]
    if len(a) < FEW or np.ptp(b) == 0.0 or np.ptp(a) == 0.0:
        return Follows(float("nan"), float("nan"), len(a))
    return Follows(float(np.corrcoef(a, b)[0, 1]), float(a @ b / (b @ b)), len(a))


def faps_follow(
    read: Mapping[Still, Floats], true: Mapping[Still, Floats], faps: Sequence[int], stills: Iterable[Still]
) -> Follows:
    """Some FAPs over some stills, all that were read together."""
    columns = [number - 1 for number in faps]
    rows = [still for still in stills if still in read]
    if not rows:
        return Follows(float("nan"), float("nan"), 0)
    return follows(
        np.concatenate([read[still][columns] for still in rows]),
        np.concatenate([true[still][columns] for still in rows]),
    )


def film_follows(shapes: Sequence[Mapping[str, float]], truth: Floats, action: Action) -> float:
    """The correlation over a film of an action's blend shape with its FAPs; NaN where one of them hardly moves.

    `shapes` (T) scores, empty where no face was found; `truth` (T, 68) FAPs; what goes the action's way counts.
    """
    found = [index for index, each in enumerate(shapes) if each]
    if len(found) < FEW:
        return float("nan")
    columns = [number - 1 for number in action.faps]
    way = np.sign(unit_faps(action.unit, 1.0)[columns])
    said = np.array([both_sides(shapes[index])[action.shape] for index in found])
    shown = np.maximum((truth[found][:, columns] * way).mean(axis=1), 0.0)
    if np.ptp(said) < LEAST_SCORE or np.ptp(shown) < LEAST_MOTION:
        return float("nan")
    return float(np.corrcoef(said, shown)[0, 1])


def dead(scores: Scores) -> list[str]:
    """Blend shapes that leave 0 in no picture, whatever is shown."""
    names = next(iter(scores.values()), {})
    return [name for name in names if max(each[name] for each in scores.values()) < LEAST_SCORE]


def named(probabilities: Mapping[str, float] | None) -> str:
    """What a judge of emotions says: the likeliest of the six and neutral; "no face" where it found none."""
    if probabilities is None:
        return "no face"
    known = {name: probabilities.get(name, 0.0) for name in (*EMOTIONS, "neutral")}
    return max(known, key=known.__getitem__)


def right(verdicts: Mapping[Still, str], stills: Iterable[Still]) -> tuple[int, int]:
    """How many stills are named rightly (rest is neutral), of how many that were asked about."""
    asked = [still for still in stills if still in verdicts]
    return sum(verdicts[s] == ("neutral" if s.shows == REST else s.shows) for s in asked), len(asked)
