"""What pixels show and what hides a place, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.arrays import Floats, Ints
from risorius.labels.raster import Triangles, draw, nearest
from risorius.labels.view import View

K = np.array([[300.0, 0.0, 32.0], [0.0, 280.0, 24.0], [0.0, 0.0, 1.0]])


def view(*, perspective: bool = True) -> View:
    """A small picture."""
    return View(64, 48, K, np.eye(3), np.zeros(3), perspective, near=0.01, far=100.0)


def plane(depth: float, tilt: float = 0.0, size: float = 50.0) -> tuple[Floats, Ints]:
    """Two triangles about z = depth + tilt x, wider than the picture."""
    x, y = np.array([(-size, -size), (size, -size), (size, size), (-size, size)]).T
    return np.stack([x, y, depth + tilt * x], axis=1), np.array([(0, 1, 2), (0, 2, 3)])


@pytest.mark.parametrize("tilt", [0.0, 0.3, -1.5])
def test_depth_of_a_tilted_plane_is_that_of_the_ray_through_each_pixel(tilt: float) -> None:
    """With a slope of 1.5 and 50 m of plane, half of it lies behind the camera."""
    vertices, triangles = plane(2.0, tilt)
    drawn = draw(Triangles.of(view(), vertices, triangles))
    slope = (np.arange(64) + 0.5 - 32.0) / 300.0  # x over z
    expected = 2.0 / (1.0 - tilt * slope)
    assert drawn.there.all()
    np.testing.assert_allclose(drawn.depth, np.broadcast_to(expected, (48, 64)), rtol=1e-12)


def test_shares_give_the_place_back() -> None:
    vertices, triangles = plane(2.0, 0.3)
    drawn = draw(Triangles.of(view(), vertices, triangles))
    places = np.einsum("hwk,hwki->hwi", drawn.shares, vertices[triangles[drawn.triangle]])
    x, y = np.meshgrid(np.arange(64) + 0.5, np.arange(48) + 0.5)
    seen = view().pixels(places.reshape(-1, 3)).reshape(48, 64, 2)
    np.testing.assert_allclose(seen, np.stack([x, y], axis=-1), atol=1e-7)


def test_the_nearer_of_two_is_seen_wherever_it_stands_in_the_mesh() -> None:
    far, near = plane(3.0), plane(1.0, size=0.05)
    for first, second in ((far, near), (near, far)):
        vertices = np.concatenate([first[0], second[0]])
        triangles = np.concatenate([first[1], second[1] + 4])
        drawn = draw(Triangles.of(view(), vertices, triangles))
        x, y = np.meshgrid(np.arange(64) + 0.5 - 32.0, np.arange(48) + 0.5 - 24.0)
        inside = (np.abs(x) < 15.0) & (np.abs(y) < 14.0)
        np.testing.assert_allclose(drawn.depth, np.where(inside, 1.0, 3.0), rtol=1e-12)


def test_every_pixel_of_a_fan_belongs_to_one_of_its_triangles() -> None:
    """Borders between triangles run through the middles of pixels, and none is left open."""
    angles = np.linspace(0.0, 2.0 * np.pi, 17)[:-1]
    rim = np.stack([np.cos(angles), np.sin(angles), np.full(16, 1.0)], axis=1)
    vertices = np.vstack([[0.5 / 300.0, 0.5 / 280.0, 1.0], rim])
    triangles = np.array([(0, 1 + i, 1 + (i + 1) % 16) for i in range(16)])
    assert draw(Triangles.of(view(), vertices, triangles)).there.all()


def test_without_perspective_places_fall_straight_on_the_picture() -> None:
    flat = view(perspective=False)
    vertices, triangles = plane(2.0, 0.3)
    drawn = draw(Triangles.of(flat, vertices, triangles))
    expected = 2.0 + 0.3 * (np.arange(64) + 0.5 - 32.0) / 300.0
    np.testing.assert_allclose(drawn.depth, np.broadcast_to(expected, (48, 64)), rtol=1e-12)


def test_what_lies_before_a_place_is_found_between_pixels_too() -> None:
    vertices, triangles = plane(2.0, 0.3)
    places = np.array([[10.123, 20.77], [63.999, 0.001], [np.nan, 3.0]])
    found = nearest(Triangles.of(view(), vertices, triangles), places)
    np.testing.assert_allclose(found[:2], 2.0 / (1.0 - 0.3 * (places[:2, 0] - 32.0) / 300.0), rtol=1e-12)
    assert np.isinf(found[2])


def test_drawing_is_the_same_however_much_is_looked_at_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(5)
    vertices = rng.normal(size=(300, 3)) * 0.2 + np.array([0.0, 0.0, 2.0])
    triangles = rng.integers(0, 300, (400, 3))
    whole = draw(Triangles.of(view(), vertices, triangles))
    monkeypatch.setattr("risorius.labels.raster.AT_ONCE", 97)
    parts = draw(Triangles.of(view(), vertices, triangles))
    np.testing.assert_array_equal(whole.triangle, parts.triangle)
    np.testing.assert_array_equal(whole.depth, parts.depth)
