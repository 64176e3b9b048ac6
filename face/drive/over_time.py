"""Plans over time: of a stream of FAPs, and of expressions that come and go."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ...mpeg4 import (
    ARCHETYPES,
    FAP_COUNT,
    Cue,
    Drawn,
    Feeling,
    Liveliness,
    Overlay,
    sequence,
    step_count,
    strengths,
    way_drawn,
)
from ...progress import Progress, Work
from .drives import DRIVES
from .natural.planning import LID_FAPS
from .plan import Plan, blended
from .request import ByHand, Contractions, Drive, Request


def stream_plans(stream: Floats, drive: Drive, weights: Floats | None, *, planned: bool = False) -> Iterator[Plan]:
    """Plans of a stream of FAPs (T, 68), each planned by itself; weights (T, 6) name the emotions where known.

    A stream that is planned already shows all that its emotions show; nothing of them is added, or seen in it.
    """
    for step, faps in enumerate(stream):
        emotion = Feeling({}) if planned else None
        if not planned and weights is not None and (total := float(weights[step].sum())) > 0.0:
            shares = {a: float(w) / total for a, w in zip(ARCHETYPES, weights[step], strict=True)}
            emotion = Feeling(shares, strength=min(total, 1.0))
        yield DRIVES[drive].plan(Request(faps, drive, emotion))


def cue_plans(
    cues: Sequence[Cue],
    fps: float,
    drive: Drive,
    contractions: Sequence[Contractions] | None = None,
    liveliness: Liveliness | None = None,
) -> Iterator[Plan]:
    """Plans of cues, one for each step of 1/fps seconds.

    In the natural drive each cue is planned once at its apex, and the plans are blended by the cues' strengths. So
    what a face adds by itself to one expression is not contradicted by FAPs that another cue asks for. A cue with a
    seed draws the way in which its emotion is shown, where none was chosen. Contractions set by hand, one set per cue,
    come and go with it. Blinks and small motions of head and eyes are laid over all that.

    Raises
    ------
    ParameterError : not one set of contractions for each cue.
    """
    hands: Sequence[Contractions] = [{} for _ in cues] if contractions is None else contractions
    if len(hands) != len(cues):
        raise ParameterError("contractions", f"must be one set for each of the {len(cues)} cues", len(hands))
    stream = sequence(cues, fps=fps)
    lively = liveliness or Liveliness()
    overlay = lively.over(len(stream), fps)
    plans = apex_plans(cues, drive) if drive is Drive.NATURAL else []
    for step, (faps, weights) in enumerate(zip(stream, strengths(cues, fps=fps), strict=True)):
        shares = (weights / max(1.0, weights.sum())).tolist()
        by_hand = tuple(ByHand(hand, share) for hand, share in zip(hands, shares, strict=True) if hand and share > 0.0)
        borne = lively.borne(faps, zip(cues, shares, strict=True)) if drive is Drive.NATURAL else faps
        request = Request(overlay.upon(borne, step), drive, by_hand=by_hand)
        if drive is Drive.NATURAL:
            yield _laid_over(blended(request, plans, weights.tolist()), overlay, step)
        else:
            yield DRIVES[drive].plan(request)


def apex_plans(cues: Iterable[Cue], drive: Drive) -> list[Plan]:
    """Each cue's plan at the apex of its profile, drawn by the cue's seed."""
    return [DRIVES[drive].plan(Request(cue.profile.frame(cue.seed), drive, _felt(cue))) for cue in cues]


def cue_goals(cues: Sequence[Cue], fps: float) -> Work[Floats]:
    """(T, 68) the goals of `cue_plans` in the natural drive: where only these are asked, an hour takes a moment."""
    return (yield from goals_at(cues, np.arange(step_count(cues, fps)) / fps))


def goals_at(cues: Sequence[Cue], times: Floats) -> Work[Floats]:
    """The same at any times (T,), seconds.

    Returns
    -------
    (T, 68) float64, FAP units; NaN where nothing is known of the FAP at the time.
    """
    goals, found = np.empty((len(cues), FAP_COUNT)), dict[str, Floats]()
    for number, cue in enumerate(cues):
        alike = repr((cue.profile, cue.seed))
        if alike not in found:
            yield Progress.counted(number, len(cues), "expressions planned")
            found[alike] = apex_plans([cue], Drive.NATURAL)[0].goal
        goals[number] = found[alike]
    weights = np.array([cue.strength(times) for cue in cues]).T
    known, shown = np.asarray(~np.isnan(goals)), weights > 0.0
    mixed = weights / np.maximum(weights.sum(axis=1, keepdims=True), 1.0) @ np.where(known, goals, 0.0)
    # As a face at rest is planned where nothing shows; as `blended` has it.
    asked = np.where(shown.any(axis=1, keepdims=True), shown.astype(np.float64) @ known > 0.0, known[0])
    return np.where(asked, mixed, np.nan)


def _felt(cue: Cue) -> Feeling:
    """What a cue shows, in the way that its seed draws."""
    profile = cue.profile if cue.seed is None else way_drawn(cue.profile, Drawn(1.0, cue.seed))
    return Feeling.of(profile.weights)


def _laid_over(plan: Plan, overlay: Overlay, step: int) -> Plan:
    """A plan whose lids close as far as is laid over its step; eyes and head are no matter of plans."""
    goal = overlay.upon(plan.goal, step)
    blinks = np.isin(np.arange(1, FAP_COUNT + 1), LID_FAPS) & (overlay.closure[step] > 0.0)
    return replace(plan, goal=goal, evened=np.where(blinks, goal, plan.evened))
