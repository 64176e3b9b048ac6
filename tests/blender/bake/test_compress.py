"""A motion as few shapes times weights."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.progress import run
from risorius.scene.bake.compress import compress
from risorius.scene.bake.compress_long import compress_long


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


class Waves:
    """A long motion of known shapes; `posed` frames say least of it."""

    posed = np.arange(0, 20)

    def __init__(self, rank: int, count: int) -> None:
        rng, times = np.random.default_rng(7), np.arange(count)[:, None]
        self.shapes = 0.01 * rng.standard_normal((rank, 300, 3)) * 0.7 ** np.arange(rank)[:, None, None]
        self.weights = np.sin(times * rng.uniform(0.01, 0.05, rank)) * (times < count - 50)
        self.frames = np.where(np.abs(self.weights) > 0.0, self.weights, 0.0)

    def __len__(self) -> int:
        return len(self.weights)

    def positions(self, steps: np.ndarray, vertices: np.ndarray | slice = slice(None)) -> np.ndarray:
        return 1.0 + np.tensordot(self.weights[steps], self.shapes[:, vertices], axes=1)


@pytest.mark.parametrize("rank", [1, 12])
def test_a_long_motion_is_compressed_without_all_of_it(rank: int) -> None:
    motion = Waves(rank, 3000)
    packed = run(compress_long(motion, np.ones((300, 3)), tolerance=1e-5))
    assert len(packed.shapes) == rank
    apart = packed.displacement() - (motion.positions(np.arange(3000)) - 1.0)
    assert np.linalg.norm(apart, axis=2).max() <= packed.error * 1.01 + 1e-9 < 2e-5
    np.testing.assert_array_equal(packed.weights[-50:], 0.0)
    np.testing.assert_array_equal(np.abs(packed.weights).max(axis=0), 1.0)
    assert len(run(compress_long(motion, np.ones((300, 3)), tolerance=1e-2)).shapes) < max(rank, 2)


def test_a_long_motion_in_which_nothing_moves_has_no_shapes() -> None:
    motion = Waves(1, 100)
    motion.weights[:] = motion.frames[:] = 0.0
    packed = run(compress_long(motion, np.ones((300, 3))))
    assert packed.shapes.shape == (0, 300, 3)
    assert packed.weights.shape == (100, 0)
    assert packed.error == 0.0


def local_motion(vertices: int = 600) -> np.ndarray:
    """Four parts of a row of vertices, each with a motion of its own."""
    rng = np.random.default_rng(3)
    weights = np.linalg.qr(rng.standard_normal((60, 4)))[0]
    middles = np.linspace(75.0, vertices - 75.0, 4)
    places = np.exp(-(((np.arange(vertices) - middles[:, None]) / 25.0) ** 2))
    return np.tensordot(0.05 * weights, places[:, :, None] * rng.standard_normal((4, 1, 3)), axes=1)


def test_shapes_are_local_where_the_motion_is() -> None:
    packed = compress(local_motion())
    moved = np.abs(packed.shapes).max(axis=2) > 0.0
    assert len(packed.shapes) == 4
    assert moved.mean() < 0.25
    assert packed.error <= 1e-4


def few_by_decomposition(moving: np.ndarray, tolerance: float) -> int:
    """Shapes that a plain singular value decomposition takes."""
    left, scale, right = np.linalg.svd(moving.reshape(len(moving), -1), full_matrices=False)
    for count in range(len(scale)):
        rest = (left[:, count:] * scale[count:]) @ right[count:]
        if np.linalg.norm(rest.reshape(moving.shape), axis=2).max() <= tolerance:
            return count
    return len(scale)


def test_fewer_shapes_than_are_best_in_the_mean() -> None:
    """A region of few vertices that moves in many ways is what a decomposition comes to last."""
    rng = np.random.default_rng(5)
    broad = np.tensordot(rng.standard_normal((50, 10)), rng.standard_normal((10, 2000, 3)), axes=1) * 1e-4
    broad[:, :20] += np.tensordot(rng.standard_normal((50, 3)), rng.standard_normal((3, 20, 3)), axes=1) * 1e-3
    tolerance = 1.2e-3
    assert len(compress(broad, tolerance=tolerance).shapes) < few_by_decomposition(broad, tolerance)


@pytest.mark.parametrize("most", [1, 5, 12])
def test_no_more_shapes_than_are_allowed_and_the_error_is_said(most: int) -> None:
    moving = motion(30)
    free = compress(moving, tolerance=1e-3)
    packed = compress(moving, tolerance=1e-3, max_keys=most)
    assert len(packed.shapes) == most < len(free.shapes)
    assert packed.is_limited
    assert not free.is_limited
    apart = np.linalg.norm(packed.displacement() - moving, axis=2).max()
    assert packed.error == pytest.approx(apart, rel=1e-6)
    left, scale, right = np.linalg.svd(moving.reshape(len(moving), -1), full_matrices=False)
    rest = (left[:, most:] * scale[most:]) @ right[most:]
    assert apart <= np.linalg.norm(rest.reshape(moving.shape), axis=2).max()


def test_a_limit_that_is_not_reached_changes_nothing() -> None:
    moving = motion(5)
    free, packed = compress(moving), compress(moving, max_keys=100)
    np.testing.assert_array_equal(packed.shapes, free.shapes)
    assert not packed.is_limited


def test_no_shapes_at_all_is_refused() -> None:
    with pytest.raises(ParameterError, match="max_keys"):
        compress(motion(1), max_keys=0)


def test_a_long_motion_has_no_more_shapes_than_are_allowed() -> None:
    motion = Waves(12, 3000)
    packed = run(compress_long(motion, np.ones((300, 3)), tolerance=1e-5, max_keys=4))
    assert len(packed.shapes) == 4
    assert packed.is_limited
    apart = packed.displacement() - (motion.positions(np.arange(3000)) - 1.0)
    assert np.linalg.norm(apart, axis=2).max() <= 1.05 * packed.error
