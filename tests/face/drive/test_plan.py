"""Plans: as asked, weighed, and blended."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.face.drive.natural.planning import plan_naturally
from risorius.face.drive.plan import Plan, blended
from risorius.face.drive.request import Drive, Request, silent_faps

SILENT = Request(silent_faps())


def plan_of(word: str, variant: int) -> Plan:
    profile = api.archetype(word, variant)
    return plan_naturally(Request(profile.frame(), emotion=profile.weights))


def test_a_plan_shown_alone_is_itself_and_two_in_full_are_their_mean() -> None:
    joy, fear = plan_of("joy", 1), plan_of("fear", 8)
    alone = blended(SILENT, [joy, fear], [1.0, 0.0])
    np.testing.assert_allclose(alone.goal, joy.goal)
    np.testing.assert_array_equal(np.isnan(alone.evened), np.isnan(joy.evened))
    assert alone.muscles == pytest.approx(dict(joy.muscles))
    both = blended(SILENT, [joy, fear], [1.0, 1.0])
    np.testing.assert_allclose(both.goal, (joy.goal + fear.goal) / 2.0)
    half = blended(SILENT, [joy], [0.5])
    np.testing.assert_allclose(half.goal, joy.goal / 2.0)
    nothing = blended(SILENT, [joy, fear], [0.0, 0.0])
    assert not np.nan_to_num(nothing.goal).any()
    assert np.isnan(nothing.evened).all()


def test_a_plan_as_asked_has_nothing_to_explain() -> None:
    faps = silent_faps()
    faps[[2, 11]] = 1500.0, -40.0
    plan = Plan.as_asked(Request(faps, Drive.EXACT))
    assert plan.goal is faps
    assert plan.reasons() == {}
    assert plan.reason(3) == "as asked"
    assert plan.reason(4) == "not planned"
