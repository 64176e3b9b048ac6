"""A lip point that lies a hair's breadth on the other lip belongs to its own all the same."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.face.mesh.points import BoundPoint


@pytest.mark.slow
@pytest.mark.parametrize(("name", "other"), [("2.3", "2.2"), ("2.2", "2.3"), ("2.8", "2.6"), ("2.7", "2.9")])
def test_a_point_given_on_the_other_lip_goes_with_its_own(name: str, other: str) -> None:
    head = api.build_default_head()
    points = {key: np.asarray(head.position(key)) for key in head.points}
    right = api.Face.from_arrays(head.vertices, head.polygons, points, head.parts)
    astray = {**points, name: points[other] + 0.1 * (points[name] - points[other])}
    face = api.Face.from_arrays(head.vertices, head.polygons, astray, head.parts)
    open_jaw = np.where(np.arange(68) == 2, 700.0, np.nan)
    moved = right.pose(open_jaw, drive="exact").positions - head.vertices

    def motion(point: BoundPoint) -> np.ndarray:
        return np.asarray(point.weights @ moved[point.vertices])

    bound, own, across = motion(face.points[name]), motion(right.points[name]), motion(right.points[other])
    assert np.linalg.norm(bound - own) < 0.4 * np.linalg.norm(bound - across)
