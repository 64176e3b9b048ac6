"""Vertices at one place are welded where they are one, and only there."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from risorius.face.mesh.weld import Weld, weld
from risorius.physics.mesh import corners


def grid(count: int = 6, height: float = 0.0) -> tuple[np.ndarray, list[np.ndarray]]:
    """A flat sheet of count x count quads, 1 m wide."""
    line = np.linspace(0.0, 1.0, count + 1)
    x, y = np.meshgrid(line, line, indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), np.full(x.size, height)], axis=1)
    first = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    return vertices, list(np.stack([first, first + count + 1, first + count + 2, first + 1], axis=1))


def flat_shaded(vertices: np.ndarray, polygons: list[np.ndarray]) -> tuple[np.ndarray, list[np.ndarray]]:
    """Every polygon with vertices of its own."""
    loops, sizes = corners(polygons)
    return vertices[loops], np.split(np.arange(len(loops)), np.cumsum(sizes)[:-1])


def check(found: Weld, vertices: np.ndarray, count: int) -> None:
    """So many welded vertices, each of copies that lie in one place."""
    assert len(np.unique(found.leads)) == count == len(vertices) - len(found.copies)
    np.testing.assert_allclose(vertices[found.leads], vertices, atol=1e-4)
    assert (found.leads[found.leads] == found.leads).all()
    assert not np.isin(np.concatenate(found.polygons), found.copies).any()


def test_a_sheet_without_seams_stays_as_it_is() -> None:
    vertices, polygons = grid()
    found = weld(vertices, polygons)
    check(found, vertices, len(vertices))
    assert len(found.copies) == 0
    np.testing.assert_array_equal(np.stack(found.polygons), np.stack(polygons))


def test_flat_shading_is_welded() -> None:
    vertices, polygons = grid()
    split = flat_shaded(vertices, polygons)
    found = weld(*split)
    check(found, split[0], len(vertices))
    assert len(found.polygons) == len(polygons)


def test_an_unmerged_half_is_welded_whichever_way_it_winds() -> None:
    vertices, polygons = grid()
    half = vertices - [1.0, 0.0, 0.0]
    for other in (polygons, [polygon[::-1] for polygon in polygons]):
        both = np.concatenate([vertices, half])
        found = weld(both, [*polygons, *(polygon + len(vertices) for polygon in other)])
        check(found, both, 2 * len(vertices) - 7)


def test_copies_a_little_apart_are_copies() -> None:
    vertices, polygons = grid()
    split = flat_shaded(vertices, polygons)
    moved = split[0] + np.random.default_rng(1).uniform(-2e-5, 2e-5, split[0].shape)
    check(weld(moved, split[1]), moved, len(vertices))


@pytest.mark.parametrize("own_vertices", [True, False])
def test_doubled_polygons_are_one(own_vertices: bool) -> None:
    vertices, polygons = grid()
    shift = len(vertices) if own_vertices else 0
    both = np.concatenate([vertices, vertices]) if own_vertices else vertices
    found = weld(both, [*polygons, *(polygon[::-1] + shift for polygon in polygons)])
    check(found, both, len(vertices))
    assert len(found.polygons) == len(polygons)


def test_sheets_that_touch_stay_apart() -> None:
    below, polygons = grid()
    above, _ = grid(height=0.3)
    above[24:26, 2] = 0.0
    both = np.concatenate([below, above])
    assert weld(both, [*polygons, *(polygon + len(below) for polygon in polygons)]).copies.size == 0


def test_flat_shaded_sheets_that_touch_stay_apart() -> None:
    below, polygons = grid()
    above, _ = grid(height=0.05)
    above[23:26, 2] = 0.0
    both = np.concatenate([below, above])
    facing = [polygon[::-1] + len(below) for polygon in polygons]  # as lips face each other
    split = flat_shaded(both, [*polygons, *facing])
    check(weld(*split), split[0], len(both))


def test_unit_place_and_numbering_do_not_matter() -> None:
    vertices, polygons = grid()
    split, own = flat_shaded(vertices, polygons)
    rng = np.random.default_rng(2)
    order = rng.permutation(len(split))
    found = weld((split[order] + [5.0, -3.0, 2.0]) * 1000.0, [np.argsort(order)[polygon] for polygon in own])
    same = weld(split, own).leads[order]
    assert len(np.unique(found.leads)) == len(np.unique(np.stack([same, found.leads]), axis=1).T) == len(vertices)


def test_heads_of_others_split_at_their_seams(shared_head: Callable) -> None:
    head = shared_head("ict")
    assert weld(head.vertices, head.polygons).copies.size == 0
    split = flat_shaded(head.vertices, head.polygons)
    found = weld(*split)
    # In flat shading nothing tells a lash that touches the lid from one that is part of it: those places are one.
    together = [set(head.labels[list(was)].tolist()) for was in _merged(found, corners(head.polygons)[0])]
    assert len(together) < 120
    assert all(labels <= {0, 6} and 6 in labels for labels in together)


def test_surfaces_that_meet_at_an_edge_are_one() -> None:
    vertices, polygons = grid(2)
    lash = np.array([[0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.5, 0.2], [0.5, 0.0, 0.2]])
    split = flat_shaded(vertices, polygons)
    both = np.concatenate([split[0], lash])
    check(weld(both, [*split[1], np.arange(4) + len(split[0])]), both, len(vertices) + 2)


def _merged(found: Weld, was: np.ndarray) -> list[set[int]]:
    """Vertices of the whole mesh that became one."""
    groups: dict[int, set[int]] = {}
    for lead, original in zip(found.leads.tolist(), was.tolist(), strict=True):
        groups.setdefault(lead, set()).add(original)
    split = {original for group in groups.values() for original in group}
    assert sum(len(group) for group in groups.values()) == len(split)  # no vertex came apart
    return [group for group in groups.values() if len(group) > 1]


def test_a_pointed_end_keeps_its_two_corners() -> None:
    """A lash tapers to less than a thousandth of the usual edge: its corners are neighbours, not copies."""
    vertices, polygons = grid()
    tip = vertices[-1] + [[0.1, 0.0, 0.0], [0.1, 8e-5, 0.0]]
    polygons = [*polygons, np.array([len(vertices) - 2, len(vertices) - 1, len(vertices) + 1, len(vertices)])]
    found = weld(np.concatenate([vertices, tip]), polygons)
    assert len(found.copies) == 0
