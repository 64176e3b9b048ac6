"""Lids and lips in expressions, and what is a mouth's opening and what a crease."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.arrays import Floats
from risorius.face.fit.bending.carry import _lids_in_order
from risorius.face.fit.surface.cloud import Surface
from risorius.face.fit.surface.rims import Neighbourhood

SIZE = 21


def pocket(depth: float) -> Surface:
    """A sheet before the viewer (-y) with a pocket of a depth in its middle, metres."""
    x, z = np.meshgrid(np.arange(SIZE) - SIZE // 2, np.arange(SIZE) - SIZE // 2, indexing="ij")
    inside = (np.abs(x) < 4) & (np.abs(z) < 2)
    vertices = np.column_stack([2e-3 * x.ravel(), np.where(inside, depth, 0.0).ravel(), 2e-3 * z.ravel()])
    number = np.arange(SIZE * SIZE).reshape(SIZE, SIZE)
    corners = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
    return Surface.from_polygons(vertices, np.stack([corner.ravel() for corner in corners], axis=1))


def edge_of_the_pocket() -> np.ndarray:
    """The vertices round the pocket, with the sheet to the left of the way."""
    ring = [(x, 2) for x in range(-4, 5)] + [(4, z) for z in (1, 0, -1, -2)]
    ring += [(x, -2) for x in range(3, -5, -1)] + [(-4, z) for z in (-1, 0, 1)]
    return np.array([(x + SIZE // 2) * SIZE + z + SIZE // 2 for x, z in ring])


def test_the_skin_behind_a_rim_tells_a_crease_from_an_opening() -> None:
    for depth in (1e-3, 25e-3):
        near = Neighbourhood(pocket(depth), np.zeros(3), 1.0)
        assert near.depth_behind(edge_of_the_pocket()) == pytest.approx(depth)


def test_a_rim_round_a_hole_has_nothing_behind_it() -> None:
    whole = pocket(1e-3)
    middles = whole.vertices[whole.triangles].mean(axis=1)
    for hole in (np.abs(middles[:, [0, 2]]).max(axis=1) < 1e-3, middles[:, 1] > 0.0):
        near = Neighbourhood(whole.part(~hole), np.zeros(3), 1.0)
        assert near.depth_behind(edge_of_the_pocket()) == np.inf


def errors_mm(shared: Path, head: object, expression: str | None, names: tuple[str, ...]) -> dict[str, float]:
    """How far feature points are found from the true ones on a scanned head, at rest or in an expression."""
    shapes = np.load(shared / "heads" / "ict_expressions.npz")
    inner = np.load(shared / "heads" / "ict_expressions_inner.npz")
    displacement = np.zeros_like(head.vertices)  # type: ignore[attr-defined]
    for side in "LR" if expression else "":
        number = list(shapes["names"]).index(f"{expression}_{side}")
        skin = shapes["displacement"][number]
        displacement[: len(skin)] += skin[: len(displacement)]
        if len(displacement) > len(skin):
            displacement[len(skin) :] += inner["displacement"][number]
    vertices = head.vertices + displacement  # type: ignore[attr-defined]
    found = api.find_points(vertices, head.polygons, topologies=())  # type: ignore[attr-defined]
    truth = {name: vertices[head.points[name]] for name in names}  # type: ignore[attr-defined]
    return {name: 1000.0 * float(np.linalg.norm(found.positions[name] - truth[name])) for name in names}


@pytest.mark.slow
def test_shut_eyes_with_lashes_end_at_their_corners(shared: Path, shared_head: Callable) -> None:
    errors = errors_mm(shared, shared_head("ict"), "eyeBlink", ("3.7", "3.12", "3.11", "3.8", "3.1", "3.2"))
    assert max(errors.values()) < 3.5, errors


@pytest.mark.slow
def test_a_smile_takes_the_lips_corners_along(shared: Path, shared_head: Callable) -> None:
    errors = errors_mm(shared, shared_head("ict_narrow"), "mouthSmile", ("8.3", "8.4", "2.4", "2.5"))
    assert max(errors.values()) < 4.0, errors


@pytest.mark.slow
def test_lids_and_lips_meet_where_their_rims_lie_deepest(shared: Path, shared_head: Callable) -> None:
    errors = errors_mm(shared, shared_head("ict_narrow"), None, ("3.7", "3.12", "2.4", "2.5"))
    assert max(errors.values()) < 1.0, errors


@pytest.mark.parametrize("swapped", [("3.1", "3.3"), ("3.2", "3.4"), ("3.1", "3.3", "3.2", "3.4")])
def test_an_upper_lid_never_ends_below_the_lower_one(swapped: tuple[str, ...]) -> None:
    class Anywhere:
        """A surface that is everywhere."""

        def nearest(self, name: str, place: Floats) -> Floats:
            return place

    sound = {"3.1": (30.0, 5.0), "3.3": (30.0, -5.0), "3.2": (-30.0, 4.0), "3.4": (-30.0, -4.0)}
    places = {name: np.array([x, 0.0, z]) * 1e-3 for name, (x, z) in sound.items()}
    for upper, lower in zip(swapped[::2], swapped[1::2], strict=True):
        places[upper], places[lower] = places[lower], places[upper]
    mended = {**places, **_lids_in_order(places, Anywhere())}
    for upper, lower in (("3.1", "3.3"), ("3.2", "3.4")):
        assert mended[upper][2] > mended[lower][2]
        assert np.sign(mended[upper][0]) == np.sign(sound[upper][0])
