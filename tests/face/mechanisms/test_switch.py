"""Mechanisms can be left out of a face, and the second paper's bare model still poses."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face, Mechanism
from risorius.errors import ParameterError
from risorius.face.anatomy import BESIDE_THE_PULLS, BESIDE_THE_SKIN, Anatomy
from risorius.face.mechanism import EVERY

SILENT = np.full(68, np.nan)


def test_a_face_has_every_mechanism_until_some_are_left_out(face: Face) -> None:
    assert face.mechanisms == frozenset(Mechanism)
    less = face.without("jaw", Mechanism.BROW)
    assert less.mechanisms == frozenset(Mechanism) - {"jaw", "brow"}
    assert less.without("lids", "jaw").mechanisms == less.mechanisms - {"lids"}
    assert face.mechanisms == frozenset(Mechanism)  # a face never changes
    np.testing.assert_array_equal(less.vertices, face.vertices)
    assert less.anatomy.mesh is face.anatomy.mesh


def test_an_unknown_mechanism_is_answered_with_the_known_ones(face: Face) -> None:
    with pytest.raises(ParameterError, match=r"mechanism must be one of bending, .*platysma.*'gills'"):
        face.without("gills")


def test_additions_and_groups_and_the_papers_own_are_all_there_is() -> None:
    assert {*api.ADDITIONS, *api.MUSCLE_GROUPS, Mechanism.BIPHASIC} == set(Mechanism)
    assert not set(api.ADDITIONS) & set(api.MUSCLE_GROUPS)


@pytest.mark.slow
def test_the_papers_bare_model_poses(face: Face) -> None:
    bare = face.without(*api.ADDITIONS)
    assert {muscle.row.kind for muscle in bare.muscles.values()} == {"linear", "sheet", "sphincter"}
    frame = SILENT.copy()
    frame[[12 - 1, 13 - 1, 31 - 1, 32 - 1]] = 150.0
    for drive in ("natural", "exact", "muscles"):
        pose = bare.pose(frame, drive=drive)
        assert np.isfinite(pose.positions).all()
        assert (pose.achieved[[11, 12, 30, 31]] > 30.0).all()
        assert "jaw_open" not in pose.contractions
    everything = face.pose(frame, drive="exact").achieved
    bare_exact = bare.pose(frame, drive="exact").achieved
    assert abs(everything[11] - 150.0) < 1.0 < abs(bare_exact[11] - 150.0)  # nothing goes the rest of the way


def test_a_face_without_any_muscle_is_moved_by_jaw_lids_and_its_elastic_skin(face: Face) -> None:
    still = face.without(*api.MUSCLE_GROUPS)
    assert not still.muscles
    frame = SILENT.copy()
    frame[[3 - 1, 12 - 1, 13 - 1]] = 300.0, 100.0, 100.0
    np.testing.assert_allclose(still.pose(frame, drive="exact").achieved[[2, 11, 12]], [300.0, 100.0, 100.0], rtol=0.01)


def test_what_is_left_out_cannot_be_contracted_by_hand(face: Face) -> None:
    less = face.without("lids", "jaw", "corners")
    for name in ("orbicularis_oculi_upper_l", "jaw_open", "zygomaticus_major_l"):
        with pytest.raises(ParameterError, match="muscle must be one of"):
            less.pose(SILENT, drive="muscles", contractions={name: 0.5})


#: Mechanisms that no muscle's pull depends on, and those that the skin's own answer does not depend on, either.
OF_POSES, OF_PULLS = BESIDE_THE_PULLS - frozenset(api.MUSCLE_GROUPS), BESIDE_THE_SKIN - BESIDE_THE_PULLS


@pytest.mark.slow
@pytest.mark.parametrize("lost", [OF_POSES, OF_PULLS, {Mechanism.BROW}], ids=["poses", "pulls", "muscles"])
def test_what_a_lesser_face_takes_from_the_whole_one_is_what_it_would_build(face: Face, lost: set[Mechanism]) -> None:
    frame = SILENT.copy()
    frame[[3 - 1, 12 - 1, 13 - 1, 31 - 1, 61 - 1]] = 200.0, 150.0, 120.0, 100.0, 60.0
    anew = Face(face.vertices, face.polygons, Anatomy(face.anatomy.mesh, EVERY - lost))
    taken, built = (one.pose(frame).positions for one in (face.without(*lost), anew))
    np.testing.assert_allclose(taken, built, rtol=0.0, atol=1e-9)
