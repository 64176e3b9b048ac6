"""The four drives: how each plans, what it wants of the points, what moves them there, and who has the last word."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from ..mesh.fap_rows import FapRows
from .natural.planning import plan_naturally
from .plan import Plan
from .request import Drive, Request
from .targets import Targets, exact_targets, natural_targets


class Correction(StrEnum):
    """Whether the elastic skin goes the rest of the way to the targets, and who has the last word there.

    none : it does not. contact : skin that meets skin, eyeballs or teeth, and what was set by hand. faps : the FAPs.
    """

    NONE = "none"
    CONTACT = "contact"
    FAPS = "faps"


@dataclass(frozen=True)
class DriveRules:
    """How one drive goes from a request to a pose.

    Attributes
    ----------
    plan : a request -> its plan. targets : the rows of a face and a plan -> its targets.
    muscles : whether muscles, lids and jaw explain the targets; else only those that are set by hand do anything.
    correction : see `Correction`. folds : whether squeezed skin folds.
    """

    plan: Callable[[Request], Plan]
    targets: Callable[[FapRows, Plan], Targets]
    muscles: bool
    correction: Correction
    folds: bool


DRIVES: Mapping[Drive, DriveRules] = MappingProxyType(
    {
        Drive.NATURAL: DriveRules(
            plan=plan_naturally, targets=natural_targets, muscles=True, correction=Correction.CONTACT, folds=True
        ),
        Drive.EXACT: DriveRules(
            plan=Plan.as_asked, targets=exact_targets, muscles=True, correction=Correction.FAPS, folds=False
        ),
        Drive.MUSCLES: DriveRules(
            plan=Plan.as_asked, targets=exact_targets, muscles=True, correction=Correction.NONE, folds=False
        ),
        Drive.POINTS: DriveRules(
            plan=Plan.as_asked, targets=exact_targets, muscles=False, correction=Correction.FAPS, folds=False
        ),
    }
)
