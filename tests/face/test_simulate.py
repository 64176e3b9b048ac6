"""The moving face: held frames are reached, integrators agree, performances end in their poses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face
from risorius.errors import ParameterError
from risorius.face import meeting_lips
from risorius.face.drive.over_time import stream_plans
from risorius.face.drive.request import Drive
from risorius.face.pose import Poser
from risorius.face.posture import Balance, Effort
from risorius.face.simulate import Simulation
from risorius.physics.elastic import Factor
from risorius.physics.tissue import Tissue, tissue

JOY = api.archetype("joy", 1)


@pytest.fixture(scope="module")
def small(shared_face: Callable[[str], Face]) -> Face:
    """A face of 468 vertices."""
    return shared_face("mediapipe")


def clip_of(strengths: list[float]) -> np.ndarray:
    """(T, 68) joy at these strengths."""
    return np.array(strengths)[:, None] * JOY.frame()


def sudden(face: Face, word: str, frames: int, **options: Any) -> np.ndarray:
    """(T, V, 3) a word asked for all at once from rest, with its name known, at 25 frames a second."""
    profile = api.expression(word)
    asked = np.repeat(profile.frame()[None], frames, axis=0)
    asked[0] *= 0.0
    weights = np.array([[profile.weights.get(name, 0.0) for name in api.ARCHETYPES]] * frames)
    weights[0] = 0.0
    return np.asarray(face.simulate(asked, emotions=weights, **options).positions)


@pytest.mark.parametrize(
    ("head", "word", "drive"),
    [("default", "surprise", "natural"), ("default", "fear", "exact"),
     pytest.param("ict", "joy", "natural", marks=pytest.mark.slow),
     ("makehuman", "anger", "natural"), ("makehuman", "surprise", "exact")],
)  # fmt: skip
def test_a_held_frame_settles_on_its_pose(head: str, word: str, drive: str, any_face: Callable[[str], Face]) -> None:
    """Within 1 % of the largest displacement 0.4 s after a sudden request; contact, folds, eyes and jaw included."""
    face, profile = any_face(head), api.expression(word)
    moving = sudden(face, word, 12, drive=drive)
    pose = face.pose(profile.frame(), drive=drive, emotion=profile.weights).positions
    largest = np.linalg.norm(pose - face.vertices, axis=1).max()
    away = np.linalg.norm(moving - pose, axis=2).max(axis=1)
    assert away[0] > 0.9 * largest
    assert away[1] > 0.05 * largest  # the skin has inertia
    assert away[10:].max() < 0.01 * largest


@pytest.mark.slow
def test_folds_are_those_of_the_moving_skin(any_face: Callable[[str], Face]) -> None:
    """In every frame the fold that the skin has there, not the one that the request would have."""
    face = any_face("ict")
    frames, skins = np.stack([0.0 * JOY.frame(), JOY.frame(), JOY.frame()]), []
    for folds in (True, False):
        poser = Poser(face.anatomy, folds=folds)
        simulation = Simulation(poser, fps=50.0, integrator="implicit", substeps=1, tissue="default")
        moving = simulation.run(stream_plans(frames, Drive.NATURAL, None))
        skins.append([face.anatomy.mesh.head_frame.to_head(p)[face.anatomy.skin.index] for p in moving])
    placed = Poser(face.anatomy).assembly.folds
    for number, (folded, smooth) in enumerate(zip(*skins, strict=True)):
        expected = placed.displacement(smooth - face.anatomy.skin.positions)
        np.testing.assert_allclose(folded - smooth, expected, atol=1e-9)
        assert (np.abs(expected).max() > 0.1e-3) == (number > 0)


def overshoot(moving: np.ndarray, vertex: int) -> float:
    """How far a vertex passes the place where it ends, as a share of its way."""
    way = moving[:, vertex] - moving[0, vertex]
    return float((way @ way[-1]).max() / (way[-1] @ way[-1])) - 1.0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("head", "word", "loose"),
    [("default", "joy", ("5.1", "5.2")), ("default", "surprise", ("2.1", "2.10")), ("makehuman", "joy", ("5.1",)),
     ("makehuman", "surprise", ("2.1",))],
)  # fmt: skip
def test_cheek_and_chin_overshoot_slightly_and_the_forehead_does_not(
    head: str, word: str, loose: tuple[str, ...], any_face: Callable[[str], Face]
) -> None:
    face = any_face(head)
    moving = sudden(face, word, 15)
    for point in loose:
        assert 0.01 < overshoot(moving, face.points[point].vertices[0]) < 0.08
    for point in ("4.1", "4.2", "4.3", "4.4") if word == "surprise" else ():  # joy leaves the brows where they are
        vertex = face.points[point].vertices[0]
        assert np.linalg.norm(moving[-1, vertex] - moving[0, vertex]) > 2e-3
        assert overshoot(moving, vertex) < 0.001


@pytest.mark.slow
def test_loose_tissue_alone_makes_the_cheek_overshoot(face: Face) -> None:
    """What is firmly held everywhere follows without."""
    assert overshoot(sudden(face, "joy", 12, tissue="stiff"), face.points["5.1"].vertices[0]) < 0.005


@pytest.mark.slow
def test_nothing_jitters(face: Face) -> None:
    """Of every path of an expression, less than 0.1 mm is faster than a third of the frame rate."""
    cue = api.Cue(api.expression("joy"), onset=0.3, apex=0.2, offset=0.4)
    moving = np.stack(list(face.performance([cue], fps=50.0)))
    spectrum = np.fft.rfft(moving - moving[0], axis=0)
    spectrum[np.fft.rfftfreq(len(moving), 1 / 50.0) <= 50.0 / 3.0] = 0.0
    trembling = np.linalg.norm(np.fft.irfft(spectrum, n=len(moving), axis=0), axis=2)
    assert np.abs(moving - moving[0]).max() > 8e-3
    assert trembling.max() < 0.1e-3


def test_constant_frames_stay_still(face: Face) -> None:
    clip = face.simulate(clip_of([1.0] * 5))
    assert np.abs(clip.positions - clip.positions[0]).max() < 1e-6
    rest = face.simulate(np.full((3, 68), np.nan))
    assert np.abs(rest.positions - face.vertices).max() < 1e-6


def test_the_emotion_word_matters_to_a_stream(face: Face) -> None:
    sadness = api.expression("sadness")
    frames = np.repeat(sadness.frame()[None], 2, axis=0)
    sad, joyful = np.zeros((2, 2, len(api.ARCHETYPES)))
    for weights, emotion in ((sad, api.Archetype.SADNESS), (joyful, api.Archetype.JOY)):
        weights[:, list(api.ARCHETYPES).index(emotion)] = 1.0
    known = face.simulate(frames, emotions=sad).positions[-1]
    assert np.abs(known - face.pose(sadness.frame(), emotion=sadness.weights).positions).max() < 1e-6
    other = face.simulate(frames, emotions=joyful).positions[-1]
    assert face.measure(known)[11] < face.measure(other)[11] - 50.0


@pytest.mark.slow
def test_finer_steps_converge(small: Face) -> None:
    """Loads, jaw, lids and contact included: 1 % of the motion at two steps a frame, and little order is lost.

    That the skin alone converges to the paper's motion is shown on a small sheet in verification/.
    """
    frames = clip_of([0.0, 0.25, 0.6, 1.0, 1.0])
    *rough, reference = (
        small.simulate(frames, fps=60.0, substeps=n, integrator="implicit").positions for n in (1, 2, 4, 16)
    )
    motion = np.abs(reference - small.vertices).max()
    assert motion > 5e-3
    coarse, medium, fine = (np.abs(positions - reference).max() / motion for positions in rough)
    assert medium < 0.01
    assert medium < 0.35 * coarse
    assert fine < 0.4 * medium


OVERLAPPING = [
    api.Cue(api.expression(word), start=0.4 * i, onset=0.3, apex=0.1, offset=0.3)
    for i, word in enumerate(("joy", "anger", "surprise"))
]


@pytest.mark.slow
def test_a_few_fields_move_the_face_as_every_node_does(face: Face) -> None:
    """Within 1 % of the largest motion at any vertex and frame, where emotions overlap and the jaw drops."""
    quick = np.array(list(face.performance(OVERLAPPING, 25.0)))
    reference = np.array(list(face.performance(OVERLAPPING, 25.0, integrator="implicit", substeps=8)))
    motion = np.linalg.norm(reference - face.vertices, axis=2).max()
    assert motion > 10e-3
    assert np.linalg.norm(quick - reference, axis=2).max() < 0.01 * motion


@pytest.mark.slow
def test_lips_that_press_on_each_other_lose_their_speed(
    shared_face: Callable[[str], Face], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Within 1 % where anger's lips go over into surprise's exactly as asked, and not where contact takes no speed."""
    head = shared_face("makehuman")
    cues = [
        api.Cue(api.expression(word), start=0.1 + 0.35 * i, onset=0.3, apex=0.1, offset=0.3)
        for i, word in enumerate(("joy", "anger", "surprise"))
    ]
    reference = np.array(list(head.performance(cues, 25.0, drive="exact", integrator="implicit", substeps=8)))
    motion = np.linalg.norm(reference - head.vertices, axis=2).max()

    def off() -> float:
        quick = np.array(list(head.performance(cues, 25.0, drive="exact")))
        return float(np.linalg.norm(quick - reference, axis=2).max() / motion)

    assert off() < 0.01
    monkeypatch.setattr(meeting_lips, "PASSED", np.inf)
    assert off() > 0.02


@pytest.mark.slow
@pytest.mark.parametrize("drive", ["exact", "points"])
def test_skin_lags_behind_whatever_moves_it(small: Face, drive: str) -> None:
    """Where the elastic skin answers, and no muscle, it has its inertia too."""
    frames = clip_of([0.0, 0.5, 1.0, 1.0])
    quick, reference = (
        small.simulate(frames, fps=25.0, drive=drive, integrator=name, substeps=n).positions
        for name, n in (("reduced", 2), ("implicit", 8))
    )
    still = np.array([small.pose(frame, drive=drive).positions for frame in frames])
    lag = np.linalg.norm(reference - still, axis=2).max()
    assert lag > 1e-3
    assert np.linalg.norm(quick - reference, axis=2).max() < 0.2 * lag


@pytest.mark.slow
def test_equilibria_are_solved_for_few_frames_only(face: Face, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever the clock says: few solves of a displacement field with a factored matrix for each frame."""
    solved: list[float] = []
    solve = Factor.solve

    def counted(factor: Factor, right: np.ndarray) -> np.ndarray:
        if factor.shape[0] == face.anatomy.skin.vertex_count:
            solved.append(right.shape[1] / 3.0)
        return solve(factor, right)

    face.pose(JOY.frame())
    monkeypatch.setattr(Factor, "solve", counted)
    counts = {}
    for integrator in ("reduced", "implicit"):
        solved.clear()
        frames = len(list(face.performance(OVERLAPPING, 50.0, integrator=integrator)))
        counts[integrator] = sum(solved) / frames
    assert counts["implicit"] > 15.0
    assert counts["reduced"] < 4.0


def test_what_is_held_is_settled_once(small: Face, monkeypatch: pytest.MonkeyPatch) -> None:
    """Contact and correction of a pose that is held for many frames, and a look elsewhere is another pose."""
    asked = clip_of([0.2, 0.6, *[1.0] * 6, 0.5, *[0.0] * 3])
    asked[5:8, 22] = 20.0
    settled = []
    reached_each = Balance.reached_each

    def counting(balance: Balance, efforts: Any, pulled: Any) -> Any:
        settled.append(len(efforts))
        return reached_each(balance, efforts, pulled)

    monkeypatch.setattr(Balance, "reached_each", counting)
    held = small.simulate(asked, integrator="balance").positions
    assert sum(settled) == 6
    monkeypatch.setattr(Effort, "reached_as", lambda *_: False)
    np.testing.assert_allclose(held, small.simulate(asked, integrator="balance").positions, atol=1e-12)


def test_what_comes_before_the_first_frame_can_be_done_bit_by_bit(small: Face) -> None:
    moving = small.performance(OVERLAPPING[:1], 25.0)
    steps = list(moving.prepare())
    assert len(steps) > 10
    assert all(a.fraction <= b.fraction for a, b in pairwise(steps))
    at_once = small.performance(OVERLAPPING[:1], 25.0)
    np.testing.assert_array_equal(np.array(list(moving)), np.array(list(at_once)))


@pytest.mark.slow
def test_the_papers_integrator_moves_the_face_alike(small: Face) -> None:
    """Seeing to contact as often, within 1 % of the motion; a skin that does not bend lets it take long steps."""
    limp, frames = small.without("bending"), clip_of([0.0, 0.5, 1.0])
    paper, implicit = (
        limp.simulate(frames, fps=60.0, substeps=16, integrator=name).positions for name in ("rk2", "implicit")
    )
    motion = np.abs(paper - small.vertices).max()
    assert motion > 5e-3
    assert np.abs(implicit - paper).max() < 0.01 * motion


def test_softer_tissue_lags_more_than_stiff_tissue(small: Face) -> None:
    frames = clip_of([0.0, 1.0, 1.0])
    goal = small.pose(JOY.frame()).positions
    away = {t: np.abs(small.simulate(frames, tissue=t).positions[1] - goal).max() for t in ("stiff", "default")}
    assert away["stiff"] < away["default"]


@pytest.fixture(scope="module")
def surprised(face: Face) -> Callable[[Tissue], np.ndarray]:
    """(11, V, 3) a sudden surprise of a tissue, at 25 frames a second."""
    frames = np.nan_to_num(api.archetype("surprise").frame()) * np.array([0.0, *[1.0] * 10])[:, None]
    return cache(lambda tissue: face.simulate(frames, fps=25.0, substeps=1, tissue=tissue).positions)


@pytest.mark.slow
@pytest.mark.parametrize("figure", [field.name for field in fields(Tissue) if field.name != "description"])
def test_every_figure_of_a_tissue_shapes_the_motion_and_none_what_is_held(
    figure: str, surprised: Callable[[Tissue], np.ndarray]
) -> None:
    """Half as much again of it moves the skin otherwise on the way, by 0.02 mm or more, and not once it is there."""
    usual = surprised(tissue())
    other = surprised(replace(tissue(), **{figure: 1.5 * getattr(tissue(), figure)}))
    apart = np.linalg.norm(other - usual, axis=2).max(axis=1)
    assert apart[:6].max() > 0.02e-3
    assert apart[-1] < 0.01 * np.linalg.norm(usual[-1] - usual[0], axis=1).max()


@pytest.mark.slow
def test_the_thinnest_and_loosest_skin_that_is_allowed_still_comes_to_its_pose(
    surprised: Callable[[Tissue], np.ndarray],
) -> None:
    usual = surprised(tissue())[-1]
    limp = surprised(replace(tissue(), bending_length=3e-3, anchor_length=50e-3))[-1]
    way = np.linalg.norm(usual - surprised(tissue())[0], axis=1).max()
    assert np.linalg.norm(limp - usual, axis=1).max() < 0.01 * way


def test_skin_that_would_buckle_is_refused(small: Face) -> None:
    thin = replace(tissue(), bending_length=2.9e-3)
    with pytest.raises(ParameterError, match=r"bending_length.*0\.003 m or more.*without\('bending'\)"):
        small.simulate(clip_of([0.0, 1.0]), tissue=thin)
    assert small.without("bending").simulate(clip_of([0.0, 0.1]), tissue=thin).fps == 25.0


@pytest.mark.slow
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
