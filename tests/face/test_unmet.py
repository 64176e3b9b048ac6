"""A point behind a lid's margin moves its lid all the same, and what is asked and does not show is named with why."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face
from risorius.face.default_head import HeadMesh

CLOSE_L, CLOSE_R, TONGUE, LOOK_L, EAR = 19, 20, 44, 23, 65


def asked(**values: float) -> np.ndarray:
    """(68,) FAPs, silent but for those given as ``f19=1024``."""
    faps = np.full(68, np.nan)
    for name, value in values.items():
        faps[int(name[1:]) - 1] = value
    return faps


def behind_the_margin(head: HeadMesh, *names: str) -> Face:
    """The default head with points of lids or lips half way to a vertex of the lining."""
    whole = Face.from_arrays(head.vertices, head.polygons, head.points, head.parts)
    inside = np.setdiff1d(np.flatnonzero(head.parts == api.Part.SKIN), whole.outer_skin)
    points = dict(head.points)
    for name in names:
        held = whole.points[name]
        vertex = int(held.vertices[np.argmax(held.weights)])
        beside = {int(v) for p in head.polygons if vertex in p for v in p} & set(inside.tolist())
        place = head.vertices[min(beside, key=lambda v: float(np.linalg.norm(head.vertices[v] - held.position)))]
        points[name] = 0.55 * held.position + 0.45 * place
    return Face.from_arrays(head.vertices, head.polygons, points, head.parts)


@pytest.mark.parametrize("drive", ["natural", "exact"])
@pytest.mark.slow
def test_a_lid_point_behind_its_margin_still_closes_the_eye(head: HeadMesh, drive: str) -> None:
    face = behind_the_margin(head, "3.1", "3.2")
    behind = [set(face.points[name].vertices.tolist()) - set(face.outer_skin.tolist()) for name in ("3.1", "3.2")]
    assert all(behind), "the points are held by vertices of the lining"
    pose = face.pose(asked(f19=900.0, f20=900.0), drive=drive)
    np.testing.assert_allclose(pose.achieved[[CLOSE_L - 1, CLOSE_R - 1]], 900.0, rtol=0.25)
    assert not pose.unmet


@pytest.mark.slow
def test_lip_points_behind_their_margin_still_move(head: HeadMesh) -> None:
    face = behind_the_margin(head, "2.6", "2.8")
    pose = face.pose(asked(f8=-150.0, f11=-120.0), drive="exact")
    np.testing.assert_allclose(pose.achieved[[7, 10]], [-150.0, -120.0], rtol=0.05)


@pytest.mark.slow
def test_all_that_is_asked_of_the_default_head_shows() -> None:
    face = api.default_face()
    for word in ("joy", "anger", "fear", "surprise"):
        profile = api.expression(word)
        assert not face.pose(profile.frame(), emotion=profile.weights).unmet, word


@pytest.mark.slow
def test_what_cannot_show_is_named_with_why(head: HeadMesh) -> None:
    kept = np.isin(head.parts, (api.Part.SKIN, api.Part.TEETH_UPPER, api.Part.TEETH_LOWER))
    polygons = [p for p in head.polygons if kept[np.asarray(p)].all()]
    points = {name: point for name, point in head.points.items() if name != "10.1"}
    parts = np.where(kept, head.parts, int(api.Part.OTHER))
    bare = Face.from_arrays(head.vertices, polygons, points, parts)
    wanted = asked(f19=500.0, f23=20000.0, f44=300.0, f65=200.0, f48=10000.0)
    missed = bare.pose(wanted, drive="exact").unmet
    assert sorted(missed) == [LOOK_L, TONGUE, EAR]
    assert missed[LOOK_L] == "the face has no such eyeball"
    assert missed[TONGUE] == "the face has no tongue"
    assert "no feature point 10.1" in missed[EAR]


def test_what_muscles_cannot_do_is_named(head: HeadMesh) -> None:
    missed = api.default_face().pose(asked(f65=200.0), drive="muscles").unmet
    assert missed == {EAR: "check feature point 10.1"}


def test_a_motion_is_judged_by_its_peaks() -> None:
    face = api.default_face()
    stream = np.tile(asked(f3=0.0, f65=0.0), (3, 1))
    stream[1, [2, EAR - 1]] = 200.0
    still = [face.vertices] * 3
    opened = face.pose(stream[1], drive="muscles").positions
    assert sorted(face.unmet(stream, still)) == [3, EAR]
    assert sorted(face.unmet(stream, [face.vertices, face.vertices, opened])) == [EAR]
    assert not face.unmet(np.zeros((2, 68)), still)
