"""Postures tell what brings the skin where it is."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Drive, Face
from risorius.face.assembly import Assembly
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


def test_several_moments_together_are_those_of_each_alone(face: Face) -> None:
    """Whatever the others are at: lips pressed, lids shut under a turned eye, an open jaw, nothing at all."""
    blink, opened, nothing = (np.full(68, np.nan) for _ in range(3))
    blink[18:20], blink[22:24], opened[2] = 1024.0, 9000.0, 400.0
    requests = [Request(faps, Drive.NATURAL) for faps in (ANGER, RAISED, nothing, blink, opened)]
    balance, assembly = Balance(face.anatomy), Assembly(face.anatomy)
    efforts = [balance.effort(DRIVES[Drive.NATURAL].plan(request)) for request in requests]
    pulled = np.array([face.anatomy.actuators.low_strain(effort.amounts) for effort in efforts])
    together = balance.reached_each(efforts, pulled)
    jaws = np.asarray(together.surroundings.jaw)
    shown = assembly.positions_each(together.displacements, jaws, requests)
    for number, (effort, request, positions) in enumerate(zip(efforts, requests, shown, strict=True)):
        alone = balance.reached(effort, pulled[number])
        np.testing.assert_allclose(together.displacements[number], alone.displacement, atol=1e-9)
        jaw = alone.amounts.jaw
        np.testing.assert_allclose(positions, assembly.positions(alone.displacement, jaw, request), atol=1e-9)
    assert np.abs(together.pushed[1]).max() > 1e-3
    assert np.abs(together.carried[3]).max() > 5e-3
    assert np.abs(together.displacements[2]).max() == 0.0
