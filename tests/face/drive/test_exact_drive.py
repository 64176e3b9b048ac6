"""The exact drive: what is asked is done, and what nobody asks for goes along."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face
from risorius.mpeg4 import VARIANTS

PROFILES = [api.archetype(word, variant) for word in api.ARCHETYPES for variant in VARIANTS[word]]


@pytest.mark.parametrize("name", ["default", pytest.param("ict", marks=pytest.mark.slow), "makehuman"])
def test_all_profiles_of_the_paper_are_met(any_face: Callable[[str], Face], name: str) -> None:
    """Error as a share of the request, or of 100 units where less is asked."""
    assert len(PROFILES) == 25
    face = any_face(name)
    errors = []
    for profile in PROFILES:
        frame = profile.frame()
        achieved = face.pose(frame, drive="exact").achieved
        asked = ~np.isnan(frame)
        assert not np.isnan(achieved[asked]).any()
        errors.append(np.abs(achieved - frame)[asked] / np.maximum(np.abs(frame[asked]), 100.0))
    flat = np.concatenate(errors)
    assert np.median(flat) <= 0.01
    assert np.quantile(flat, 0.95) <= 0.05


def test_silent_faps_are_not_held_at_zero(face: Face) -> None:
    frame = np.full(68, np.nan)
    frame[3 - 1] = 500.0
    achieved = face.pose(frame, drive="exact").achieved
    assert achieved[5 - 1] < -200.0  # the lower lip goes with the jaw
    frame[5 - 1] = 0.0
    assert face.pose(frame, drive="exact").achieved[5 - 1] == pytest.approx(0.0, abs=2.0)


def test_an_asked_point_takes_its_neighbourhood_along_without_a_spike(face: Face) -> None:
    frame = np.full(68, np.nan)
    frame[41 - 1] = 200.0  # lift_l_cheek
    moved = face.pose(frame, drive="points").positions - face.vertices
    skin, point = face.anatomy.skin.index, face.points["5.3"].position
    distance = np.linalg.norm(face.vertices[skin] - point, axis=1)
    size = np.linalg.norm(moved[skin], axis=1)
    assert size.max() < 1.5 * size[distance < 3e-3].mean()
    assert size[(distance > 5e-3) & (distance < 8e-3)].mean() > 0.5 * size.max()
