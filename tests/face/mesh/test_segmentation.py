"""Skin, eyeballs, teeth and tongue told apart without labels, held to heads that have them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from risorius.api import Face, Part, expression
from risorius.face.default_head import HeadMesh
from risorius.face.mesh.mouth_parts import add_mouth_parts, mouth_part, split_gums

SKIN, EYEBALL_L, EYEBALL_R, TEETH, TONGUE, MOUTH_BAG, LASHES, SOCKETS, GUMS = range(9)


@pytest.fixture(scope="module")
def derived(shared_head: Callable[[str], Any]) -> Callable[[str], tuple[np.ndarray, np.ndarray, Any]]:
    """Parts derived for a shared head, its labels, and the head."""

    def derive(name: str) -> tuple[np.ndarray, np.ndarray, Any]:
        head = shared_head(name)
        return Face.from_arrays(head.vertices, head.polygons, head.points).parts, head.labels, head

    return derive


def test_the_default_heads_own_parts_are_found(head: HeadMesh) -> None:
    derived = Face.from_arrays(head.vertices, head.polygons, head.points).parts
    np.testing.assert_array_equal(derived, head.parts)


@pytest.mark.parametrize("name", ["ict", "makehuman"])
def test_skin_eyeballs_lashes_and_rows_of_teeth_are_found(derived: Callable[[str], Any], name: str) -> None:
    parts, labels, head = derived(name)
    for label, part in (
        (SKIN, Part.SKIN), (MOUTH_BAG, Part.SKIN), (SOCKETS, Part.SKIN), (EYEBALL_L, Part.EYEBALL_L),
        (EYEBALL_R, Part.EYEBALL_R), (LASHES, Part.OTHER),
    ):  # fmt: skip
        assert (parts[labels == label] == part).all(), (label, part)
    known = head.parts()
    for part in (Part.TEETH_UPPER, Part.TEETH_LOWER):
        assert (known == part).sum() > 50
        assert (parts[known == part] == part).all(), part


def test_a_tongue_of_its_own_is_found(derived: Callable[[str], Any]) -> None:
    parts, labels, _ = derived("makehuman")
    assert (parts[labels == TONGUE] == Part.TONGUE).all()
    assert (parts == Part.TONGUE).sum() == (labels == TONGUE).sum()


def test_a_tongue_that_is_one_surface_with_the_gums_is_found_by_its_points(derived: Callable[[str], Any]) -> None:
    parts, labels, head = derived("ict")
    found, tongue = parts == Part.TONGUE, labels == TONGUE
    assert (found & tongue).sum() >= 0.85 * tongue.sum()
    assert (found & tongue).sum() >= 0.9 * found.sum()
    assert found[[head.points[name] for name in ("6.1", "6.2", "6.3", "6.4")]].all()
    assert (parts[tongue & ~found] == Part.TEETH_LOWER).all()
    unnamed = {name: place for name, place in head.points.items() if not name.startswith("6.")}
    parts = Face.from_arrays(head.vertices, head.polygons, unnamed).parts
    assert (parts[tongue] == Part.TEETH_LOWER).all()


def test_gums_of_both_jaws_in_one_piece_are_split(derived: Callable[[str], Any]) -> None:
    parts, labels, head = derived("ict")
    gums = labels == GUMS
    assert np.isin(parts[gums], [Part.TEETH_UPPER, Part.TEETH_LOWER, Part.TONGUE]).all()
    lips = head.vertices[head.points["2.3"], 2]
    height = head.vertices[:, 2] - lips
    front = head.vertices[:, 1] < head.vertices[head.points["2.3"], 1] + 0.045
    assert (parts[gums & front & (height > 8e-3)] == Part.TEETH_UPPER).all()
    assert np.isin(parts[gums & front & (height < -8e-3)], [Part.TEETH_LOWER, Part.TONGUE]).all()


def ball(centre: tuple[float, float, float], radius: float) -> np.ndarray:
    turn, rise = np.meshgrid(np.linspace(0, 2 * np.pi, 12, endpoint=False), np.linspace(0.1, np.pi - 0.1, 9))
    places = np.stack([np.cos(turn) * np.sin(rise), np.sin(turn) * np.sin(rise), np.cos(rise)], axis=2).reshape(-1, 3)
    return np.asarray(centre) + radius * places


def arch(height: float) -> np.ndarray:
    """A row of teeth: a horseshoe 60 mm wide and 45 deep, 16 high."""
    turn = np.linspace(0.0, np.pi, 15)
    rim = np.column_stack([0.03 * np.cos(turn), np.zeros(15), -0.055 + 0.045 * np.sin(turn)])
    return np.concatenate([rim + np.array([0, height + dy, 0]) for dy in (-0.008, 0.008)])


def test_pieces_in_the_mouth_are_told_by_their_shape() -> None:
    lips = np.zeros(3)
    assert mouth_part(arch(0.009), lips) is Part.TEETH_UPPER
    assert mouth_part(arch(-0.009), lips) is Part.TEETH_LOWER
    assert mouth_part(ball((0.01, 0.006, -0.02), 0.005), lips) is Part.TEETH_UPPER
    assert mouth_part(ball((0.01, -0.006, -0.02), 0.005), lips) is Part.TEETH_LOWER
    tongue = ball((0, 0, 0), 1.0) * [0.02, 0.01, 0.03] + [0.0, -0.006, -0.05]
    assert mouth_part(tongue, lips) is Part.TONGUE
    gums = ball((0, 0, 0), 1.0) * [0.035, 0.022, 0.045] + [0.0, 0.0, -0.05]
    assert mouth_part(gums, lips) is None


def parts_of(head: HeadMesh, vertices: np.ndarray) -> np.ndarray:
    """Parts derived for the default head with its vertices moved; its pupils where they were."""
    points = {n: head.vertices[p] if n in ("3.5", "3.6") and isinstance(p, int) else p for n, p in head.points.items()}
    return Face.from_arrays(vertices, head.polygons, points).parts


def turned_eyes(head: HeadMesh, shaped: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> np.ndarray:
    """The head's vertices with each eyeball's (k, 3) made anew, given the ball's centre."""
    vertices = head.vertices.copy()
    for part in (Part.EYEBALL_L, Part.EYEBALL_R):
        ball = vertices[head.parts == part]
        vertices[head.parts == part] = shaped(ball, (ball.min(axis=0) + ball.max(axis=0)) / 2.0)
    return vertices


@pytest.mark.slow
@pytest.mark.parametrize("radius", [0.005, 0.0235, 0.029])
def test_eyeballs_of_drawn_heads_are_found_and_stay_round(head: HeadMesh, radius: float) -> None:
    def grown(ball: np.ndarray, centre: np.ndarray) -> np.ndarray:
        own = float(np.linalg.norm(ball - centre, axis=1).mean())
        return centre + (ball - centre) * radius / own + np.array([0.0, radius - own, 0.0])

    vertices = turned_eyes(head, grown)
    np.testing.assert_array_equal(parts_of(head, vertices), head.parts)
    face = Face.from_arrays(vertices, head.polygons, head.points)
    posed = face.pose(expression("surprise").frame()).positions
    for part in (Part.EYEBALL_L, Part.EYEBALL_R):
        before, after = (each[head.parts == part] for each in (vertices, posed))
        spans = [np.linalg.norm(each[:, None] - each[::7], axis=2) for each in (before, after)]
        np.testing.assert_allclose(spans[1], spans[0], atol=1e-6)


@pytest.mark.slow
def test_flat_eyes_are_eyes_and_stay_flat(head: HeadMesh) -> None:
    def flat(ball: np.ndarray, centre: np.ndarray) -> np.ndarray:
        front = ball[:, 1].min() + 0.004
        return np.column_stack([ball[:, 0], front + 0.02 * (ball[:, 1] - centre[1]), ball[:, 2]])

    vertices = turned_eyes(head, flat)
    np.testing.assert_array_equal(parts_of(head, vertices), head.parts)
    face = Face.from_arrays(vertices, head.polygons, head.points)
    for eye in face.eyeballs:
        assert eye.iris < 1.2
    posed = face.pose(expression("surprise").frame()).positions
    plate = posed[head.parts == Part.EYEBALL_L] - vertices[head.parts == Part.EYEBALL_L]
    assert np.linalg.norm(plate - plate.mean(axis=0), axis=1).max() < 1e-6


def test_glasses_and_lashes_are_no_eyes(head: HeadMesh) -> None:
    eye = head.vertices[head.parts == Part.EYEBALL_L]
    front, middle = eye[:, 1].min(), (eye.min(axis=0) + eye.max(axis=0)) / 2.0
    lens = middle + 0.02 * np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])
    lens[:, 1] = front - 0.012
    radius = float(np.linalg.norm(eye - middle, axis=1).max())
    turn = np.linspace(-0.8, 0.8, 9)
    lash = np.concatenate([
        middle + reach * radius * np.column_stack([np.sin(turn) * 0.9, -np.cos(turn) * 0.9, np.full(9, height)])
        for reach, height in ((1.01, 0.42), (1.07, 0.5))
    ])  # fmt: skip
    count = len(head.vertices)
    strip = [(count + 4 + k, count + 5 + k, count + 14 + k, count + 13 + k) for k in range(8)]
    polygons = [*head.polygons, (count, count + 1, count + 2, count + 3), *strip]
    parts = Face.from_arrays(np.concatenate([head.vertices, lens, lash]), polygons, head.points).parts
    assert (parts[count:] == Part.OTHER).all()
    np.testing.assert_array_equal(parts[:count], head.parts)


def test_rows_of_teeth_are_told_by_each_other_where_both_lie_above_the_lips(head: HeadMesh) -> None:
    teeth = np.isin(head.parts, (Part.TEETH_UPPER, Part.TEETH_LOWER))
    vertices = head.vertices + np.where(teeth, 0.016, 0.0)[:, None] * np.array([0.0, 0.0, 1.0])
    np.testing.assert_array_equal(parts_of(head, vertices), head.parts)


def test_molars_above_the_lips_belong_to_the_row_that_they_stand_in() -> None:
    """Single teeth of two rows that rise towards the throat, so that the lower molars lie above the lips' line."""
    pieces, expected = [], []
    for upper, height in ((True, 0.006), (False, -0.007)):
        for turn in np.linspace(0.06, np.pi - 0.06, 14):
            place = np.array([0.026 * np.cos(turn), 0.0, -0.05 + 0.04 * np.sin(turn)])
            rise = 0.4 * (-0.01 - place[2])
            pieces.append(ball((0, 0, 0), 0.0035) + place + np.array([0.0, height + rise, 0.0]))
            expected.append(Part.TEETH_UPPER if upper else Part.TEETH_LOWER)
    assert any(mouth_part(piece, np.zeros(3)) is not part for piece, part in zip(pieces, expected, strict=True))
    labels = np.repeat(np.arange(len(pieces)), len(pieces[0]))
    parts = np.full(len(labels), int(Part.OTHER))
    add_mouth_parts(parts, labels, np.concatenate(pieces), np.zeros(3))
    np.testing.assert_array_equal(parts, np.repeat([int(part) for part in expected], len(pieces[0])))


def test_gum_as_wide_as_the_teeth_is_no_tongue(head: HeadMesh) -> None:
    floor = ball((0, 0, 0), 1.0) * [0.023, 0.005, 0.021] + [0.0, -0.019, -0.03]
    narrow = ball((0, 0, 0), 1.0) * [0.013, 0.008, 0.02] + [0.0, -0.012, -0.034]
    pieces = [arch(0.009) * [0.75, 1, 1], arch(-0.009) * [0.75, 1, 1], floor, narrow]
    labels = np.repeat(np.arange(4), [len(piece) for piece in pieces])
    parts = np.full(len(labels), int(Part.OTHER))
    add_mouth_parts(parts, labels, np.concatenate(pieces), np.zeros(3))
    told = [Part(int(parts[labels == number][0])) for number in range(4)]
    assert told == [Part.TEETH_UPPER, Part.TEETH_LOWER, Part.TEETH_LOWER, Part.TONGUE]


def test_both_rows_of_teeth_in_one_piece_are_split(head: HeadMesh) -> None:
    rows = [np.flatnonzero(head.parts == part) for part in (Part.TEETH_UPPER, Part.TEETH_LOWER)]
    joined = [(int(rows[0][0]), int(rows[0][1]), int(rows[1][1]), int(rows[1][0]))]
    parts = Face.from_arrays(head.vertices, [*head.polygons, *joined], head.points).parts
    np.testing.assert_array_equal(parts, head.parts)


def test_gums_without_teeth_of_both_jaws_stay_what_they_were() -> None:
    positions = np.random.default_rng(0).random((6, 3)) * 0.01
    parts = np.array([Part.TEETH_UPPER, Part.TEETH_UPPER, *[Part.OTHER] * 4], dtype=np.int64)
    split_gums(parts, parts == Part.OTHER, positions, [np.array([2, 3, 4, 5])])
    assert (parts[2:] == Part.OTHER).all()
