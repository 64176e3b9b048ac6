"""The skin between brow and lid, held to scans of lowered and of raised inner brows."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from risorius.api import Face
from risorius.face.mechanisms.hood import Hood

MM = 1e-3


def under_the_brow(face: Face, moved: np.ndarray) -> np.ndarray:
    """(k, 3) displacement of the left hood's skin, head space, of the face's positions (V, 3)."""
    frame, skin = face.anatomy.mesh.head_frame, face.anatomy.given_skin
    away = (frame.to_head(moved) - frame.to_head(face.vertices))[skin.index]
    upper, lower = skin.lid_distances("l")
    inner, outer = (skin.points[name][0] for name in ("3.11", "3.7"))
    beside = (skin.positions[:, 0] > inner) & (skin.positions[:, 0] < outer)
    below = skin.positions[:, 1] < skin.points["4.1"][1]
    return np.asarray(away[beside & below & (upper < lower) & (upper > 6.0 * MM)])


@pytest.mark.slow
@pytest.mark.parametrize(("shape", "least"), [("browDown", 0.93), ("browInnerUp", 0.9)])
def test_it_moves_as_scanned(any_face: Callable[[str], Face], shared: Path, shape: str, least: float) -> None:
    face = any_face("ict")
    scans = np.load(shared / "heads" / "ict_expressions.npz")
    both = sum(scans["displacement"][scans["names"].tolist().index(f"{shape}_{side}")] for side in "LR")
    scanned = face.vertices.copy()
    scanned[: len(both)] += both
    wanted = under_the_brow(face, scanned)

    def explained(model: Face) -> float:
        shown = under_the_brow(face, model.pose(face.measure(scanned), drive="exact").positions)
        return 1.0 - float(((shown - wanted) ** 2).sum() / (wanted**2).sum())

    assert explained(face) > least
    assert explained(face.without("hood")) < explained(face) - 0.02


def test_it_holds_between_brow_and_lid_alone(any_face: Callable[[str], Face]) -> None:
    skin = any_face("default").anatomy.skin
    field = np.zeros((1, skin.vertex_count, 3))
    field[..., 1] = skin.positions[:, 0]
    changed = np.abs(Hood(skin).carry(field) - field)[0].max(axis=1) > 1e-9
    assert changed.any()
    assert skin.positions[changed, 1].max() < max(skin.points[name][1] for name in ("4.3", "4.4"))
    assert skin.positions[changed, 1].min() > max(skin.points[name][1] for name in ("3.3", "3.4"))


def test_its_transpose_is_its_transpose(any_face: Callable[[str], Face]) -> None:
    skin = any_face("default").anatomy.skin
    hood, dice = Hood(skin), np.random.default_rng(7)
    fields, loads = dice.normal(size=(2, 2, skin.vertex_count, 3))
    assert np.vdot(hood.carry(fields), loads) == pytest.approx(np.vdot(fields, hood.carry_transposed(loads)), rel=1e-9)


def test_a_brow_that_goes_as_one_takes_its_hood_along(any_face: Callable[[str], Face]) -> None:
    skin = any_face("default").anatomy.skin
    lid, brow = skin.points["3.1"], skin.points["4.3"]
    at = int(np.argmin(np.linalg.norm(skin.positions - (0.3 * lid + 0.7 * brow), axis=1)))
    field = np.zeros((1, skin.vertex_count, 3))
    field[..., 1] = np.where(skin.positions[:, 1] > 0.2 * lid[1] + 0.8 * brow[1], -1.0, 0.0)
    assert field[0, at, 1] == 0.0
    assert Hood(skin).carry(field)[0, at, 1] < -0.7
