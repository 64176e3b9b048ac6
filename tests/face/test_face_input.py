"""What a face refuses: every message names the thing that is wrong."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face, Part
from risorius.errors import ModelError, ParameterError, SolverError
from risorius.face.default_head import HeadMesh

SILENT = np.full(68, np.nan)


def from_head(head: HeadMesh, **changes: Any) -> Face:
    """The default head with some arguments changed."""
    given = {"vertices": head.vertices, "polygons": head.polygons, "points": head.points, "parts": head.parts}
    return Face.from_arrays(**(given | changes))


def swapped(head: HeadMesh, *pairs: tuple[str, str]) -> dict[str, Any]:
    points = dict(head.points)
    for a, b in pairs:
        points[a], points[b] = points[b], points[a]
    return points


def nan_vertices(head: HeadMesh) -> dict[str, Any]:
    vertices = head.vertices.copy()
    vertices[[7, 9], 1] = np.nan, np.inf
    return {"vertices": vertices}


def on_one_line(head: HeadMesh) -> dict[str, Any]:
    return {"points": {name: np.array([0.0, 0.0, 0.01 * i]) for i, name in enumerate(head.points)}}


def far_nose(head: HeadMesh) -> dict[str, Any]:
    return {"points": dict(head.points) | {"9.3": np.array([0.0, -0.4, 0.0])}}


REFUSALS: dict[str, tuple[Callable[[HeadMesh], dict[str, Any]], str]] = {
    "vertices NaN": (nan_vertices, "2 vertices are NaN or infinite, the first is vertex 7"),
    "no vertices": (lambda h: {"vertices": np.zeros((0, 3))}, "the mesh is empty"),
    "flat vertices": (lambda h: {"vertices": h.vertices[:, :2]}, r"shape \(V, 3\)"),
    "no polygons": (lambda h: {"polygons": []}, "no polygons"),
    "two corners": (lambda h: {"polygons": [*h.polygons, (0, 1)]}, "at least three corners"),
    "index too high": (
        lambda h: {"polygons": [(0, 1, len(h.vertices))]},
        r"polygon 0 uses vertex (\d+), but the mesh has \1 vertices",
    ),
    "index negative": (lambda h: {"polygons": [(0, 1, -2)]}, "polygon 0 uses vertex -2"),
    "points missing": (
        lambda h: {"points": {n: p for n, p in h.points.items() if n not in ("8.4", "2.1")}},
        r"lacks the feature points 2\.1, 8\.4",
    ),
    "unknown point": (lambda h: {"points": dict(h.points) | {"8.99": 3}}, r"no such feature point: 8\.99"),
    "point beyond mesh": (lambda h: {"points": dict(h.points) | {"8.3": 10**6}}, "8.3 uses vertex 1000000"),
    "point of two numbers": (lambda h: {"points": dict(h.points) | {"3.1": (0.0, 1.0)}}, "feature point 3.1 must be"),
    "point NaN": (lambda h: {"points": dict(h.points) | {"3.1": (0.0, 1.0, np.nan)}}, "feature point 3.1 must be"),
    "corners swapped": (lambda h: {"points": swapped(h, ("8.3", "8.4"))}, r"8\.3 and 8\.4 are swapped.*left"),
    "eyes swapped": (
        lambda h: {"points": swapped(h, ("3.7", "3.12"), ("3.11", "3.8"))},
        r"3\.7 and 3\.12 are swapped",
    ),
    "lids swapped": (lambda h: {"points": swapped(h, ("3.2", "3.4"))}, r"3\.2 and 3\.4 are swapped.*above"),
    "lips swapped": (lambda h: {"points": swapped(h, ("8.1", "8.2"))}, r"8\.1 and 8\.2 are swapped.*above"),
    "points in line": (on_one_line, "are on one line"),
    "nose off the mesh": (far_nose, r"9\.3 \(nose tip\) is not on the mesh"),
    "parts too few": (lambda h: {"parts": h.parts[:-1]}, "one number per vertex"),
    "parts unknown": (lambda h: {"parts": np.full(len(h.vertices), 9)}, "numbers of Part"),
    "no skin": (lambda h: {"parts": np.full(len(h.vertices), int(Part.OTHER))}, "no skin"),
}


@pytest.mark.parametrize("case", REFUSALS)
def test_a_wrong_mesh_is_refused_by_name(head: HeadMesh, case: str) -> None:
    change, said = REFUSALS[case]
    with pytest.raises(ModelError, match=said):
        from_head(head, **change(head))


def test_all_left_points_given_as_right_ones_are_refused(head: HeadMesh) -> None:
    mirror = {n: f.mirror for n, f in api.FEATURE_POINTS.items() if f.mirror in head.points and n in head.points}
    points = {mirror.get(name, name): point for name, point in head.points.items()}
    with pytest.raises(ModelError, match="swapped"):
        from_head(head, points=points)


def test_missing_pupils_are_placed_in_the_eyes_openings(head: HeadMesh, face: Face) -> None:
    without = from_head(head, points={n: p for n, p in head.points.items() if n not in ("3.5", "3.6")})
    for name in ("3.5", "3.6"):
        found, known = without.points[name].position, face.points[name].position
        assert np.abs(found - known)[[0, 2]].max() < 2e-3  # seen from the front; its depth is not known
    assert without.units.es0 == pytest.approx(face.units.es0, abs=2e-3)


@pytest.mark.parametrize(
    ("frame", "said"),
    [
        (np.zeros(66), "68 values"),
        (np.zeros((2, 68)), "68 values"),
        (np.where(np.arange(68) == 4, np.inf, np.nan), r"FAP 5 must be finite, or NaN where not stated, but it is inf"),
    ],
)
def test_a_wrong_frame_is_refused(face: Face, frame: np.ndarray, said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        face.pose(frame)


@pytest.mark.parametrize(
    ("keywords", "said"),
    [
        ({"drive": "strict"}, "natural, exact, muscles, points"),
        ({"emotion": {"happiness": 1.0}}, "joy, sadness, anger, fear, disgust, surprise"),
        ({"emotion": {"joy": np.nan}}, "emotion joy must be a share"),
        ({"contractions": {"zygomaticus_major_l": 1.5}}, "zygomaticus_major_l must be in 0..1"),
        ({"contractions": {"zygomaticus_major_l": np.nan}}, "zygomaticus_major_l must be in 0..1"),
        ({"contractions": {"biceps": 0.5}}, "must be one of .*zygomaticus_major_l"),
    ],
)
def test_wrong_options_are_refused(face: Face, keywords: dict[str, Any], said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        face.pose(SILENT, **keywords)


@pytest.mark.parametrize("change", [lambda v: v[:-1], lambda v: v[:, :2], lambda v: np.where(v == v[0, 0], np.nan, v)])
def test_wrong_positions_are_not_measured(face: Face, change: Callable[[np.ndarray], np.ndarray]) -> None:
    with pytest.raises(ParameterError, match="positions must"):
        face.measure(change(face.vertices))
    with pytest.raises(ParameterError, match="positions must"):
        face.features(change(face.vertices))


@pytest.mark.parametrize(
    ("frames", "keywords", "said"),
    [
        (np.zeros((0, 68)), {}, "one frame or more"),
        (np.zeros(68), {}, r"shape \(T, 68\)"),
        (np.full((2, 68), np.inf), {}, "FAP 1 of frame 0"),
        (np.zeros((2, 68)), {"fps": 0.0}, "fps must be from 0.001"),
        (np.zeros((2, 68)), {"fps": np.nan}, "fps must be from 0.001"),
        (np.zeros((2, 68)), {"substeps": 0}, "substeps must be 1 or more"),
        (np.zeros((2, 68)), {"integrator": "euler"}, "reduced, balance, implicit, rk2"),
        (np.zeros((2, 68)), {"tissue": "rubber"}, "tissue"),
        (np.zeros((2, 68)), {"drive": "strict"}, "drive"),
        (np.zeros((2, 68)), {"emotions": np.zeros((3, 6))}, r"shape \(2, 6\)"),
        (np.zeros((2, 68)), {"emotions": np.full((2, 6), np.nan)}, "finite strengths"),
    ],
)
def test_wrong_simulations_are_refused(face: Face, frames: np.ndarray, keywords: dict[str, Any], said: str) -> None:
    with pytest.raises((ParameterError, SolverError), match=said):
        face.simulate(frames, **keywords)


def test_nothing_given_is_changed(head: HeadMesh, face: Face) -> None:
    frame = api.archetype("joy", 1).frame()
    before = frame.copy(), face.vertices.copy(), head.parts.copy()
    pose = face.pose(frame)
    pose.positions[:] = 0.0
    for array, kept in zip((frame, face.vertices, head.parts), before, strict=True):
        np.testing.assert_array_equal(array, kept)
