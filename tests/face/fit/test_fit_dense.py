"""Dense meshes: what is done once for the whole of them is not done again for each place that is looked at."""

from __future__ import annotations

import numpy as np
import pytest
from fit import shapes
from risorius.face.fit.locating import boxes
from risorius.face.fit.locating.head_pose import HeadPose
from risorius.face.fit.locating.regions import by_node
from risorius.face.fit.surface.cloud import Surface, sample, sample_shelves
from risorius.face.fit.surface.shelves import Shelves
from risorius.face.fit.surface.skeleton import net_of
from risorius.progress import run
from scipy.spatial.transform import Rotation


def test_parts_of_a_mesh_know_their_areas(monkeypatch: pytest.MonkeyPatch) -> None:
    surface = Surface.from_polygons(*shapes.rock())
    chosen = np.arange(len(surface.triangles)) % 3 == 0
    plain = Surface(surface.vertices, surface.triangles[chosen], surface.normals)
    expected = sample(plain, 50)
    whole = surface.twice_areas
    np.testing.assert_array_equal(surface.part(chosen).twice_areas, np.linalg.norm(plain.cross(), axis=1))
    monkeypatch.setattr(Surface, "cross", None)
    seen = sample(surface.part(chosen), 50)
    np.testing.assert_array_equal(seen.positions, expected.positions)
    np.testing.assert_array_equal(surface.part(chosen).part(chosen[chosen]).twice_areas, whole[chosen])


def dense_rock() -> Surface:
    """A rock of more triangles than are looked at one by one."""
    vertices, quads = shapes.sphere(220, 260)
    return Surface.from_polygons(vertices * (1.0 + 0.1 * np.sin(5.0 * vertices[:, :1])), quads)


def test_shelves_are_drawn_from_by_their_area() -> None:
    shelf, areas = np.array([2, 0, 2, 1, 0]), np.array([1.0, 2.0, 3.0, 50.0, 4.0])
    shelves = Shelves.of(shelf, 4, areas)
    np.testing.assert_allclose(shelves.areas, [6.0, 50.0, 4.0, 0.0])
    chosen = np.array([True, False, True, True])
    drawn = np.bincount(shelves.drawn(chosen, 1000, np.random.default_rng(0)), minlength=5)
    np.testing.assert_allclose(drawn, 1000.0 * areas * [1, 1, 1, 0, 1] / 10.0, atol=1.0)
    assert len(shelves.drawn(np.arange(4) == 3, 10, np.random.default_rng(0))) == 0


def test_a_box_of_a_dense_mesh_is_seen_without_a_look_at_all_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    surface = dense_rock()
    turn = Rotation.from_euler("xyz", (20.0, 30.0, 40.0), degrees=True).as_matrix()
    pose = HeadPose(turn, turn.T @ np.array([0.0, -0.8, 0.1]), np.full(3, 4.0))
    chosen = boxes.in_box(surface, pose, boxes.HEAD_BOX)
    monkeypatch.setattr(boxes, "in_box", None)
    seen = boxes.box_cloud(surface, pose, boxes.HEAD_BOX, 20_000)
    assert boxes.lies_in_box(seen.positions, pose, boxes.HEAD_BOX).all()
    assert chosen[seen.triangles].all()
    assert len(seen) == pytest.approx(20_000, rel=0.1)
    drawn = np.bincount(seen.triangles, minlength=len(chosen))
    for part in np.array_split(np.flatnonzero(chosen), 8):
        share = surface.twice_areas[part].sum() / surface.twice_areas[chosen].sum()
        assert drawn[part].sum() / len(seen) == pytest.approx(share, abs=0.02)


def test_a_wide_triangle_through_a_box_of_a_dense_mesh_is_seen() -> None:
    rock = dense_rock()
    wide = np.array([[-1.2, -2.0, -1.3], [1.2, -2.0, -1.3], [0.0, -2.0, 1.6]])
    vertices = np.concatenate([rock.vertices, wide])
    surface = Surface.from_polygons(vertices, np.vstack([rock.triangles, len(rock.vertices) + np.arange(3)]))
    pose = HeadPose(np.eye(3), np.array([0.0, -2.0, 0.0]), np.full(3, 6.0))
    seen = boxes.box_cloud(surface, pose, boxes.HEAD_BOX, 5_000)
    assert (seen.triangles == len(surface.triangles) - 1).mean() > 0.5


def test_a_dense_mesh_inside_out_is_put_on_its_shelves_once(monkeypatch: pytest.MonkeyPatch) -> None:
    surface = dense_rock()
    cells = surface.cells
    monkeypatch.setattr(Surface, "cross", None)
    assert surface.flipped().cells is cells
    np.testing.assert_array_equal(surface.flipped().twice_areas, surface.twice_areas)


def test_regions_of_a_dense_mesh_are_drawn_from_the_shelves_of_its_net() -> None:
    surface = dense_rock()
    net = run(net_of(surface))
    shelves = by_node(surface, net)
    np.testing.assert_allclose(shelves.areas.sum(), net.area.sum())
    chosen = net.places[:, 0] > 0.3
    seen = sample_shelves(surface, shelves, chosen, 1_000)
    assert chosen[net.node[surface.triangles[seen.triangles]]].any(axis=1).all()
