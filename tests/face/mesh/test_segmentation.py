"""Skin, eyeballs, teeth and tongue told apart without labels, held to heads that have them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from risorius.api import Face, Part
from risorius.face.default_head import HeadMesh
from risorius.face.mesh.mouth_parts import mouth_part, split_gums

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


def test_gums_without_teeth_of_both_jaws_stay_what_they_were() -> None:
    positions = np.random.default_rng(0).random((6, 3)) * 0.01
    parts = np.array([Part.TEETH_UPPER, Part.TEETH_UPPER, *[Part.OTHER] * 4], dtype=np.int64)
    split_gums(parts, parts == Part.OTHER, positions, [np.array([2, 3, 4, 5])])
    assert (parts[2:] == Part.OTHER).all()
