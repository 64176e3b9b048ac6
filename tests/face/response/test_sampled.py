"""What muscles do over a clip, from a few equilibria; the nearest rotations."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.errors import SolverError
from risorius.face.drive.over_time import cue_plans
from risorius.face.response import sampled
from risorius.face.response.actuators import Amounts
from risorius.face.response.relaxation import SAMPLED
from risorius.face.response.rotations import nearest_rotations
from risorius.progress import run
from scipy.spatial.transform import Rotation


@pytest.fixture(scope="module")
def clip(face: api.Face) -> list[Amounts]:
    """Amounts of joy that goes over into anger."""
    cues = [
        api.Cue(api.expression(word), start=0.6 * i, onset=0.5, apex=0.2, offset=0.5)
        for i, word in enumerate(("joy", "anger"))
    ]
    return [face._poser.balance.effort(plan).amounts for plan in cue_plans(cues, 50.0, api.Drive.NATURAL)]


@pytest.mark.slow
def test_few_equilibria_stand_for_a_clip(face: api.Face, clip: list[Amounts]) -> None:
    relaxation = face._poser.anatomy.relaxation
    found = run(sampled.sampled_pull(relaxation, clip))
    true = np.array([relaxation.pulled(amounts) for amounts in clip])
    largest = np.linalg.norm(true, axis=2).max()
    linear = np.array([relaxation.actuators.low_strain(amounts) for amounts in clip])
    assert len(found.steps) < 0.5 * len(clip)
    off = np.linalg.norm(found.at(np.arange(len(clip))) - true, axis=2).max()
    assert off < 0.004 * largest < 0.2 * np.linalg.norm(linear - true, axis=2).max()
    np.testing.assert_allclose(found.weights[found.steps], np.eye(len(found.steps)), atol=1e-9)
    np.testing.assert_allclose(found.at(found.steps[:1]), true[found.steps[:1]], atol=1e-9)
    np.testing.assert_allclose(found.at(found.steps), true[found.steps], atol=2.0 * SAMPLED)


def test_a_still_clip_takes_one_equilibrium(face: api.Face, clip: list[Amounts]) -> None:
    found = run(sampled.sampled_pull(face._poser.anatomy.relaxation, [clip[0]] * 5))
    assert found.steps.tolist() == [0]
    np.testing.assert_array_equal(found.weights, np.ones((5, 1)))


def test_a_step_that_is_not_solved_is_named(
    face: api.Face, clip: list[Amounts], monkeypatch: pytest.MonkeyPatch
) -> None:
    relaxation = face._poser.anatomy.relaxation

    def fails(*_: Any, **__: Any) -> Any:
        raise SolverError("no equilibrium", residual=1.0)

    monkeypatch.setattr(relaxation, "added", fails)
    with pytest.raises(SolverError, match="no equilibrium") as caught:
        run(sampled.sampled_pull(relaxation, clip))
    assert caught.value.frame == 0


def test_nearest_rotations_are_those_of_singular_values() -> None:
    some = np.random.default_rng(2)
    turns = Rotation.random(60, random_state=3).as_matrix()
    moments = turns @ (np.eye(3) + 0.2 * some.normal(size=(60, 3, 3))) * some.uniform(1e-9, 1e3, size=(60, 1, 1))
    moments[40:] *= np.array([1.0, 1.0, 0.0])  # flat
    moments[50:] *= -1.0  # mirrored
    left, _, right = np.linalg.svd(moments)
    left[np.linalg.det(left @ right) < 0.0, :, 2] *= -1.0
    np.testing.assert_allclose(nearest_rotations(moments), left @ right, atol=1e-8)
    assert nearest_rotations(np.zeros((0, 3, 3))).shape == (0, 3, 3)
