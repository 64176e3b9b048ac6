"""Heads that are turned on their bodies: the ends of a mesh, and the face found at one of them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from fit import shapes
from risorius.face.fit.find import locate_points
from risorius.face.fit.locating import regions
from risorius.face.fit.locating.regions import End, ends, guesses_at_ends
from risorius.face.fit.locating.search import Guess
from risorius.face.fit.surface.cloud import Surface
from risorius.face.fit.surface.skeleton import Net, net_of
from risorius.progress import run
from scipy.spatial.transform import Rotation

#: How far below the chin the neck begins to turn, metres, and how far the head is turned, tilted and leant, degrees.
NECK, TURN = 0.09, (20.0, 10.0, 8.0)


#: Where the arms of a star end, and how thick they are.
TIPS = np.array([[3.0, 0.0, 0.0], [-1.0, 2.5, 0.0], [-1.0, -2.0, 1.0]])
THICK = (0.12, 0.04, 0.08)


def tube(path: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray]:
    """A tube (vertices, quads) of twelve sides round a line (N, 3), open at its ends."""
    way = np.gradient(path, axis=0)
    way /= np.linalg.norm(way, axis=1)[:, None]
    across = np.cross(way, (0.3, 0.2, 0.9))
    across /= np.linalg.norm(across, axis=1)[:, None]
    up = np.cross(way, across)
    turn = 2.0 * np.pi * np.arange(12) / 12
    rings = path[:, None] + radius * (np.cos(turn)[:, None] * across[:, None] + np.sin(turn)[:, None] * up[:, None])
    row, column = np.meshgrid(np.arange(len(path) - 1), np.arange(12), indexing="ij")
    here, beside = row * 12 + column, row * 12 + (column + 1) % 12
    return rings.reshape(-1, 3), np.stack([here, beside, beside + 12, here + 12], axis=-1).reshape(-1, 4)


def joined(pieces: list[tuple[np.ndarray, np.ndarray]]) -> Surface:
    """Pieces (vertices, quads) as one surface."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in pieces)])
    quads = [quads + start for (_, quads), start in zip(pieces, starts, strict=False)]
    return Surface.from_polygons(np.concatenate([vertices for vertices, _ in pieces]), np.concatenate(quads))


def star() -> Surface:
    """Three tubes that meet in the middle, each a piece of its own."""
    shares = np.linspace(0.0, 1.0, 40)[:, None]
    return joined([tube(shares * tip, radius) for tip, radius in zip(TIPS, THICK, strict=True)])


def places_of(found: list[End], net: Net) -> np.ndarray:
    """(E, 3) where ends lie."""
    return np.array([net.places[end.away.argmin()] for end in found])


def test_ends_are_the_tips_of_a_star() -> None:
    net = run(net_of(star()))
    found = ends(net)
    away = np.linalg.norm(places_of(found, net)[:, None] - TIPS, axis=2)
    assert len(found) == len(TIPS)
    assert away.min(axis=0).max() < max(THICK) + 0.1


def test_the_bulkiest_end_comes_first() -> None:
    net = run(net_of(star()))
    found = places_of(ends(net), net)
    away = np.linalg.norm(found[:, None] - TIPS, axis=2)
    assert away.argmin(axis=1).tolist() == [0, 2, 1]


def test_a_limb_that_bends_back_is_an_end_still() -> None:
    turn = np.linspace(0.0, 1.6 * np.pi, 60)
    hook = np.column_stack([np.sin(turn), 1.0 - np.cos(turn), 0.1 * turn])
    straight = np.linspace(0.0, 1.0, 40)[:, None] * np.array([-4.0, 0.0, 0.0])
    net = run(net_of(joined([tube(hook, 0.1), tube(straight, 0.1)])))
    away = np.linalg.norm(places_of(ends(net), net)[:, None] - np.array([hook[-1], straight[-1]]), axis=2)
    assert np.linalg.norm(hook[-1]) < 0.7 * np.linalg.norm(hook, axis=1).max()
    assert away.min(axis=0).max() < 0.25


def test_pieces_hang_together_where_they_are_nearest() -> None:
    shares = np.linspace(0.0, 1.0, 40)[:, None]
    first, second = shares * np.array([1.0, 0.0, 0.0]), shares * np.array([1.0, 0.0, 0.0]) + (1.2, 0.0, 0.0)
    net = run(net_of(joined([tube(first, 0.1), tube(second, 0.1)])))
    start, end = (int(net.places[:, 0].argmin()), int(net.places[:, 0].argmax()))
    assert 2.1 < net.along(np.array([start]))[0, end] < 2.6


def test_a_refusal_looks_at_few_places(monkeypatch: pytest.MonkeyPatch) -> None:
    planes: list[float] = []

    def counted(*arguments: Any, **options: Any) -> list[Guess]:
        planes.append(arguments[2])
        return []

    monkeypatch.setattr(regions, "search_plane", counted)
    hand = Surface.from_polygons(*shapes.hand())
    regions_seen = list(guesses_at_ends(hand, run(net_of(hand))))
    assert 0 < len(regions_seen) <= regions.REGIONS
    assert len(planes) <= regions.REGIONS * regions.PLANES


def turned_head(vertices: np.ndarray, chin: np.ndarray) -> np.ndarray:
    """A body's vertices (V, 3) with its neck twisted."""
    share = np.clip((vertices[:, 2] - chin[2] + NECK) / NECK, 0.0, 1.0)
    share = share**2 * (3.0 - 2.0 * share)
    twist = Rotation.from_euler("zxy", np.outer(share, TURN), degrees=True)
    pivot = np.array([0.0, 0.0, chin[2]])
    return np.asarray(twist.apply(vertices - pivot) + pivot)


@pytest.mark.slow
def test_the_head_of_a_body_may_be_turned(shared: Path) -> None:
    data = np.load(shared / "heads" / "makehuman_body.npz")
    polygons = np.split(data["loops"].astype(np.int64), np.cumsum(data["face_sizes"])[:-1])
    upright = data["vertices"].astype(float)
    known = api.find_points(upright, polygons)
    assert known.topology is not None
    chin = known.positions["2.1"]
    vertices = turned_head(upright, chin)
    nearest = {name: np.linalg.norm(upright - place, axis=1).argmin() for name, place in known.positions.items()}
    truth = {name: vertices[vertex] for name, vertex in nearest.items()}
    assert np.linalg.norm(truth["9.3"] - known.positions["9.3"]) > 0.02
    y_up = 100.0 * vertices[:, [0, 2, 1]] * np.array([1.0, 1.0, -1.0])
    located = locate_points(y_up, polygons)
    back = {name: place[[0, 2, 1]] / 100.0 * np.array([1.0, -1.0, 1.0]) for name, place in located.positions.items()}
    shared_names = [name for name in back.keys() & truth.keys() if not name.startswith(("10.", "11."))]
    errors = [1000.0 * np.linalg.norm(back[name] - truth[name]) for name in shared_names]
    assert located.score < 1.0
    assert np.median(errors) < 4.0


@pytest.mark.slow
@pytest.mark.parametrize("person", ["subj00", "subj01", "subj03"])
def test_a_body_may_hold_its_arms_up(shared: Path, person: str) -> None:
    folder = shared / "heads" / "others" / "mhr"
    if not folder.is_dir():
        pytest.skip("the heads of others are not there")
    body = api.read_mesh(folder / "mhr_body.obj")
    vertices = np.load(folder / f"{person}.npz")["pred_vertices"].astype(float)
    head = api.read_mesh(folder / f"subject{int(person[-1])}_head.obj")
    alone, located = locate_points(head.vertices, head.polygons), locate_points(vertices, body.polygons)
    off = [np.linalg.norm(located.positions[name] - place) for name, place in alone.positions.items()]
    assert located.score < 0.6
    assert np.median(off) < 2e-3
