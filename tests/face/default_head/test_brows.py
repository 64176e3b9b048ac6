"""The default head's brows: tufts of hair that lie on the skin where the standard says a brow is."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.face.default_head import HeadMesh, build_default_head
from risorius.face.default_head.brows import PROFILE, TUFTS

#: How far a feature point of the brow may be from its hair, metres.
NEAR = 2.5e-3


@pytest.fixture(scope="module")
def head() -> HeadMesh:
    return build_default_head()


@pytest.mark.parametrize("point", ["4.1", "4.3", "4.5"])
def test_feature_points_of_the_brow_lie_in_its_hair(head: HeadMesh, point: str) -> None:
    hair = head.vertices[head.groups["brow_l"]]
    assert np.linalg.norm(hair - head.position(point), axis=1).min() < NEAR


def test_tufts_end_unevenly_and_stand_out_over_the_furrows_between_them(head: HeadMesh) -> None:
    rows = head.vertices[head.groups["brow_l"]].reshape(2 * TUFTS + 1, len(PROFILE), 3)[10:-10]
    upper = np.linalg.norm(rows[:, -1] - rows[:, len(PROFILE) // 2], axis=1)
    tips, furrows = upper[1::2], upper[::2]
    assert (tips > 0.5 * (furrows[1:] + furrows[:-1])).mean() > 0.95
    assert np.std(np.diff(tips)) > 0.1e-3


def test_tufts_lean_outwards_on_their_way_up(head: HeadMesh) -> None:
    rows = head.vertices[head.groups["brow_l"]].reshape(2 * TUFTS + 1, len(PROFILE), 3)[10:-10]
    assert (rows[:, -2, 0] > rows[:, 1, 0]).all()
