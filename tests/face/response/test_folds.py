"""Folds: driven by compression, without volume, at rest on the feature points; none where a mesh is too coarse."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face
from risorius.errors import FormatError
from risorius.face.drive.request import Drive, Request
from risorius.face.figures import ANATOMY
from risorius.face.pose import Poser
from risorius.face.response.folds import FoldRow, Folds, PlacedFold, place_fold, read_folds
from risorius.face.skin.outer import OuterSkin

ROWS = {row.name: row for row in read_folds()}
HEADS = ("default", "ict", "makehuman")


def fixed_vertices(face: Face) -> np.ndarray:
    """Outer skin vertices that FAPs are read off."""
    return np.unique(face.anatomy.inverse.matrix.indices // 3)


def folds_of(face: Face) -> Folds:
    return Folds(face.anatomy.skin, face.anatomy.warp, fixed_vertices(face))


def placed(face: Face, name: str) -> PlacedFold:
    """A fold of the table on a face, or a failure that says it is missing."""
    fold = next((fold for fold in folds_of(face).placed if fold.row.name == name), None)
    assert fold is not None, f"{name} is missing"
    return fold


@pytest.fixture(scope="module")
def scan(any_face: Callable[[str], Face]) -> Face:
    """A head fine enough for every fold."""
    return any_face("ict")


def squeezed(skin: OuterSkin, share: float) -> np.ndarray:
    """Displacement that shortens the skin everywhere by a share."""
    return np.asarray(-share * skin.positions)


def test_squeezed_skin_folds_and_stretched_skin_does_not(scan: Face) -> None:
    skin = scan.anatomy.skin
    fold = placed(scan, "nasolabial_l")
    heights = [fold.heights(skin.positions + squeezed(skin, share)).min() for share in (-0.2, 0.0, 0.05, 0.1, 0.3)]
    assert np.abs(heights[:2]).max() == 0.0
    assert heights[2] < -0.1e-3
    assert heights[3] < heights[2]
    assert fold.compression(skin.positions + squeezed(skin, 0.1)).max() == pytest.approx(0.1, abs=1e-9)


@pytest.mark.parametrize("head", HEADS)
def test_a_turned_and_moved_face_has_no_folds(head: str, any_face: Callable[[str], Face]) -> None:
    face = any_face(head)
    skin = face.anatomy.skin
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    moved = skin.positions @ turn.T + 0.1 - skin.positions
    assert np.abs(folds_of(face).displacement(moved)).max() < 1e-9


def test_a_valley_holds_what_its_ridges_hold(scan: Face) -> None:
    skin = scan.anatomy.skin
    fold = placed(scan, "nasolabial_l")
    heights = fold.field @ np.ones(fold.field.shape[1])
    lost = skin.areas @ np.maximum(-heights, 0.0)
    assert abs(skin.areas @ heights) < 0.05 * lost
    assert -heights.min() == pytest.approx(fold.row.depth, rel=0.25)


def test_left_and_right_fold_alike(scan: Face) -> None:
    skin = scan.anatomy.skin
    heights = {}
    for side in "lr":
        fold = placed(scan, f"nasolabial_{side}")
        heights[side] = fold.heights(skin.positions + squeezed(skin, 0.06))
    assert heights["l"].min() == pytest.approx(heights["r"].min(), rel=0.1)
    assert skin.positions[heights["l"].argmin(), 0] > 0.02
    assert skin.positions[heights["r"].argmin(), 0] < -0.02


def test_joy_folds_the_cheek_and_moves_no_feature_point(scan: Face) -> None:
    profile = api.expression("joy")
    smooth, folded = (
        Poser(scan.anatomy, folds=folds).pose(Request(profile.frame(), Drive.NATURAL, profile.weights))
        for folds in (False, True)
    )
    assert np.linalg.norm(folded.positions - smooth.positions, axis=1).max() > 0.5e-3
    assert np.nanmax(np.abs(folded.achieved - smooth.achieved)) < 1e-6


def test_exact_faces_have_no_folds(scan: Face) -> None:
    frame = api.expression("joy").frame()
    smooth, folded = (
        Poser(scan.anatomy, folds=folds).pose(Request(frame, Drive.EXACT)).positions for folds in (False, True)
    )
    assert (folded == smooth).all()


def test_a_mesh_too_coarse_for_a_fold_has_none(scan: Face) -> None:
    skin, row = scan.anatomy.skin, ROWS["nasolabial_l"]
    spared = np.ones(skin.vertex_count)

    def depth(width: float) -> float:
        narrow = FoldRow(row.name, row.line, width, row.depth, row.lean, row.gauge, row.onset, row.full)
        fold = place_fold(skin, scan.anatomy.warp, narrow, spared)
        return 0.0 if fold is None else -float((fold.field @ np.ones(fold.field.shape[1])).min())

    assert depth(1.0e-3) == 0.0
    assert 0.0 < depth(2.2e-3) < 0.8 * depth(5.0e-3)


def test_joined_folds_run_across_the_middle() -> None:
    line = ROWS["forehead_mid"].line
    assert line[0, 0] == -line[-1, 0]
    assert (np.diff(line[:, 0]) > 0).all()
    assert {"nasolabial_l", "nasolabial_r", "glabella_l"} <= set(ROWS)


@pytest.mark.parametrize(
    ("old", "new"),
    [('sides = "pair"', 'sides = "left"'), ("lean = 0.8", "leaning = 0.8"), ("onset = 0.01", "onset = 0.9")],
)
def test_a_wrong_table_is_named(old: str, new: str, tmp_path: Path) -> None:
    text = (ANATOMY / "folds.toml").read_text(encoding="utf-8")
    assert old in text
    path = tmp_path / "folds.toml"
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(FormatError, match=r"folds\.toml.*folds\.nasolabial"):
        read_folds(path)
