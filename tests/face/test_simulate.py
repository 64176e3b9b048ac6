"""The moving face: held frames are reached, integrators agree, performances end in their poses."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face

JOY = api.archetype("joy", 1)


@pytest.fixture(scope="module")
def small(shared_face: Callable[[str], Face]) -> Face:
    """A face of 468 vertices."""
    return shared_face("mediapipe")


def clip_of(strengths: list[float]) -> np.ndarray:
    """(T, 68) joy at these strengths."""
    return np.array(strengths)[:, None] * JOY.frame()


@pytest.mark.parametrize("drive", ["natural", "exact"])
def test_a_held_frame_is_reached(face: Face, drive: str) -> None:
    """Half a second after the request has come, every vertex is where the pose has it, within 0.05 mm."""
    clip = face.simulate(clip_of([0.0] + [1.0] * 12), drive=drive)
    assert clip.fps == 25.0
    assert clip.positions.shape == (13, len(face.vertices), 3)
    pose = face.pose(JOY.frame(), drive=drive).positions
    away = np.abs(clip.positions - pose).max(axis=(1, 2))
    assert away[0] > 5e-3
    assert away[1] > 2e-4  # the skin has inertia
    assert away[-1] < 0.05e-3


def test_constant_frames_stay_still(face: Face) -> None:
    clip = face.simulate(clip_of([1.0] * 5))
    assert np.abs(clip.positions - clip.positions[0]).max() < 1e-6
    rest = face.simulate(np.full((3, 68), np.nan))
    assert np.abs(rest.positions - face.vertices).max() < 1e-6


def test_the_emotion_word_matters_to_a_stream(face: Face) -> None:
    sadness = api.archetype("sadness", 0)
    frames = np.repeat(sadness.frame()[None], 2, axis=0)
    weights = np.zeros((2, len(api.ARCHETYPES)))
    weights[:, list(api.ARCHETYPES).index(api.Archetype.SADNESS)] = 1.0
    known = face.simulate(frames, emotions=weights).positions[-1]
    assert np.abs(known - face.pose(sadness.frame(), emotion=sadness.weights).positions).max() < 1e-6
    other = face.simulate(frames, emotions=np.roll(weights, 1, axis=1)).positions[-1]
    assert face.measure(known)[11] < face.measure(other)[11] - 50.0


def test_the_implicit_integrator_converges_to_the_papers(small: Face) -> None:
    """First order: the paper's midpoint rule at its own stable step is the reference, 1 % of the motion the goal."""
    frames = clip_of([0.0, 0.25, 0.6, 1.0, 1.0])
    paper = small.simulate(frames, fps=60.0, integrator="rk2").positions
    motion = np.abs(paper - small.vertices).max()
    assert motion > 5e-3
    coarse, medium, fine = (
        np.abs(small.simulate(frames, fps=60.0, substeps=n).positions - paper).max() for n in (4, 16, 64)
    )
    assert fine < 0.01 * motion
    assert fine < 0.5 * medium < 0.25 * coarse


def test_softer_tissue_lags_more_than_stiff_tissue(small: Face) -> None:
    frames = clip_of([0.0, 1.0, 1.0])
    goal = small.pose(JOY.frame()).positions
    away = {t: np.abs(small.simulate(frames, tissue=t).positions[1] - goal).max() for t in ("stiff", "default")}
    assert away["stiff"] < away["default"]


def test_a_performance_holds_the_pose_of_its_profile_at_the_apex(face: Face) -> None:
    """Between its neighbours too: what the face adds to fear is not contradicted by joy before it."""
    fear = api.archetype("fear", 8)
    cues = [
        api.Cue(JOY, onset=0.1, apex=0.2, offset=0.2),
        api.Cue(fear, start=0.3, onset=0.2, apex=0.6, offset=0.2),
    ]
    moving = np.stack(list(face.performance(cues, fps=25.0)))
    held = moving[round(25 * 1.05)]
    pose = face.pose(fear.frame(), emotion=fear.weights)
    assert np.abs(held - pose.positions).max() < 0.1e-3
    assert np.abs(moving[0] - face.vertices).max() < 1e-3
    assert np.abs(pose.positions - face.vertices).max() > 5e-3


def test_a_simulation_is_given_frame_by_frame(small: Face) -> None:
    frames = clip_of([0.0, 0.5, 1.0])
    lazily = small.simulation(frames)
    first = next(lazily)
    clip = small.simulate(frames)
    np.testing.assert_array_equal(first, clip.positions[0])
    np.testing.assert_allclose(np.stack(list(lazily)), clip.positions[1:], atol=1e-12)
