"""Brows that are painted on a face: where they are found, and what is none."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.face.fit.bending.brow_lines import box_of_brows
from risorius.face.fit.bending.painted_brows import find_brows
from risorius.face.fit.surface.paint import Paint, of_corners, of_image, weights_in

EYES = {
    "3.7": np.array([0.044, -0.08, 0.03]),
    "3.11": np.array([0.016, -0.09, 0.028]),
    "3.8": np.array([-0.016, -0.09, 0.028]),
    "3.12": np.array([-0.044, -0.08, 0.03]),
}
#: The middle line of the left brow: inner end, arch, outer end; (x, z) in metres.
LINE = np.array([[0.012, 0.044], [0.035, 0.05], [0.052, 0.043]])


def wall(spacing: float = 0.8e-3) -> np.ndarray:
    """(N, 3) points of a plane before the viewer."""
    x, z = np.meshgrid(np.arange(-0.08, 0.08, spacing), np.arange(0.0, 0.09, spacing))
    return np.column_stack([x.ravel(), np.full(x.size, -0.09), z.ravel()])


def painted(points: np.ndarray, *, sides: tuple[float, ...] = (1.0, -1.0), skin: float = 0.7) -> np.ndarray:
    """(N,) brightness with brows some 7 mm thick, brighter towards the light, and darker lids."""
    bright = skin * (1.0 + points[:, 0] + 2.0 * (points[:, 2] - 0.03))
    for side in sides:
        along = side * points[:, 0]
        height = np.interp(along, *LINE.T)
        inside = (along > LINE[0, 0]) & (along < LINE[-1, 0]) & (abs(points[:, 2] - height) < 3.5e-3)
        bright = np.where(inside, 0.4 * skin, bright)
        lid = ((along - 0.03) / 0.02) ** 2 + ((points[:, 2] - 0.033) / 0.006) ** 2
        bright = np.where(lid < 1.0, 0.6 * bright, bright)
    return bright


@pytest.mark.parametrize("skin", [0.25, 0.7])
def test_painted_brows_are_found_where_they_are(skin: float) -> None:
    points = wall()
    bright = painted(points, skin=skin) + 0.02 * np.random.default_rng(2).normal(size=len(points))
    found = find_brows(points, bright, EYES)
    for name, place in zip(("4.1", "4.3", "4.5"), LINE, strict=True):
        assert np.linalg.norm(found[name] - place) < 4e-3, name
    for name, place in zip(("4.2", "4.4", "4.6"), LINE, strict=True):
        assert np.linalg.norm(found[name] - place * (-1.0, 1.0)) < 4e-3, name


@pytest.mark.parametrize("sides", [(), (1.0,)])
def test_light_lids_and_one_brow_alone_tell_nothing(sides: tuple[float, ...]) -> None:
    points = wall()
    assert find_brows(points, painted(points, sides=sides), EYES) == {}


def test_hair_on_the_forehead_is_no_brow() -> None:
    points = wall()
    bright = np.where(points[:, 2] > 0.055, 0.1, painted(points, sides=()))
    assert find_brows(points, bright, EYES) == {}


def test_an_unpainted_face_and_one_that_is_not_there_have_no_brows() -> None:
    points = wall()
    assert find_brows(points, np.full(len(points), 0.5), EYES) == {}
    assert find_brows(points[:0], np.zeros(0), EYES) == {}


def test_brows_lie_in_the_box() -> None:
    low, high = box_of_brows(EYES)
    for x, z in LINE:
        assert (low < (x, -0.08, z)).all()
        assert (high > (x, -0.08, z)).all()


def test_weights_tell_a_place_on_a_triangle() -> None:
    corners = np.array([[[0.0, 0.0, 0.0], [2.0, 0.0, 1.0], [0.0, 3.0, 0.0]]])
    weights = np.array([[0.2, 0.3, 0.5]])
    place = (weights[:, :, None] * corners).sum(axis=1)
    np.testing.assert_allclose(weights_in(corners, place), weights)


def test_paint_is_read_at_corners_and_in_images() -> None:
    corners = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]])
    image = np.array([[0.0, 1.0], [0.25, 0.5]])
    places, bright = Paint(corners, of_corners(np.array([[0.0, 1.0, 0.0]]))).within(
        np.full(3, -0.1), np.full(3, 0.6), lambda positions: positions
    )
    assert len(places) > 1000
    assert places.max() <= 0.6
    np.testing.assert_allclose(bright, places[:, 0], atol=1e-9)
    uv = np.array([[[0.25, 0.25], [1.75, 0.25], [0.25, 0.75]]])
    looked_up = of_image(uv, image)(np.zeros(3, dtype=np.int64), np.eye(3))
    np.testing.assert_allclose(looked_up, [0.0, 1.0, 0.25])


def test_nothing_in_the_box_is_no_paint() -> None:
    paint = Paint(np.zeros((1, 3, 3)), of_corners(np.ones((1, 3))))
    places, bright = paint.within(np.ones(3), 2.0 * np.ones(3), lambda positions: positions)
    assert len(places) == len(bright) == 0
