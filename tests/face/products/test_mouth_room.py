"""Mouths that end in an open border."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from risorius.api import Face
from risorius.face.products.mouth_room import mouth_border


def test_the_border_of_a_mouth_is_found_and_runs_from_right_to_left(sewn_head: Callable[..., Any]) -> None:
    head = sewn_head()
    face = Face.from_arrays(head.vertices, head.polygons, head.points)
    border = mouth_border(face)
    assert border is not None
    upper, lower = face.vertices[border.upper], face.vertices[border.lower]
    assert border.upper[0] == border.lower[0]
    assert border.upper[-1] == border.lower[-1]
    assert upper[0, 0] < -0.015 < 0.015 < upper[-1, 0]
    assert upper[1:-1, 2].mean() > lower[1:-1, 2].mean()
    assert np.linalg.norm(upper.mean(axis=0) - face.points["2.2"].position) < 0.015


@pytest.mark.parametrize("name", ["ict", "makehuman", "mediapipe"])
def test_mouths_with_a_bag_or_filled_have_none(any_face: Callable[[str], Face], name: str) -> None:
    assert mouth_border(any_face(name)) is None


def test_other_holes_are_none(face: Face) -> None:
    assert mouth_border(face) is None
