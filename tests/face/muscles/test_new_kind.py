"""A kind of muscle of one's own is a dataclass with its pull, a line among the kinds and a row in a table."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from risorius.api import Face
from risorius.face.muscles import table
from risorius.face.muscles.ellipse import EllipseRow
from risorius.face.muscles.figures import Angle
from risorius.face.muscles.insertion import force_density
from risorius.face.muscles.kinds import KINDS
from risorius.face.muscles.placement import place_muscles
from risorius.face.skin.outer import OuterSkin

TABLE = """
mechanism = "corners"
[muscles.eddy]
title = "eddy round the corner"
kind = "eddy"
au = ""
sides = "pair"
region = "all"
centre = { point = "8.3", offset = [0, 0, 0] }
radii_mm = [20, 15]
lead_deg = 90
prior_mm = 5
amplitude_mm = 8
"""


@dataclass(frozen=True, kw_only=True, eq=False)
class EddyRow(EllipseRow):
    """Turns skin round its centre; `lead` is the angle between the way to the centre and the pull."""

    kind: ClassVar[str] = "eddy"

    lead: Angle

    def pull(self, skin: OuterSkin) -> np.ndarray:
        """Round the centre as seen from the front, inwards on the subject's left."""
        radius, depth = self.elliptic_radius(skin.positions)
        away = skin.positions - self.centre
        turn = self.side * self.lead
        across = np.cos(turn) * away[:, 0] - np.sin(turn) * away[:, 1]
        up = np.sin(turn) * away[:, 0] + np.cos(turn) * away[:, 1]
        strength = np.exp(-(radius**2) - depth**4)
        return np.asarray(strength[:, None] * np.stack([across, up, np.zeros(len(up))], axis=1))


def test_a_kind_of_ones_own_is_read_placed_and_pulls_on_both_sides(
    face: Face, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(TABLE, encoding="utf-8")
    monkeypatch.setattr(table, "KINDS", {**KINDS, EddyRow.kind: EddyRow})
    rows = table.read_muscles(path)
    assert rows["eddy"].lead == pytest.approx(np.pi / 2.0)  # type: ignore[attr-defined]
    left, right = place_muscles(rows, face.anatomy.warp)
    assert (left.name, right.name) == ("eddy_l", "eddy_r")
    skin = face.anatomy.skin
    np.testing.assert_allclose(left.row.centre * [-1, 1, 1], right.row.centre, atol=1e-5)  # type: ignore[attr-defined]
    for muscle in (left, right):
        force = force_density(skin, muscle)
        out = muscle.side * (skin.positions[:, 0] - muscle.row.centre[0])  # type: ignore[attr-defined]
        strong = np.linalg.norm(force, axis=1) > 0.5 * np.linalg.norm(force, axis=1).max()
        beside = strong & (out > 5e-3)
        assert beside.any()
        assert (force[beside, 1] > 0.0).all()  # up outside the corner, on either side
