"""The seam between sewn lips is where they were welded."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from risorius.api import Face
from risorius.errors import ModelError
from risorius.face.products.lip_seam import LipSeam, lip_seam


@pytest.fixture(scope="module")
def sewn(sewn_head: Callable[..., Any], face: Face) -> tuple[Any, np.ndarray]:
    """A head with sewn lips, and (k, 3) where they were welded, corners left out."""
    skin = face.anatomy.given_skin
    pairs = face.vertices[skin.index][[skin.mouth.upper[1:-1], skin.mouth.lower[-2:0:-1]]]
    return sewn_head("mouth"), pairs.mean(axis=0)


def on_the_weld(vertices: np.ndarray, weld: np.ndarray) -> np.ndarray:
    """(V,) which vertices were welded."""
    return np.linalg.norm(vertices[:, None] - weld, axis=2).min(axis=1) < 1e-6


def test_it_runs_along_the_weld(sewn: tuple[Any, np.ndarray]) -> None:
    head, weld = sewn
    seam = lip_seam(Face.from_arrays(head.vertices, head.polygons, head.points))
    welded = on_the_weld(head.vertices, weld)
    assert welded.sum() == len(weld)
    assert np.abs(seam.above[welded]).max() < 0.4e-3
    for name, side in (("8.1", 1.0), ("8.2", -1.0)):
        lip = np.linalg.norm(head.vertices - head.points[name], axis=1).argmin()
        assert side * seam.above[lip] > 3e-3
    assert seam.doubled == 0
    np.testing.assert_allclose(seam.room.ends[0] * [-1, 1, 1], seam.room.ends[1], atol=1e-4)


@pytest.mark.parametrize("size", [0.01, 100.0])
def test_a_face_of_any_size_and_pose_has_the_same(sewn: tuple[Any, np.ndarray], size: float) -> None:
    head, _ = sewn
    turn = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]) * size
    points = {name: turn @ place for name, place in head.points.items()}
    first: LipSeam = lip_seam(Face.from_arrays(head.vertices, head.polygons, head.points))
    other: LipSeam = lip_seam(Face.from_arrays(head.vertices @ turn.T, head.polygons, points))
    np.testing.assert_allclose(other.above / size, first.above, atol=2e-5)
    assert other.room.depth == pytest.approx(size * first.room.depth, rel=1e-3)
    np.testing.assert_allclose(other.room.up, turn @ first.room.up / size, atol=1e-6)


def test_open_lips_have_none(face: Face) -> None:
    with pytest.raises(ModelError, match="not sewn together"):
        lip_seam(face)
