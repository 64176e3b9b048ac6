"""Lid plates that stay where brows slide over them, and muscles that pull along the skin they lie in."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.api import Face
from risorius.face.muscles.insertion import force_density


def lid_goes_along(face: Face) -> float:
    """Brows lowered and drawn together: how far the upper lid's edge goes to the nose, as a share of the brow."""
    frame = np.full(68, np.nan)
    frame[[31 - 1, 32 - 1]] = -60.0
    frame[[33 - 1, 34 - 1]] = -100.0
    frame[[37 - 1, 38 - 1]] = 60.0
    moved = face.pose(frame, drive="exact").positions - face.vertices
    brow = face.points["4.3"]
    edge = face.anatomy.skin.eyes["l"].upper
    middle = face.anatomy.skin.index[edge[len(edge) // 4 : -len(edge) // 4]]
    return float(moved[middle, 0].mean() / (brow.weights @ moved[brow.vertices])[0])


def into_the_skin(face: Face, name: str) -> float:
    """Share of a muscle's pull that goes along the skin's normal."""
    skin = face.anatomy.skin
    pull = force_density(skin, face.muscles[name])
    return float(np.abs((pull * skin.normals).sum(axis=1)).sum() / np.linalg.norm(pull, axis=1).sum())


@pytest.mark.slow
def test_a_frowning_brow_slides_over_the_lid(face: Face) -> None:
    """Scanned frowns hardly take the edge along; without its plate the edge goes a third farther."""
    held, loose = lid_goes_along(face), lid_goes_along(face.without("firmness"))
    assert held < 0.35
    assert loose > 1.3 * held


@pytest.mark.parametrize("name", ["depressor_anguli_oris_l", "depressor_labii_l", "risorius_l"])
def test_superficial_muscles_pull_along_the_skin(face: Face, name: str) -> None:
    assert into_the_skin(face, name) < 1e-9
    assert into_the_skin(face.without("superficial"), name) > 0.03
    assert into_the_skin(face, "zygomaticus_major_l") > 0.1
