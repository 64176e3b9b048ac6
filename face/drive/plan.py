"""What a face is to do for a request, FAP by FAP."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...arrays import Floats
from .request import Request, silent_faps

#: What differs by less than a share and some FAP units counts as asked: after its range was heeded, after others were.
AS_HELD, AS_WEIGHED = (0.02, 1.0), (0.1, 5.0)
#: A FAP of which the emotion leaves less than this share is not asked any more.
AS_SILENT = 0.1


@dataclass(frozen=True, eq=False)
class Plan:
    """What a face is to do for one request.

    Attributes
    ----------
    request : what is asked.
    goal : (68,) what the face is to do, FAP units; NaN where nothing is known of the FAP.
    evened : (68,) what is asked, small differences of left and right evened, FAP units; NaN where silent.
    meant : (68,) what is asked once what the emotion's action units do is heeded, FAP units; NaN where silent.
    limited : (68,) that, held within the anatomical range, FAP units; NaN where silent.
    muscles : muscle name (with side) -> amount in metres that is expected of it, for what no FAP sees.
    units : half unit name -> amount, why the silent FAPs are what they are.
    """

    request: Request
    goal: Floats
    evened: Floats
    meant: Floats
    limited: Floats
    muscles: Mapping[str, float] = field(default_factory=dict)
    units: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def as_asked(cls, request: Request) -> Plan:
        """The plan to do what is asked, and nothing else."""
        return cls(request, request.faps, request.faps, request.faps, request.faps)

    @property
    def wanted(self) -> Floats:
        """(68,) what is asked of the face, FAP units; NaN where silent, or where the emotion goes against it."""
        faps = self.request.faps
        against = ~np.isnan(self.meant) & ((np.abs(self.meant) < AS_SILENT * np.abs(faps)) | (self.meant * faps < 0.0))
        return np.where(against, np.nan, faps)

    def reason(self, number: int) -> str:
        """In words, why a FAP's goal is what it is."""
        each = (self.goal, self.evened, self.meant, self.limited)
        goal, evened, meant, limited = (float(faps[number - 1]) for faps in each)
        if np.isnan(goal):
            return "not planned"
        if np.isnan(evened) and not np.isnan(meant):
            return "not in the profile; the emotion shows it"
        if np.isnan(meant):
            return "not in the profile; it follows from the action units that explain the request"
        if _differ(meant, evened, AS_HELD):
            return "the emotion shows it otherwise than the profile"
        if _differ(limited, meant, AS_HELD):
            return "limited by its anatomical range"
        if _differ(goal, limited, AS_WEIGHED):
            return "balanced against other requests"
        return "as asked"

    def reasons(self) -> dict[int, str]:
        """FAP number -> why, for every planned FAP that is not simply as asked."""
        planned = (np.flatnonzero(~np.isnan(self.goal)) + 1).tolist()
        return {number: reason for number in planned if (reason := self.reason(number)) != "as asked"}


def _differ(value: float, from_value: float, tolerance: tuple[float, float]) -> bool:
    """Whether a value differs by more than a share of another and some units."""
    share, units = tolerance
    return abs(value - from_value) > share * abs(from_value) + units


def blended(request: Request, plans: Sequence[Plan], weights: Sequence[float]) -> Plan:
    """One plan for a request from several that are shown at once, each in 0..1 of its strength; together never above 1.

    A FAP is asked where any plan that is shown at all asks for it.
    """
    total = max(float(sum(weights)), 1.0)
    shown = [(plan, weight / total) for plan, weight in zip(plans, weights, strict=True) if weight > 0.0]
    if not shown:
        rest = np.where(np.isnan(plans[0].goal), np.nan, 0.0)
        return Plan(request, rest, silent_faps(), silent_faps(), silent_faps())
    shares = np.array([share for _, share in shown])
    return Plan(
        request,
        goal=_mixed([plan.goal for plan, _ in shown], shares),
        evened=_mixed([plan.evened for plan, _ in shown], shares),
        meant=_mixed([plan.meant for plan, _ in shown], shares),
        limited=_mixed([plan.limited for plan, _ in shown], shares),
        muscles=_summed([(plan.muscles, share) for plan, share in shown]),
        units=_summed([(plan.units, share) for plan, share in shown]),
    )


def _mixed(parts: Sequence[Floats], shares: Floats) -> Floats:
    """(68,) sum of shares of FAPs (68,); NaN where all are silent."""
    values = np.stack(parts)
    known = ~np.isnan(values)
    return np.where(known.any(axis=0), shares @ np.where(known, values, 0.0), np.nan)


def _summed(parts: Sequence[tuple[Mapping[str, float], float]]) -> dict[str, float]:
    """Name -> sum of shares."""
    total: dict[str, float] = {}
    for amounts, share in parts:
        for name, amount in amounts.items():
            total[name] = total.get(name, 0.0) + share * amount
    return total
