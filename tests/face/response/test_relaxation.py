"""The biphasic skin of a face under its muscles."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.face.face import Face
from risorius.face.response.actuators import Amounts
from risorius.face.response.spring_skin import spring_skin
from risorius.physics.tissue import tissue


def smiling(face: Face, millimetres: float) -> Amounts:
    """Both zygomatici majores by so much."""
    actuators = face.anatomy.actuators
    solution = np.zeros(actuators.count)
    for number, muscle in enumerate(actuators.muscles):
        if muscle.row.name == "zygomaticus_major":
            solution[number] = millimetres * 1e-3
    return actuators.amounts(solution)


def test_the_pose_is_an_equilibrium_of_the_biphasic_skin(face: Face) -> None:
    """What the skin's force leaves of the muscles', as a share of it; the low-strain response leaves a quarter."""
    anatomy = face.anatomy
    amounts = smiling(face, 8.0)
    low_strain = np.tensordot(amounts.muscles, anatomy.actuators.sheets, axes=1)
    force = tissue().membrane * (anatomy.sheet.stiffness @ low_strain)
    skin = spring_skin(anatomy.skin)
    settled = anatomy.relaxation.balance(amounts)
    whole = np.linalg.norm(force)
    assert np.linalg.norm(skin.force(settled) + force) < 0.02 * whole
    assert np.linalg.norm(skin.force(anatomy.skin.positions + low_strain) + force) > 0.15 * whole


def test_springs_give_more_than_their_bound_until_they_stiffen(face: Face) -> None:
    """Springs resist along themselves only, so the sheet gives more than its scalar bound says while it is slack."""
    anatomy = face.anatomy
    gains = []
    for millimetres in (2.0, 20.0):
        amounts = smiling(face, millimetres)
        gains.append(
            np.abs(anatomy.relaxation.pulled(amounts)).max() / np.abs(anatomy.actuators.low_strain(amounts)).max()
        )
    assert 1.1 < gains[0] < 1.3
    assert gains[1] < gains[0] - 0.05


def test_no_contraction_is_rest(face: Face) -> None:
    assert np.abs(face.anatomy.relaxation.pulled(smiling(face, 0.0))).max() == 0.0


def test_an_unknown_tissue_is_refused(face: Face) -> None:
    with pytest.raises(ParameterError, match="tissue"):
        spring_skin(face.anatomy.skin, "rubber")
