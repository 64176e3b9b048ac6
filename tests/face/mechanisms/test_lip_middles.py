"""The lips' middles, which no FAP names sideways."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.face.drive.lip_middles import lip_middles
from risorius.face.face import Face
from risorius.face.mesh.fap_rows import LIP_MIDDLES

SIDE_FAPS = {6: 200.0, 53: 200.0, 12: 200.0, 59: 200.0}


def sideways(face: Face, faps: np.ndarray) -> float:
    """Largest sideways motion of a lip middle, mm on the template."""
    positions = face.pose(faps, drive="exact").positions
    reader = face.points.matrix(LIP_MIDDLES)
    frame = face.anatomy.mesh.head_frame
    moved = reader @ (frame.to_head(positions) - frame.to_head(face.vertices))
    return float(np.abs(moved[:, 0]).max()) * 1e3


def one_sided(other: float) -> np.ndarray:
    """The left corner up and out, the right one told where to be by a share of the left (+ for the mirror image)."""
    frame = np.full(68, np.nan)
    for number, value in SIDE_FAPS.items():
        frame[number - 1] = value
        frame[number] = other * value
    return frame


def test_one_corner_drawn_aside_leaves_the_middle(face: Face) -> None:
    assert sideways(face, one_sided(0.0)) < 0.8


def test_both_corners_drawn_one_way_take_the_middle_along(face: Face) -> None:
    assert sideways(face, one_sided(-1.0)) > 3.0


def test_a_mouth_drawn_aside_takes_its_middle_as_far_as_the_trailing_corner(face: Face) -> None:
    """Scanned: the leading corner makes 6 mm, the trailing one 15, the lips' middles 14 to 16."""
    frame = np.full(68, np.nan)
    frame[[6 - 1, 53 - 1]], frame[[7 - 1, 54 - 1]] = -220.0, 110.0
    trailing = 220.0 * face.units.mw0 / 1024.0 * 1e3
    assert sideways(face, frame) == pytest.approx(trailing, rel=0.2)


def test_silent_corners_say_nothing_of_the_middle(face: Face) -> None:
    rows = face.anatomy.inverse.rows
    targets, _ = lip_middles(rows, np.full(68, np.nan))
    assert np.isnan(targets).all()
    targets, doubts = lip_middles(rows, one_sided(0.0))
    assert (targets[rows.numbers == 0] == 0.0).all()
    assert np.isnan(targets[rows.numbers > 0]).all()
    assert doubts[-1] == pytest.approx(0.5e-3)


def test_the_hidden_rows_are_no_fap(face: Face) -> None:
    rows = face.anatomy.inverse.rows
    assert 0 not in rows.row_of
    frame = np.arange(68.0)
    assert np.isnan(rows.select(frame)[rows.numbers == 0]).all()
    assert len(rows) == len(face.anatomy.skin_rows) + len(LIP_MIDDLES)
