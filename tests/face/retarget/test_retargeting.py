"""A motion of the muscles on the controls that a rig already has."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Controls, Face, retarget
from risorius.errors import ModelError, ParameterError
from risorius.face.mesh.fap_units import unit_length
from scipy.optimize import lsq_linear


@pytest.fixture(scope="module")
def keys(face: Face) -> Controls:
    """Eight shapes of the default head by name, made of single FAPs."""
    names = ("smile_l", "smile_r", "open", "brow_l", "brow_r", "lid_l", "lid_r", "look")
    numbers = ((12, 6), (13, 7), (3,), (31, 33, 35), (32, 34, 36), (19,), (20,), (23, 24))
    effects = []
    for asked in numbers:
        faps = np.full(68, np.nan)
        faps[np.array(asked) - 1] = 5000.0 if asked == (23, 24) else 250.0
        effects.append(face.pose(faps, drive="exact").positions - face.vertices)
    return Controls(names, np.array(effects), np.zeros(8), np.ones(8))


def test_what_controls_make_is_found_again(face: Face, keys: Controls) -> None:
    given = np.array([[0.0] * 8, [0.3, 0.7, 0.2, 0.0, 0.5, 0.0, 0.0, 0.4]])
    motion = face.vertices + keys.displacement(given)
    found = retarget(face, keys, motion, smooth=0.0)
    assert found.names == keys.names
    assert np.abs(found.values - given).max() < 0.02
    assert found.explained > 0.999
    assert found.off[1] < 0.02 * found.moved[1]
    assert found.missing == []


def test_joy_comes_as_near_as_least_squares_and_nearer_to_faps(face: Face, keys: Controls) -> None:
    joy = api.expression("joy")
    pose = face.pose(joy.frame(), emotion=joy.weights)
    found = retarget(face, keys, [pose.positions], requested=joy.frame())
    skin = face.outer_skin
    effects = keys.effects[:, skin].reshape(8, -1).T
    moved = (pose.positions - face.vertices)[skin].ravel()
    best = lsq_linear(effects, moved, (0.0, 1.0))
    explained = 1.0 - 2.0 * best.cost / (moved @ moved)
    assert found.explained > explained - 0.02
    asked = [number for number in range(3, 69) if not np.isnan(joy.frame()[number - 1])]
    metres = np.array([unit_length(api.fap(number).unit, face.units) for number in asked])
    wrong = []
    for values in (best.x, found.values[0]):
        shown = face.measure(face.vertices + keys.displacement(values))
        wrong.append(float((((shown - pose.achieved)[np.array(asked) - 1] * metres) ** 2).sum()))
    assert wrong[1] < wrong[0]


def test_faps_that_controls_cannot_show_are_named(face: Face, keys: Controls) -> None:
    without = keys.select(np.array([not name.startswith("brow") for name in keys.names]))
    surprise = api.expression("surprise")
    found = retarget(face, without, [face.pose(surprise.frame(), emotion=surprise.weights).positions])
    assert {31, 32, 33, 34, 35, 36} & {short.number for short in found.missing}
    assert any(line.startswith("FAP 31 raise_l_i_eyebrow: ") for line in (short.line for short in found.missing))


def test_a_turned_head_is_set_aside(face: Face, keys: Controls) -> None:
    faps = np.full(68, np.nan)
    faps[48 - 1], faps[49 - 1] = 12000.0, -8000.0
    turned = face.pose(faps, drive="exact").positions
    found = retarget(face, keys, [turned])
    assert found.head_turns[0, :2] == pytest.approx([12000.0, -8000.0], rel=0.02)
    assert np.abs(found.values).max() < 0.02


def test_mirror_images_get_one_value(face: Face, keys: Controls) -> None:
    given = np.array([[0.5, 0.4, 0.0, 0.3, 0.2, 0.0, 0.0, 0.0]])
    motion = face.vertices + keys.displacement(given)
    values = dict(zip(keys.names, retarget(face, keys, motion, symmetric=True).values[0], strict=True))
    assert values["smile_l"] == values["smile_r"] == pytest.approx(0.45, abs=0.03)
    assert values["brow_l"] == values["brow_r"] == pytest.approx(0.25, abs=0.03)


def test_controls_that_do_nothing_or_the_same_are_named_and_not_used(face: Face, keys: Controls) -> None:
    effects = np.concatenate([keys.effects, 0.5 * keys.effects[:1], np.zeros((1, *keys.effects.shape[1:]))])
    more = Controls((*keys.names, "again", "nothing"), effects, np.zeros(10), np.ones(10))
    motion = face.vertices + keys.displacement(np.array([[0.5] + [0.0] * 7]))
    found = retarget(face, more, motion)
    assert found.same == {"again": "smile_l"}
    assert found.still == ("nothing",)
    assert found.names == keys.names


def test_the_opposite_of_a_control_is_used_unless_that_one_goes_both_ways(face: Face, keys: Controls) -> None:
    effects = np.concatenate([keys.effects[:1], -keys.effects[:1]])
    frown = face.vertices - 0.5 * keys.effects[0]
    one_way = retarget(face, Controls(("smile", "frown"), effects, np.zeros(2), np.ones(2)), [frown])
    assert one_way.same == {}
    assert one_way.values[0] == pytest.approx([0.0, 0.5], abs=0.02)
    both_ways = retarget(face, Controls(("smile", "frown"), effects, np.array([-1.0, 0.0]), np.ones(2)), [frown])
    assert both_ways.same == {"frown": "smile"}
    assert both_ways.values[0] == pytest.approx([-0.5], abs=0.02)


def test_controls_that_do_nothing_at_all_are_refused(face: Face, keys: Controls) -> None:
    dead = Controls(("a",), np.zeros_like(keys.effects[:1]), np.zeros(1), np.ones(1))
    with pytest.raises(ModelError, match="none of the controls moves the face"):
        retarget(face, dead, [face.vertices])


def test_wrong_controls_are_refused(face: Face, keys: Controls) -> None:
    with pytest.raises(ParameterError, match="limits of smile_l"):
        Controls(("smile_l",), keys.effects[:1], np.full(1, 0.2), np.ones(1))
    with pytest.raises(ParameterError, match="name each control once"):
        Controls(("a", "a"), keys.effects[:2], np.zeros(2), np.ones(2))
    with pytest.raises(ParameterError, match="effects"):
        retarget(face, Controls(("a",), keys.effects[:1, 1:], np.zeros(1), np.ones(1)), [face.vertices])
    with pytest.raises(ParameterError, match="at least one frame"):
        retarget(face, keys, [])


def test_values_do_not_flicker_more_than_the_motion(face: Face, keys: Controls) -> None:
    rng = np.random.default_rng(1)
    times = np.linspace(0.0, 4.0 * np.pi, 120)[:, None]
    given = np.clip(0.4 + 0.5 * np.sin(times + rng.uniform(0.0, 6.0, 8)), 0.0, 1.2)
    motion = face.vertices + keys.displacement(given)
    found = retarget(face, keys, motion)
    skin = keys.effects[:, face.outer_skin].reshape(8, -1)
    bends = [
        float((np.diff(values, 2, axis=0) @ skin @ skin.T * np.diff(values, 2, axis=0)).sum())
        for values in (given, found.values)
    ]
    assert bends[1] <= bends[0]
    assert found.explained > 0.97
