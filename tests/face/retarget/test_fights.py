"""Controls that pull against each other are not both on without need, and do not flicker."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Controls, Face, retarget
from risorius.face.retarget.fights import Settled, costs, opposed_pairs
from scipy.optimize import lsq_linear

PAIRS = (("smile_l", "frown_l"), ("smile_r", "frown_r"), ("up_l", "down_l"), ("up_r", "down_r"))


def shape(face: Face, **faps: float) -> np.ndarray:
    """(V, 3) displacement by FAPs, exactly."""
    asked = np.full(68, np.nan)
    for name, value in faps.items():
        asked[api.fap(name).number - 1] = value
    return face.pose(asked, drive="exact").positions - face.vertices


class Fighters(NamedTuple):
    """Keys of the default head and what they do."""

    keys: Controls
    joy: np.ndarray


@pytest.fixture(scope="module")
def fighters(face: Face) -> Fighters:
    """Smile and frown, brow up and down, on both sides, each with a little of its own beside; and the pose of joy."""
    rng, shapes = np.random.default_rng(3), {}
    for side in ("l", "r"):
        shapes[f"smile_{side}"] = shape(
            face, **{f"raise_{side}_cornerlip_o": 250.0, f"stretch_{side}_cornerlip_o": 25.0}
        )
        shapes[f"frown_{side}"] = shape(
            face, **{f"raise_{side}_cornerlip_o": -200.0, f"stretch_{side}_cornerlip_o": 20.0}
        )
        shapes[f"up_{side}"] = shape(face, **{f"raise_{side}_{part}_eyebrow": 200.0 for part in ("i", "m", "o")})
        shapes[f"down_{side}"] = shape(face, **{f"raise_{side}_{part}_eyebrow": -150.0 for part in ("i", "m", "o")})
    shapes["open"] = shape(face, open_jaw=300.0)
    effects = np.array(list(shapes.values()))
    effects *= 1.0 + 0.1 * rng.standard_normal((len(effects), len(face.vertices), 1))
    joy = api.expression("joy")
    moved = face.pose(joy.frame(), emotion=joy.weights).positions - face.vertices
    zeros = np.zeros(len(effects))
    return Fighters(Controls(tuple(shapes), effects, zeros, zeros + 1.0), moved)


def both(names: tuple[str, ...], values: np.ndarray) -> float:
    """The most that the weaker of any pair is on, in values (T, K)."""
    return max(float(values[:, [names.index(a), names.index(b)]].min(axis=1).max()) for a, b in PAIRS)


def test_a_pair_is_not_on_together_where_plain_least_squares_has_it_on(face: Face, fighters: Fighters) -> None:
    keys, skin = fighters.keys, face.outer_skin
    given = np.array([0.7, 0.12, 0.4, 0.0, 0.7, 0.12, 0.4, 0.0, 0.2])
    motion = keys.displacement(given)
    plain = lsq_linear(keys.effects[:, skin].reshape(len(keys), -1).T, motion[skin].ravel(), (0.0, 1.0)).x
    assert both(keys.names, plain[None]) > 0.1
    found = retarget(face, keys, [face.vertices + motion])
    assert both(keys.names, found.values) < 0.03
    left = (keys.displacement(plain) - motion)[skin]
    best = 1.0 - float((left**2).sum() / (motion[skin] ** 2).sum())
    assert found.explained > best - 0.02


def test_a_pair_that_is_needed_stays_on(face: Face, fighters: Fighters) -> None:
    given = np.array([[0.9, 0.8, 0.0, 0.0, 0.9, 0.8, 0.0, 0.0, 0.0]])
    found = retarget(face, fighters.keys, face.vertices + fighters.keys.displacement(given))
    assert found.explained > 0.97
    assert both(fighters.keys.names, found.values) > 0.5


@pytest.mark.slow
def test_a_motion_from_one_to_the_other_neither_jumps_nor_flickers(face: Face, fighters: Fighters) -> None:
    keys, times = fighters.keys, np.linspace(0.0, 2.0 * np.pi, 100)
    over = 0.6 * np.sin(times)
    given = np.zeros((100, len(keys)))
    for one, other in PAIRS:
        given[:, keys.names.index(one)], given[:, keys.names.index(other)] = np.maximum(over, 0), np.maximum(-over, 0)
    given += 0.05 * (1.0 - np.cos(times))[:, None] * np.ones(len(keys))
    found = retarget(face, keys, face.vertices + keys.displacement(given))
    assert both(keys.names, found.values) < 0.05 < both(keys.names, given)
    skin = keys.effects[:, face.outer_skin].reshape(len(keys), -1)
    bends = [np.linalg.norm(np.diff(values, 2, axis=0) @ skin, axis=1) for values in (given, found.values)]
    assert (bends[1] ** 2).sum() <= 1.1 * (bends[0] ** 2).sum()
    assert np.abs(np.diff(found.values, axis=0)).max() < 0.06


def test_pairs_are_told_by_what_they_do_with_their_mirror_images() -> None:
    matrix = np.eye(5)
    matrix[0, 1] = matrix[2, 3] = matrix[0, 4] = -0.7
    matrix = np.minimum(matrix, matrix.T)
    low, high = np.array([0.0, 0.0, 0.0, 0.0, -1.0]), np.ones(5)
    assert opposed_pairs(matrix, low, high, {}) == [[(0, 1)], [(2, 3)]]
    assert opposed_pairs(matrix, low, high, {0: 2, 2: 0, 1: 3, 3: 1}) == [[(0, 1), (2, 3)]]
    downward = np.array([0.0, -1.0, 0.0, 0.0, 0.0]), np.array([1.0, 0.0, 1.0, 1.0, 1.0])
    assert opposed_pairs(np.abs(matrix), *downward, {}) == [[(0, 1)]]


def test_the_weaker_of_a_pair_bears_most_of_its_cost_and_none_where_it_is_alone() -> None:
    moved = np.array([[0.8, 0.2, 0.5], [0.8, 0.0, 0.5], [0.0, 0.0, 0.5]])
    cost = costs([Settled([(0, 1)], 0.1)], moved, np.ones(3))
    assert cost[0, 1] > 3.0 * cost[0, 0] > 0.0
    assert cost[1, 0] == 0.0
    assert (cost[2] == 0.0).all()
    assert (cost[:, 2] == 0.0).all()
