"""A motion as few shapes times weights."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.scene.bake.compress import compress


def motion(rank: int, frames: int = 40, vertices: int = 300) -> np.ndarray:
    rng = np.random.default_rng(7)
    weights, shapes = rng.standard_normal((frames, rank)), rng.standard_normal((rank, vertices, 3))
    return np.tensordot(weights * 0.7 ** np.arange(rank), shapes, axes=1) * 0.01


@pytest.mark.parametrize("rank", [1, 3, 8])
def test_a_motion_of_a_rank_needs_that_many_shapes(rank: int) -> None:
    packed = compress(motion(rank), tolerance=1e-7)
    assert len(packed.shapes) == rank


def test_every_vertex_of_every_frame_is_within_the_tolerance() -> None:
    moving = motion(30)
    packed = compress(moving, tolerance=1e-3)
    lengths = np.linalg.norm(packed.displacement() - moving, axis=2)
    assert lengths.max() <= 1e-3
    assert lengths.max() == pytest.approx(packed.error, rel=1e-6)
    fewer = np.tensordot(packed.weights[:, :-1], packed.shapes[:-1], axes=1)
    assert np.linalg.norm(fewer - moving, axis=2).max() > 1e-3


def test_weights_fill_a_slider_and_a_rest_stays_a_rest() -> None:
    moving = motion(5)
    moving[[0, -1]] = 0.0
    packed = compress(moving, tolerance=1e-6)
    np.testing.assert_array_equal(np.abs(packed.weights).max(axis=0), 1.0)
    assert np.abs(packed.weights[[0, -1]]).max() < 1e-12


def test_nothing_moves() -> None:
    packed = compress(np.zeros((5, 10, 3)))
    assert packed.shapes.shape == (0, 10, 3)
    assert packed.error == 0.0


def test_wrong_input_is_named() -> None:
    with pytest.raises(ParameterError, match="tolerance"):
        compress(motion(1), tolerance=0.0)
    with pytest.raises(ParameterError, match="displacements"):
        compress(np.full((2, 3, 3), np.nan))
