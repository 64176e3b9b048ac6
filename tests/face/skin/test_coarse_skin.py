"""A dense skin is solved on a share of its vertices, and its face is the one that all of them would have made."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, replace

import numpy as np
import pytest
import risorius.api as api
from risorius.face import anatomy
from risorius.face.skin import coarse
from risorius.face.skin.coarse import MOST, Thinning
from risorius.face.skin.dense import DenseSkin
from risorius.face.skin.outer import OuterSkin
from risorius.physics.mesh import pair_keys
from risorius.physics.split import split
from risorius.polygons import PolygonTable


def dense_face() -> api.Face:
    """The default head with every polygon split: more skin than is solved."""
    head = api.build_default_head()
    once = split(head.polygons, len(head.vertices))
    between = once.matrix.tocoo()
    grown = np.zeros(once.matrix.shape[0], dtype=np.int64)
    grown[between.row] = head.parts[between.col]
    return api.Face.from_arrays(once.matrix @ head.vertices, once.quads, dict(head.points), grown)


#: A limit that the dense face is beyond, and distances that are to its vertices as the real ones are to a scan's.
FEWER = 12_000
NEAREST, WIDENING, FARTHEST = 1.2e-3, 0.1, 4.5e-3
#: The distances that a face gets.
OWN = {name: getattr(coarse, name) for name in ("NEAREST", "WIDENING", "FARTHEST")}


@pytest.fixture(scope="module")
def face() -> Iterator[api.Face]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(anatomy, "MOST", FEWER)
        for name, value in (("NEAREST", NEAREST), ("WIDENING", WIDENING), ("FARTHEST", FARTHEST)):
            patch.setattr(coarse, name, value)
        yield dense_face()


@pytest.fixture(scope="module")
def given(face: api.Face) -> OuterSkin:
    return face.anatomy.given_skin


@pytest.fixture(scope="module")
def thinning(given: OuterSkin) -> Thinning:
    return Thinning(given)


def test_a_dense_skin_is_solved_on_few_of_its_vertices(face: api.Face, given: OuterSkin) -> None:
    assert FEWER < given.vertex_count < MOST
    assert face.anatomy.skin.vertex_count < FEWER / 2
    np.testing.assert_array_equal(given.positions[Thinning(given).kept], face.anatomy.skin.positions)
    assert api.default_face().anatomy.skin is api.default_face().anatomy.given_skin


def test_it_is_the_same_surface(thinning: Thinning, given: OuterSkin) -> None:
    thin = thinning.skin
    triangles = np.stack(list(thin.polygons))
    sides = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    edges, uses = np.unique(pair_keys(sides), return_counts=True)
    assert (uses > 2).mean() < 0.002
    own = PolygonTable.of(given.polygons)
    own_edges = np.unique(pair_keys(np.sort(np.stack([own.loops, own.after], axis=1), axis=1)))
    assert thin.vertex_count - len(edges) + len(triangles) == given.vertex_count - len(own_edges) + len(own)
    assert thin.areas.sum() == pytest.approx(given.areas.sum(), rel=0.03)
    assert (thin.areas > 0.0).all()
    assert (thin.raw_normals * given.raw_normals[thinning.kept]).sum(axis=1).mean() > 0.95


def test_it_is_dense_at_lips_and_lids_and_no_denser_elsewhere(thinning: Thinning) -> None:
    thin = thinning.skin
    for opening in (thin.mouth, *thin.eyes.values()):
        for arc in (opening.upper, opening.lower):
            assert np.linalg.norm(np.diff(thin.positions[arc], axis=0), axis=1).max() < 2.5 * NEAREST
    spacing = np.sqrt(thin.areas)
    assert spacing[thin.mouth.loop].mean() < FARTHEST / 2
    assert FARTHEST < np.percentile(spacing, 90) < 2.0 * FARTHEST


def test_what_is_even_or_linear_is_carried_as_it_is(thinning: Thinning, given: OuterSkin) -> None:
    here, there = thinning.skin.positions, given.positions
    np.testing.assert_allclose(thinning.carry @ np.ones(len(here)), 1.0, atol=1e-9)
    turned = np.array([[0.0, -0.2, 0.1], [0.2, 0.0, 0.0], [-0.1, 0.0, 0.0]])
    off = np.linalg.norm(thinning.carry @ (here @ turned) - there @ turned, axis=1)
    assert np.percentile(off, 99) < 0.1e-3
    np.testing.assert_allclose((thinning.carry @ here)[thinning.kept], here, atol=1e-12)


def test_one_lip_does_not_carry_the_other(thinning: Thinning, given: OuterSkin) -> None:
    upper, lower = thinning.skin.lip_distances
    lifted = np.where(upper < lower, 1.0, 0.0)
    on_lips = (given.lip_edge_distance < 1e-3) & (given.distance_from(given.mouth.upper[[0, -1]]) > 6e-3)
    carried = np.asarray(thinning.carry @ lifted)[on_lips]
    above = given.lip_distances[0][on_lips] < given.lip_distances[1][on_lips]
    assert np.abs(carried - above).max() < 0.02


@pytest.mark.slow
def test_a_dense_face_is_the_one_that_all_its_vertices_make(monkeypatch: pytest.MonkeyPatch) -> None:
    wanted = np.full(68, np.nan)
    wanted[[2, 11, 12, 30, 31]] = 300.0, 100.0, 80.0, 80.0, 80.0
    monkeypatch.setattr(anatomy, "MOST", FEWER)
    thin = dense_face().pose(wanted)
    monkeypatch.setattr(anatomy, "MOST", 10**9)
    whole = dense_face().pose(wanted)
    off = np.linalg.norm(thin.positions - whole.positions, axis=1)
    assert np.median(off) < 0.1e-3
    assert np.percentile(off, 99) < 0.6e-3
    goal = ~np.isnan(wanted)
    np.testing.assert_allclose(thin.achieved[goal], whole.achieved[goal], atol=3.0)


@pytest.mark.slow
def test_at_its_own_distances_poses_are_within_half_a_per_cent(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the largest motion, in the mean square; 99 of 100 vertices within 1.5 %, and all within 6 %."""
    word, poses, nodes = api.expression("joy"), [], []
    for name, value in OWN.items():
        monkeypatch.setattr(coarse, name, value)
    for most in (MOST, FEWER):
        monkeypatch.setattr(anatomy, "MOST", most)
        face = dense_face()
        poses.append(face.pose(word.frame(), emotion=word.weights).positions)
        nodes.append(face.anatomy.skin.vertex_count)
    assert nodes[1] < 0.65 * nodes[0]
    whole, thin = poses
    off = np.linalg.norm(thin - whole, axis=1) / np.linalg.norm(whole - face.vertices, axis=1).max()
    assert np.sqrt((off**2).mean()) < 0.5e-2
    assert np.percentile(off, 99) < 1.5e-2
    assert off.max() < 6e-2


def test_normals_of_a_dense_skin_are_those_that_all_its_vertices_make(given: OuterSkin) -> None:
    assert isinstance(given, DenseSkin)
    own = replace(OuterSkin(**{each.name: getattr(given, each.name) for each in fields(OuterSkin)}), _cache={})
    between = np.degrees(np.arccos(np.clip((given.normals * own.normals).sum(axis=1), -1.0, 1.0)))
    np.testing.assert_allclose(np.linalg.norm(given.normals, axis=1), 1.0)
    assert np.percentile(between, 99) < 15.0
    assert np.median(between) < 1.5


def test_distances_on_the_few_are_those_along_all(thinning: Thinning, given: OuterSkin) -> None:
    for few, every in zip(thinning.skin.lip_distances, given.lip_distances, strict=True):
        assert np.abs(few - every[thinning.kept]).max() < 2.0 * NEAREST
