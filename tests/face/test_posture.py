"""Postures tell what brings the skin where it is."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Drive, Face
from risorius.face.drive.drives import DRIVES
from risorius.face.drive.request import ByHand, Request
from risorius.face.posture import Balance, Posture

ANGER = api.expression("anger").frame()

#: The lower lip raised against the upper one.
RAISED = np.where(np.isin(np.arange(1, 69), (5, 10, 11, 52, 57, 58)), 400.0, np.nan)


def posture(face: Face, drive: Drive, faps: np.ndarray = ANGER, by_hand: tuple[ByHand, ...] = ()) -> Posture:
    """The posture for some FAPs (68,)."""
    request = Request(faps, drive, by_hand=by_hand)
    return Balance(face.anatomy).posture(DRIVES[drive].plan(request))


@pytest.mark.parametrize("drive", [Drive.EXACT, Drive.POINTS])
def test_what_carries_pulls_and_pushes_together_takes_points_where_they_are_asked(face: Face, drive: Drive) -> None:
    """Although contact pushes lips in every round that corrects them."""
    parts, inverse = posture(face, drive, RAISED), face.anatomy.inverse
    shown = inverse.matrix @ (parts.carried + parts.elastic + parts.pushed).ravel()
    asked = inverse.rows.select(RAISED)
    assert np.abs(parts.pushed).max() > 1e-3
    np.testing.assert_allclose(shown[~np.isnan(asked)], asked[~np.isnan(asked)], atol=1e-5)


def test_jaw_and_lids_carry_muscles_pull_and_contact_pushes(face: Face) -> None:
    anatomy, pressed = face.anatomy, posture(face, Drive.MUSCLES, RAISED)
    np.testing.assert_array_equal(pressed.carried, anatomy.actuators.carried(pressed.amounts))
    np.testing.assert_array_equal(pressed.elastic, anatomy.relaxation.pulled(pressed.amounts))
    assert np.abs(pressed.pushed).max() > 1e-3
    assert np.abs(posture(face.without("contact"), Drive.MUSCLES, RAISED).pushed).max() == 0.0


def test_points_alone_move_no_muscle_but_those_set_by_hand(face: Face) -> None:
    still = posture(face, Drive.POINTS)
    assert np.abs(still.carried).max() == 0.0
    assert not still.amounts.muscles.any()
    opened = posture(face, Drive.POINTS, by_hand=(ByHand({"jaw_open": 0.5}),))
    assert np.abs(opened.carried).max() > 5e-3


def test_contractions_by_hand_come_part_of_the_way(face: Face) -> None:
    actuators = face.anatomy.actuators
    contracted = [
        actuators.contractions(posture(face, Drive.NATURAL, by_hand=(ByHand({"corrugator_l": 0.1}, share),)).amounts)
        for share in (0.0, 0.5, 1.0)
    ]
    before, midway, after = (each["corrugator_l"] for each in contracted)
    assert before > 0.3
    assert after == pytest.approx(0.1)
    assert midway == pytest.approx((before + after) / 2.0)
