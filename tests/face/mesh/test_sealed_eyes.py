"""Eyes that are one surface with their lids: told from the skin, still under a blink, turned by the gaze."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius.api import Face, Part, find_points, read_mesh
from risorius.face.default_head import HeadMesh
from risorius.face.mesh.building import sewn_among

RINGS = (0.12, 0.35, 0.6, 0.85)


def sealed(head: HeadMesh, face: Face, bulge: float = 1.0, flush: bool = False) -> tuple[Face, dict[str, np.ndarray]]:
    """The default head without eyeballs and sockets, its lids closed by parts of balls; the vertices of these.

    `bulge` -1: the same parts of balls, hollow as sockets are. `flush`: the skin round them lies on the balls too.
    """
    skin = face.anatomy.given_skin
    kept = np.isin(np.arange(len(head.vertices)), skin.index)
    polygons = [tuple(p) for p in head.polygons if kept[list(p)].all()]
    vertices, eyes = [head.vertices.copy()], {}
    count = len(head.vertices)
    for side, part in (("l", Part.EYEBALL_L), ("r", Part.EYEBALL_R)):
        own = head.vertices[head.parts == part]
        centre = (own.min(axis=0) + own.max(axis=0)) / 2.0
        upper, lower = skin.index[skin.eyes[side].upper], skin.index[skin.eyes[side].lower]
        loop = [*upper.tolist(), *lower[1:-1].tolist()]
        radius = float(np.linalg.norm(head.vertices[loop] - centre, axis=1).min()) - 0.3e-3
        if flush:
            away = head.vertices - centre
            far = np.linalg.norm(away, axis=1)
            on = np.isin(np.arange(len(far)), skin.index) & (far < 1.35 * radius) & (away[:, 1] < 0.0)
            vertices[0][on] = centre + radius * away[on] / far[on, None]
        pole = own[own[:, 1].argmin()] if bulge > 0 else centre + np.array([0.0, radius, 0.0])
        rings, before = [], loop
        for share in RINGS:
            way = (1.0 - share) * (vertices[0][loop] - centre) + share * (pole - centre)
            rings.append(centre + radius * way / np.linalg.norm(way, axis=1, keepdims=True))
            ring = [count + k for k in range(len(loop))]
            turned = [(before[k - 1], before[k], ring[k], ring[k - 1]) for k in range(len(loop))]
            polygons += turned
            before, count = ring, count + len(loop)
        polygons.append(tuple(before))
        eyes[side] = np.arange(count - len(RINGS) * len(loop), count)
        vertices += rings
    places = {n: vertices[0][p] if isinstance(p, int) else p for n, p in head.points.items() if n[0] not in "67"}
    return Face.from_arrays(np.concatenate(vertices), polygons, places), eyes


def test_what_is_round_between_the_lids_is_an_eye(head: HeadMesh, face: Face) -> None:
    own, eyes = sealed(head, face)
    for side, part in (("l", Part.EYEBALL_L), ("r", Part.EYEBALL_R)):
        assert (own.parts[eyes[side]] == part).mean() > 0.7
        assert np.isin(np.flatnonzero(own.parts == part), eyes[side]).all()
    assert own.sewn == frozenset()


def test_a_hollow_socket_is_skin(head: HeadMesh, face: Face) -> None:
    own, eyes = sealed(head, face, bulge=-1.0)
    assert (own.parts[np.concatenate(list(eyes.values()))] == Part.SKIN).all()


@pytest.mark.parametrize("name", ["ict_narrow", "mediapipe"])
def test_the_lining_of_lids_round_a_hole_and_a_flat_filling_are_skin(
    shared_head: Callable[[str], Any], name: str
) -> None:
    head = shared_head(name)
    assert (Face.from_arrays(head.vertices, head.polygons, head.points).parts == Part.SKIN).all()


@pytest.mark.slow
def test_shut_lids_are_no_eyes(shared: Path) -> None:
    """A scan with its lids shut: they bulge over the balls, and go on as these do beyond their margins."""
    head = read_mesh(shared / "heads" / "others" / "leeperrysmith" / "leeperrysmith.obj")
    found = find_points(head.vertices, head.polygons)
    own = Face.from_arrays(head.vertices, head.polygons, found.positions)
    assert not np.isin(own.parts, (Part.EYEBALL_L, Part.EYEBALL_R)).any()
    assert own.sewn >= {"l", "r"}
    assert sewn_among(head.vertices, head.polygons, found.positions) == own.sewn


def test_a_lid_that_bulges_over_the_eye_is_shut_wherever_its_points_lie(head: HeadMesh, face: Face) -> None:
    """Points placed by proportion, a third of the eye's width apart, on skin that goes on as the ball does."""
    own, _ = sealed(head, face, flush=True)
    assert own.sewn == {"l", "r"}
    assert not np.isin(own.parts, (Part.EYEBALL_L, Part.EYEBALL_R)).any()


@pytest.mark.slow
@pytest.mark.parametrize("number", [0, 1, 3])
def test_the_fold_of_an_upper_lid_is_not_taken_for_the_eye(shared: Path, number: int) -> None:
    """Eyes that are open and one surface with their lids, whose points lay within a fold 2 mm high."""
    head = read_mesh(shared / "heads" / "others" / "mhr" / f"subject{number}_head.obj")
    found = find_points(head.vertices, head.polygons)
    own = Face.from_arrays(head.vertices, head.polygons, found.positions)
    assert not own.sewn & {"l", "r"}
    for upper, lower, inner, outer in (("3.1", "3.3", "3.11", "3.7"), ("3.2", "3.4", "3.8", "3.12")):
        places = {name: own.points[name].position for name in (upper, lower, inner, outer)}
        assert 0.026 < np.linalg.norm(places[inner] - places[outer]) < 0.034
        assert 0.006 < np.linalg.norm(places[upper] - places[lower]) < 0.014


@pytest.mark.slow
def test_lids_close_over_it_and_it_looks_about(head: HeadMesh, face: Face) -> None:
    own, _ = sealed(head, face)
    eye = own.parts == Part.EYEBALL_L
    frame = np.full(68, np.nan)
    frame[[18, 20]] = 500.0
    closed = own.pose(frame, drive="exact")
    assert np.abs(closed.positions[eye] - own.vertices[eye]).max() < 1e-9
    assert closed.achieved[18] == pytest.approx(500.0, abs=60.0)
    frame[:] = np.nan
    frame[22] = 15000.0
    turned = own.pose(frame).positions[eye]
    spans = [np.linalg.norm(each[:, None] - each[::9], axis=2) for each in (own.vertices[eye], turned)]
    np.testing.assert_allclose(spans[1], spans[0], atol=1e-8)
    assert np.abs(turned - own.vertices[eye]).max() > 1e-3
