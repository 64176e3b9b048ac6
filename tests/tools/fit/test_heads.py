"""The heads that the finding of feature points is measured on."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from fit.decimate import decimated
from fit.disguises import with_hair
from fit.hard import hard_heads
from fit.heads import SharedHeads, TrueHead
from fit.meshes import subdivided, turned_head
from fit.sides import wrong_sides
from scipy.spatial import cKDTree


@pytest.fixture(scope="module")
def heads(shared: Path) -> SharedHeads:
    """The shared heads."""
    return SharedHeads(shared / "heads")


@pytest.mark.slow
def test_the_reserved_heads_are_no_heads_of_the_other_sets(heads: SharedHeads) -> None:
    reserved = list(heads.reserved())
    assert len(reserved) == 15
    others = [*heads.known(), *heads.second()]
    alike = [(head, other) for other in others for head in reserved if len(head.vertices) == len(other.vertices)]
    assert {head.name for head, _ in alike} == {head.name for head in reserved}
    for head, other in alike:
        apart = np.linalg.norm(head.vertices - other.vertices, axis=1)
        assert np.quantile(apart, 0.9) > 2e-3, (head.name, other.name)


@pytest.mark.slow
def test_their_points_lie_on_their_skin(heads: SharedHeads) -> None:
    for head in heads.reserved():
        for name in ("3.7", "8.3", "9.3"):
            nearest = np.linalg.norm(head.vertices - head.points[name], axis=1).min()
            assert nearest < 4e-3, (head.name, name)


@pytest.mark.slow
def test_hard_heads_keep_their_points_on_their_skin(heads: SharedHeads) -> None:
    names = set()
    for head in hard_heads(heads):
        names.add(head.name)
        if len(head.vertices) > 100_000:
            continue
        assert max(int(np.max(polygon)) for polygon in head.polygons) < len(head.vertices)
        gaps = cKDTree(head.vertices).query(np.array([head.points[name] for name in ("3.7", "9.3", "4.3")]))[0]
        assert gaps.max() < (2e-3 if len(head.vertices) > 3000 else 12e-3), head.name
    assert len(names) == 34


def test_what_is_buried_under_hair_is_no_point(heads: SharedHeads) -> None:
    head = heads.shared("makehuman")
    haired = with_hair(head, heads.skin("makehuman"))
    assert head.points.keys() - haired.points.keys() > {"11.1", "11.4"}
    assert np.abs(haired.vertices - head.vertices).max() > 10e-3
    for name, place in haired.points.items():
        assert np.linalg.norm(place - head.points[name]) < 2e-3, name


@pytest.mark.slow
def test_a_decimated_head_keeps_its_shape(heads: SharedHeads) -> None:
    head = heads.shared("makehuman")
    fewer = decimated(head, 1000)
    assert 950 <= len(fewer.vertices) <= 1050
    gap = cKDTree(subdivided(subdivided(head)).vertices).query(fewer.vertices)[0]
    assert np.quantile(gap, 0.95) < 2e-3


def test_a_subdivided_head_is_the_same_surface(heads: SharedHeads) -> None:
    head = heads.shared("mediapipe")
    finer = subdivided(head)
    assert len(finer.polygons) == sum(len(polygon) for polygon in head.polygons)
    assert _area(finer) == pytest.approx(_area(head))


def _area(head: TrueHead) -> float:
    """Area of flat polygons."""
    total = 0.0
    for polygon in head.polygons:
        corners = head.vertices[np.asarray(polygon)]
        total += float(np.linalg.norm(np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0))) / 2.0
    return total


def test_a_turned_head_keeps_its_shape_and_the_body_its_place(heads: SharedHeads) -> None:
    body = heads.shared("makehuman_body")
    turned = turned_head(body, 20.0)
    for a, b in (("3.7", "3.12"), ("9.3", "10.7"), ("2.1", "11.4")):
        before, after = (np.linalg.norm(x.points[a] - x.points[b]) for x in (body, turned))
        assert after == pytest.approx(before, rel=1e-9)
    feet = body.vertices[:, 2] < 0.4
    np.testing.assert_allclose(turned.vertices[feet], body.vertices[feet], atol=1e-12)
    looks = turned.points["9.3"] - (turned.points["10.7"] + turned.points["10.8"]) / 2.0
    assert np.degrees(np.arctan2(looks[0], -looks[1])) == pytest.approx(20.0, abs=0.1)


def test_a_lip_point_on_the_other_lip_is_counted(heads: SharedHeads) -> None:
    head = heads.shared("ict_narrow")
    assert wrong_sides(head, head.points) == []
    upper = int(np.linalg.norm(head.vertices - head.points["2.6"], axis=1).argmin())
    assert wrong_sides(head, {**head.points, "2.8": upper}) == ["2.8"]
