"""Contractions set by hand count in poses and in motion; quick sketches show what poses show."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.errors import ParameterError
from risorius.physics.equilibrium import EquilibriumSolver


def raised(face: api.Face, name: str) -> float:
    """How far a muscle contracted by hand moves the skin of a joyful face, metres."""
    joy = api.expression("joy")
    bare = face.pose(joy.frame(), emotion=joy.weights)
    pulled = face.pose(joy.frame(), emotion=joy.weights, contractions={name: 1.0})
    return float(np.linalg.norm(pulled.positions - bare.positions, axis=1).max())


def test_a_muscle_set_by_hand_is_not_corrected_away(face: api.Face) -> None:
    """Most of what the muscle does without any correction is left in the natural drive."""
    joy = api.expression("joy")
    both = [
        face.pose(joy.frame(), drive="muscles", contractions=hand).positions for hand in ({}, {"frontalis_med_l": 1.0})
    ]
    uncorrected = float(np.linalg.norm(both[1] - both[0], axis=1).max())
    assert raised(face, "frontalis_med_l") > 0.7 * uncorrected


@pytest.mark.slow
def test_contractions_come_and_go_with_their_cue(face: api.Face) -> None:
    joy = api.expression("joy")
    cue = api.Cue(joy, onset=0.2, apex=0.8, offset=0.2)
    hand = {"frontalis_med_l": 1.0}
    *_, last = moved = list(face.performance([cue], 10.0, contractions=[hand]))
    posed = face.pose(joy.frame(), emotion=joy.weights, contractions=hand)
    np.testing.assert_allclose(moved[9], posed.positions, atol=3e-4)
    assert np.abs(last - face.vertices).max() < 0.12 * np.abs(moved[9] - face.vertices).max()  # still on its way
    plain = list(face.performance([cue], 10.0))
    assert np.abs(moved[9] - plain[9]).max() > 2e-3


def test_contractions_must_be_a_set_for_each_cue(face: api.Face) -> None:
    cue = api.Cue(api.expression("joy"), onset=0.2, apex=0.8, offset=0.2)
    with pytest.raises(ParameterError, match="one set for each of the 1 cues"):
        list(face.performance([cue], 10.0, contractions=[{}, {}]))


@pytest.mark.parametrize("drive", list(api.Drive))
def test_a_sketch_is_the_pose_within_a_tenth_of_a_millimetre(face: api.Face, drive: api.Drive) -> None:
    sketcher = face.sketcher()
    for word, activation in (("joy", 2.0), ("joy", 6.5), ("anger", 5.0), ("surprise", 7.0)):
        profile = api.expression(word, activation=activation)
        sketched = sketcher.sketch(profile.frame(), drive=drive, emotion=profile.weights)
        posed = face.pose(profile.frame(), drive=drive, emotion=profile.weights)
        assert np.linalg.norm(sketched.positions - posed.positions, axis=1).max() < 1e-4
        assert sketched.contractions == pytest.approx(dict(posed.contractions))


def test_a_pose_at_rest_is_exact_and_teaches_the_sketches_in_passing(monkeypatch: pytest.MonkeyPatch) -> None:
    solves, solve = list[int](), EquilibriumSolver.solve

    def counted(self: EquilibriumSolver, *force: Any, **options: Any) -> Any:
        solves.append(1)
        return solve(self, *force, **options)

    face = api.default_face().without()
    sketcher, silent = face.sketcher(), np.full(68, np.nan)

    def smile(share: float) -> dict[str, float]:
        return {"zygomaticus_major_l": share}

    posed = sketcher.pose(silent, contractions=smile(0.8)).positions
    np.testing.assert_array_equal(posed, face.pose(silent, contractions=smile(0.8)).positions)
    monkeypatch.setattr(EquilibriumSolver, "solve", counted)
    sketched = {s: sketcher.sketch(silent, contractions=smile(s), passing=True).positions for s in (0.76, 0.79, 0.84)}
    assert not solves
    for share, positions in sketched.items():
        there = face.pose(silent, contractions=smile(share)).positions
        assert np.linalg.norm(positions - there, axis=1).max() < 5e-4


@pytest.mark.slow
def test_preparing_a_face_says_how_far_it_is_and_leaves_nothing_to_work_out() -> None:
    head = api.build_default_head()
    fresh = api.Face.from_arrays(head.vertices, head.polygons, head.points, head.parts)
    assert "inverse" not in vars(fresh.anatomy)
    steps = list(fresh.prepare())
    fractions = [fraction for fraction, _ in steps]
    assert fractions == sorted(fractions)
    assert fractions[0] == 0.0
    assert fractions[-1] < 1.0
    assert all(text for _, text in steps)
    assert {"skin", "actuators", "inverse"} <= set(vars(fresh.anatomy))


@pytest.mark.slow
def test_a_tissue_of_its_own_moves_like_the_bundled_one_of_the_same_figures(face: api.Face) -> None:
    from risorius.physics.tissue import tissue

    cue = api.Cue(api.expression("surprise"), onset=0.1, apex=0.1, offset=0.1)
    named = list(face.performance([cue], 20.0, tissue="aged"))
    given = list(face.performance([cue], 20.0, tissue=tissue("aged")))
    plain = list(face.performance([cue], 20.0))
    np.testing.assert_array_equal(named[3], given[3])
    assert np.abs(named[3] - plain[3]).max() > 1e-5


def test_a_contraction_beyond_its_muscle_is_refused_in_a_performance_too(face: api.Face) -> None:
    cue = api.Cue(api.expression("joy"), onset=0.2, apex=0.8, offset=0.2)
    with pytest.raises(ParameterError, match=r"contraction of mentalis_l.*0\.\.1"):
        list(face.performance([cue], 10.0, contractions=[{"mentalis_l": 1.5}]))
