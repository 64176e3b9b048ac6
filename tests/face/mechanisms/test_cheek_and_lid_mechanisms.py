"""Mechanisms of cheek, lips and lids that no feature point shows: each fails without its own term."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from risorius.api import Face
from risorius.face.mechanisms.lid_movers import LidMove

FACES = ["default", "ict", "makehuman"]


def field_at(face: Face, muscle: str, point: str) -> np.ndarray:
    """Displacement of a muscle, as shares of its largest one, where a feature point lies."""
    anatomy = face.anatomy
    k = next(i for i, m in enumerate(anatomy.actuators.muscles) if m.name == muscle)
    nearest = np.argmin(np.linalg.norm(anatomy.skin.positions - anatomy.skin.points[point], axis=1))
    return np.asarray(anatomy.actuators.fields[k][nearest])


@pytest.mark.parametrize("name", FACES)
def test_a_dimple_draws_the_corner_in_and_leaves_the_lips_middle(any_face: Callable[[str], Face], name: str) -> None:
    face = any_face(name)
    corner = field_at(face, "buccinator_l", "8.3")
    assert corner[0] > 0.15  # to the side
    assert corner[2] < -0.5  # and back
    assert np.linalg.norm(field_at(face, "buccinator_l", "2.2")) < 0.3
    assert np.linalg.norm(field_at(face, "buccinator_l", "8.4")) < 0.05


@pytest.mark.parametrize("name", FACES)
def test_lips_drawn_aside_go_round_the_teeth(any_face: Callable[[str], Face], name: str) -> None:
    face = any_face(name)
    leading, middle, following = (field_at(face, "buccinator_lips_l", p) for p in ("8.3", "2.2", "8.4"))
    assert min(leading[0], following[0]) > 0.35
    assert middle[0] > max(leading[0], following[0])
    assert leading[2] < -0.2 < 0.1 < following[2]


@pytest.mark.parametrize("name", FACES)
def test_a_blown_cheek_swells_more_than_the_mouths_corner(any_face: Callable[[str], Face], name: str) -> None:
    face = any_face(name)
    cheek, corner = (np.linalg.norm(field_at(face, "cheek_puff_l", p)) for p in ("5.1", "8.3"))
    assert cheek > corner
    assert np.linalg.norm(field_at(face, "cheek_puff_l", "2.2")) < 0.2


@pytest.mark.parametrize("name", FACES)
def test_a_closing_lid_draws_the_lower_lid_to_the_nose(any_face: Callable[[str], Face], name: str) -> None:
    """Scanned blink: 2 to 3 mm along, hardly any rise, for 6 to 9 mm of closing."""
    face = any_face(name)
    skin = face.anatomy.skin
    for side, nose in (("l", -1.0), ("r", 1.0)):
        moved = face.anatomy.eyes[side].skin(skin.positions, {LidMove.UPPER_CLOSE: 8e-3})
        opening = skin.eyes[side]
        middle = opening.lower[len(opening.lower) // 3 : -len(opening.lower) // 3]
        along, up = nose * moved[middle, 0], moved[middle, 1]
        assert 1.5e-3 < along.mean() < 5e-3
        assert np.abs(up).max() < 0.5e-3
