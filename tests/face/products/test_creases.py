"""Creases: full where the emotion squeezes the skin, none at rest; the same in any unit, on either side, in motion."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Creases, Face
from risorius.errors import FormatError, ParameterError
from risorius.face.figures import ANATOMY
from risorius.face.products.crease_table import Look, read_creases

ROWS = {row.name: row for row in read_creases()}
EMOTIONS = ("joy", "surprise", "fear", "anger", "sadness", "disgust")


@pytest.fixture(scope="module")
def creases(face: Face) -> Creases:
    return Creases(face)


@pytest.fixture(scope="module")
def amounts(face: Face, creases: Creases) -> dict[str, dict[str, float]]:
    """How full each crease is in each emotion."""
    found = {}
    for word in EMOTIONS:
        profile = api.expression(word)
        found[word] = creases.amounts(face.pose(profile.frame(), emotion=profile.weights).positions)
    return found


def test_a_resting_face_has_none(face: Face, creases: Creases) -> None:
    assert all(not full.any() for full in creases.fullness(face.vertices).values())
    assert np.abs(creases.strain(face.vertices)).max() < 1e-12


def test_a_turned_and_moved_face_has_none(face: Face, creases: Creases) -> None:
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    assert all(not full.any() for full in creases.fullness(face.vertices @ turn.T + 0.3).values())


@pytest.mark.parametrize(
    ("word", "full", "none"),
    [
        ("joy", ("crows_feet_l", "under_eye_r", "nasolabial_l"), ("glabella", "nasal_root", "bunny_l", "chin")),
        ("surprise", ("forehead",), ("glabella", "nasal_root", "bunny_l", "crows_feet_l", "nasolabial_l")),
        ("fear", ("forehead",), ("nasal_root", "bunny_l", "crows_feet_l")),
        ("anger", ("glabella", "nasal_root"), ("forehead", "cheek_r", "chin")),
        ("disgust", ("bunny_l", "bunny_r", "nasal_root"), ("forehead", "cheek_l", "chin")),
    ],
)
def test_each_emotion_creases_its_own_places(
    word: str, full: tuple[str, ...], none: tuple[str, ...], amounts: dict[str, dict[str, float]]
) -> None:
    assert min(amounts[word][name] for name in full) > 0.25
    assert max(amounts[word][name] for name in none) < 0.1


def test_left_and_right_crease_alike(amounts: dict[str, dict[str, float]]) -> None:
    for found in amounts.values():
        for name in (name for name, row in ROWS.items() if row.paired and row.look is not Look.UNSEEN):
            assert found[name + "_l"] == pytest.approx(found[name + "_r"], abs=1e-6)


def test_half_an_expression_creases_one_side(face: Face, creases: Creases) -> None:
    pose = face.pose(np.full(68, np.nan), drive="muscles", contractions={"llsan_wing_l": 1.0})
    one = creases.amounts(pose.positions)
    assert one["bunny_l"] > 0.5
    assert one["bunny_r"] < 0.05


@pytest.mark.slow
def test_units_and_orientation_change_nothing(face: Face, creases: Creases) -> None:
    turn = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])

    def elsewhere(positions: np.ndarray) -> np.ndarray:
        return np.asarray(100.0 * positions @ turn.T + 7.0)

    points = {name: elsewhere(point.position) for name, point in face.points.items()}
    other = Creases(Face.from_arrays(elsewhere(face.vertices), face.polygons, points, face.parts))
    frame = api.expression("disgust").frame()
    posed = face.pose(frame).positions
    expected, found = creases.fullness(posed), other.fullness(elsewhere(posed))
    for name, full in expected.items():
        np.testing.assert_allclose(found[name], full, atol=1e-6)
    assert max(full.max() for full in found.values()) > 0.5


def test_strain_is_how_much_shorter_the_edges_are(face: Face, creases: Creases) -> None:
    np.testing.assert_allclose(creases.strain(0.9 * face.vertices), 0.1, atol=1e-9)
    with pytest.raises(ParameterError, match="positions"):
        creases.strain(face.vertices[1:])


def test_places_lie_on_the_skin_about_their_lines(face: Face, creases: Creases) -> None:
    positions = creases.head_positions
    for name, crease in creases.creases.items():
        across, presence = crease.places.T
        there = presence > 0.5
        assert there.sum() >= 8, name
        assert not presence[np.setdiff1d(np.arange(len(positions)), creases.index)].any()
        last = len(crease.row.lines) - 1
        assert (across[there] > -1.2).all()
        assert (across[there] < last + 1.2).all()
        assert (positions[there, 2] > -0.08).all(), name
    forehead = creases.creases["forehead"].places
    on = forehead[:, 1] > 0.5
    assert np.corrcoef(forehead[on, 0], positions[on, 1])[0, 1] > 0.95


@pytest.mark.parametrize("head", [pytest.param("ict", marks=pytest.mark.slow), "makehuman"])
def test_other_heads_crease_in_the_same_places(head: str, any_face: Callable[[str], Face]) -> None:
    face = any_face(head)
    creases = Creases(face)
    found = {}
    for word in ("surprise", "anger"):
        profile = api.expression(word)
        found[word] = creases.amounts(face.pose(profile.frame(), emotion=profile.weights).positions)
    assert found["surprise"]["forehead"] > 0.2
    assert found["surprise"]["nasal_root"] < 0.05
    assert found["anger"]["glabella"] > 0.4
    assert found["anger"]["forehead"] < 0.05


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('sides = "joined"', 'sides = "left"'),
        ("onset = 0.06", "onset = 0.9"),
        ('of = "forehead"', 'of = "brow"'),
        ("wander = ", "wanders = "),
    ],
)
def test_a_wrong_table_is_named(old: str, new: str, tmp_path: Path) -> None:
    text = (ANATOMY / "creases.toml").read_text(encoding="utf-8")
    head, _, row = text.partition("[creases.forehead]")
    assert old in row
    path = tmp_path / "creases.toml"
    path.write_text(head + "[creases.forehead]" + row.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(FormatError, match=r"creases\.toml.*creases\.forehead"):
        read_creases(path)
