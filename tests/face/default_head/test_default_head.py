"""The default head: a sound, symmetric mesh whose points obey the standard."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from risorius.errors import ModelError
from risorius.face.default_head import HeadMesh, build_default_head
from risorius.face.default_head.brows import front_surface
from risorius.face.default_head.figures import PointFigures, read_figures
from risorius.face.default_head.folding import folding_skin
from risorius.face.default_head.points import skin_points
from risorius.face.mesh.parts import Part

MIRROR = np.array([-1.0, 1.0, 1.0])
# Places in a triangle, dense enough to find a chord cutting into a ball.
TRIANGLE = np.array([[1 - a - b, a, b] for a in np.linspace(0, 1, 9) for b in np.linspace(0, 1 - a, 9)])


@pytest.fixture(scope="module")
def head() -> HeadMesh:
    return build_default_head()


def quads_of(head: HeadMesh, *parts: Part) -> np.ndarray:
    quads = np.array(head.polygons)
    return quads[np.isin(head.parts[quads[:, 0]], parts)]


def directed_edges(quads: np.ndarray) -> list[tuple[int, int]]:
    return [(int(q[k]), int(q[(k + 1) % 4])) for q in quads for k in range(4)]


def splits(quads: np.ndarray) -> np.ndarray:
    """Both ways of cutting every quad into triangles, (4 F, 3)."""
    return np.concatenate([quads[:, c] for c in ([0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3])])


def samples(head: HeadMesh, quads: np.ndarray) -> np.ndarray:
    corners = head.vertices[splits(quads)]
    return np.einsum("sk,nkd->nsd", TRIANGLE, corners).reshape(-1, 3)


def test_arrays_agree_and_every_vertex_is_used(head: HeadMesh) -> None:
    assert np.isfinite(head.vertices).all()
    quads = np.array(head.polygons)
    assert quads.shape == (len(head.polygons), 4)
    assert np.array_equal(np.unique(quads), np.arange(len(head.vertices)))
    assert all(len(set(q)) == 4 for q in head.polygons)
    assert np.array_equal(np.unique(head.material_index), np.arange(len(head.materials)))


def test_no_quad_joins_two_parts_and_skin_comes_first(head: HeadMesh) -> None:
    of_quads = head.parts[np.array(head.polygons)]
    assert (of_quads == of_quads[:, :1]).all()
    skin = int(np.sum(head.parts == Part.SKIN))
    assert (head.parts[:skin] == Part.SKIN).all()
    assert set(np.unique(head.parts)) == set(Part) - {Part.SKULL}


def test_winding_is_consistent_and_the_mesh_manifold(head: HeadMesh) -> None:
    edges = directed_edges(np.array(head.polygons))
    assert len(set(edges)) == len(edges)


def test_skin_is_open_at_the_neck_and_behind_the_lids_only(head: HeadMesh) -> None:
    edges = set(directed_edges(quads_of(head, Part.SKIN)))
    border = {a for a, b in edges if (b, a) not in edges}
    expected = [head.groups[name] for name in ("neck_rim", "lid_fold_l", "lid_fold_r")]
    assert border == set(np.concatenate(expected).tolist())


@pytest.mark.parametrize(
    "part", [Part.EYEBALL_L, Part.EYEBALL_R, Part.TEETH_UPPER, Part.TEETH_LOWER, Part.TONGUE], ids=lambda p: p.name
)
def test_inner_parts_are_closed_and_wound_outward(head: HeadMesh, part: Part) -> None:
    quads = quads_of(head, part)
    edges = set(directed_edges(quads))
    assert all((b, a) in edges for a, b in edges)
    corners = head.vertices[quads] - head.vertices[quads].mean(axis=(0, 1))
    volume = sum(np.sum(corners[:, 0] * np.cross(corners[:, a], corners[:, b])) / 6.0 for a, b in ((1, 2), (2, 3)))
    assert volume > 1e-6


def test_skin_is_wound_outward(head: HeadMesh) -> None:
    """Enclosed volume, the neck closed by its plane: the mouth bag is folded in, so the sign needs no care there."""
    corners = head.vertices[quads_of(head, Part.SKIN)] - head.vertices[head.groups["neck_rim"]].mean(axis=0)
    volume = sum(np.sum(corners[:, 0] * np.cross(corners[:, a], corners[:, b])) / 6.0 for a, b in ((1, 2), (2, 3)))
    assert 3e-3 < volume < 5e-3  # a head without its neck holds about 4 litres


def test_both_halves_are_exact_mirror_images(head: HeadMesh) -> None:
    assert np.array_equal(head.mirror[head.mirror], np.arange(len(head.mirror)))
    assert np.array_equal(head.vertices[head.mirror], head.vertices * MIRROR)
    rolled = {tuple(np.roll(q, k)) for q in head.polygons for k in range(4)}
    mirrored = head.mirror[np.array(head.polygons)][:, ::-1]
    assert all(tuple(q) in rolled for q in mirrored.tolist())
    swapped = {Part.EYEBALL_L: Part.EYEBALL_R, Part.EYEBALL_R: Part.EYEBALL_L}
    expected = [swapped.get(Part(p), Part(p)) for p in head.parts]
    assert np.array_equal(head.parts[head.mirror], expected)


def test_every_figure_is_exactly_a_vertex(head: HeadMesh) -> None:
    for name, position in read_figures().nodes.items():
        assert np.array_equal(head.vertices[head.figures[name]], position), name


def test_the_surface_carries_what_the_cage_carries(head: HeadMesh) -> None:
    """Weights authored on the cage reach the skin by the matrix that carries the cage itself."""
    skin = folding_skin(read_figures())
    assert np.allclose(skin.cage_matrix @ np.ones(len(skin.cage.names)), 1.0)
    assert np.array_equal(skin.vertices, head.vertices[: len(skin.vertices)])


@pytest.mark.parametrize("side", ["l", "r"])
def test_eyeballs_never_pierce_the_lids(head: HeadMesh, side: str) -> None:
    quads = quads_of(head, Part.SKIN)
    near = np.isin(quads, np.concatenate([head.groups[f"lid_cover_{side}"], head.groups[f"eyelid_{side}"]])).any(axis=1)
    centre = head.landmarks[f"eyeball_{side}"]
    ball = head.vertices[head.parts == (Part.EYEBALL_L if side == "l" else Part.EYEBALL_R)]
    radius = np.linalg.norm(ball - centre, axis=1).max()
    assert np.linalg.norm(samples(head, quads[near]) - centre, axis=1).min() > radius


def test_the_eyeball_shows_between_the_lids(head: HeadMesh) -> None:
    """The lid opening is filled: nowhere can one look past the ball into the head."""
    centre, margin = head.landmarks["eyeball_l"], head.vertices[head.groups["lid_margin_l"]]
    radius = np.linalg.norm(head.position("3.5") - centre)
    assert (np.linalg.norm((margin - centre)[:, [0, 2]], axis=1) < radius).all()


def test_lids_have_a_rim_of_the_stated_thickness(head: HeadMesh) -> None:
    """Anatomy: a lid margin is about 2 mm thick; at the canthi it thins out."""
    centre = head.landmarks["eyeball_l"]
    outer, inner = (head.vertices[head.groups[name]] - centre for name in ("lash_line_l", "lid_margin_l"))
    thickness = np.linalg.norm(outer, axis=1) - np.linalg.norm(inner, axis=1)
    assert thickness.min() > -0.1e-3
    assert 1.0e-3 < thickness[0] < 2.7e-3  # medial canthus
    assert 1.0e-3 < thickness[8] < 2.7e-3  # upper lid
    assert 1.0e-3 < thickness[24] < 2.7e-3  # lower lid


def test_teeth_and_tongue_stay_behind_the_closed_lips(head: HeadMesh) -> None:
    inner = np.isin(head.parts, (Part.TEETH_UPPER, Part.TEETH_LOWER, Part.TONGUE))
    foot, _ = front_surface(folding_skin(read_figures()), head.vertices[inner][:, [0, 2]])
    assert (head.vertices[inner, 1] - foot[:, 1]).min() > 2e-3


def test_brows_rise_out_of_the_skin(head: HeadMesh) -> None:
    """Inner brow vertices lie in front of the skin, border vertices under it, seen along +Y at the same place."""
    quads = quads_of(head, Part.OTHER)
    edges = set(directed_edges(quads))
    border = np.unique([a for a, b in edges if (b, a) not in edges])
    left = head.groups["brow_l"]
    foot, _ = front_surface(folding_skin(read_figures()), head.vertices[left][:, [0, 2]])
    height = foot[:, 1] - head.vertices[left, 1]
    sunk = np.isin(left, border)
    assert height[sunk].max() < -0.1e-3
    assert height[~sunk].min() > 0.05e-3
    assert height[~sunk].max() < 1.2e-3


def test_front_quads_face_forward_and_are_not_folded(head: HeadMesh) -> None:
    """No quad of the visible face is folded: its four corner normals agree."""
    quads = quads_of(head, Part.SKIN)
    names = ["mouth_bag", *(f"{name}_{side}" for name in ("lid_cover", "ear", "nostril") for side in "lr")]
    hidden = np.concatenate([head.groups[name] for name in names])
    open_face = quads[~np.isin(quads, hidden).any(axis=1)]
    p = head.vertices[open_face]
    corner = np.stack([np.cross(p[:, (k + 1) % 4] - p[:, k], p[:, k - 1] - p[:, k]) for k in range(4)], axis=1)
    corner /= np.linalg.norm(corner, axis=2, keepdims=True)
    mean = corner.mean(axis=1)
    mean /= np.linalg.norm(mean, axis=1, keepdims=True)
    agreement = np.einsum("fkd,fd->fk", corner, mean).min(axis=1)
    assert agreement.min() > 0.4
    assert np.percentile(agreement, 5) > 0.95


def test_all_84_points_are_there(head: HeadMesh, shared: Path) -> None:
    with open(shared / "facts" / "fdp_points.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert set(head.points) == {row["feature_point"] for row in rows}
    for row in rows:
        x = head.position(row["feature_point"])[0]
        assert {"L": x > 1e-3, "R": x < -1e-3, "M": abs(x) < 1e-9}[row["side"]], row["feature_point"]
        if row["mirror_point"]:
            other = head.position(row["mirror_point"])
            assert np.allclose(other, head.position(row["feature_point"]) * MIRROR, atol=1e-12)


def test_points_stand_in_the_order_of_the_standard(head: HeadMesh) -> None:
    z = {name: head.position(name)[2] for name in head.points}
    for column in (
        ("11.4", "11.1", "9.12", "9.3", "9.15", "8.1", "2.2", "8.2", "2.10", "2.1"),
        ("4.3", "3.13", "3.1", "3.5", "3.3", "3.9", "5.3", "5.1"),
        ("9.8", "9.10"),
        ("9.11", "9.9"),
        ("10.1", "10.3", "10.5"),
    ):
        heights = [z[name] for name in column]
        assert heights == sorted(heights, reverse=True), column


def test_lip_points_lie_halfway_on_their_own_lip(head: HeadMesh) -> None:
    for halfway, corner in (("2.6", "2.4"), ("2.8", "2.4"), ("8.5", "8.3"), ("8.7", "8.3")):
        assert head.position(halfway)[0] == pytest.approx(0.5 * head.position(corner)[0], abs=0.1e-3)
    contact = head.groups["lip_contact"].tolist()
    place = [contact.index(head.points[name]) for name in ("2.2", "2.6", "2.4", "2.8", "2.3", "2.9", "2.5", "2.7")]
    assert place == sorted(place)
    border = head.groups["vermilion_border"].tolist()
    place = [
        border.index(head.points[name])
        for name in ("8.1", "8.10", "8.5", "8.3", "8.7", "8.2", "8.8", "8.4", "8.6", "8.9")
    ]
    assert place == sorted(place)


def test_face_units_are_those_of_an_adult(head: HeadMesh) -> None:
    """Ranges: adult means plus and minus about three standard deviations of the usual facial measurements."""
    p = head.position
    assert 0.008 < p("3.1")[2] - p("3.3")[2] < 0.014  # IRISD0
    assert 0.055 < p("3.5")[0] - p("3.6")[0] < 0.072  # ES0
    assert 0.040 < p("3.5")[2] - p("9.15")[2] < 0.056  # ENS0
    assert 0.016 < p("9.15")[2] - p("2.2")[2] < 0.028  # MNS0
    assert 0.042 < p("8.3")[0] - p("8.4")[0] < 0.060  # MW0


def test_points_off_the_skin_are_on_their_own_part(head: HeadMesh) -> None:
    owner = {
        Part.EYEBALL_L: ("3.5",),
        Part.EYEBALL_R: ("3.6",),
        Part.TONGUE: ("6.1", "6.2", "6.3", "6.4"),
        Part.TEETH_UPPER: ("9.8", "9.10"),
        Part.TEETH_LOWER: ("9.9", "9.11"),
    }
    for part, names in owner.items():
        for name in names:
            point = head.points[name]
            assert isinstance(point, int)
            assert head.parts[point] == part, name
    tongue = head.vertices[head.parts == Part.TONGUE]
    assert head.position("6.1")[1] == tongue[:, 1].min()
    assert head.position("6.3")[0] == tongue[:, 0].max()


@pytest.mark.parametrize(("uv", "node"), [((0.0, 0.0), 0), ((1.0, 0.0), 1), ((1.0, 1.0), 2), ((0.0, 1.0), 3)])
def test_uv_runs_from_the_first_node_to_the_second_and_to_the_fourth(uv: tuple[float, float], node: int) -> None:
    figures = read_figures()
    corners = ("r02c05", "r03c05", "r03c06", "r02c06")
    placed = replace(figures, points={"4.3": PointFigures(corners, uv)}, point_pairs={})
    found = skin_points(placed, folding_skin(figures))["4.3"]
    assert np.allclose(found, figures.nodes[corners[node]], atol=1e-9)


@pytest.mark.slow
def test_positions_that_are_not_vertices_lie_on_the_skin(head: HeadMesh) -> None:
    skin = head.vertices[head.parts == Part.SKIN]
    loose = [n for n, point in head.points.items() if not isinstance(point, int) and n != "7.1"]
    assert len(loose) > 10
    surface = samples(head, quads_of(head, Part.SKIN))
    for name in loose:
        assert np.linalg.norm(surface - head.position(name), axis=1).min() < 0.8e-3, name
        assert np.linalg.norm(skin - head.position(name), axis=1).min() > 0.2e-3, name


def test_loops_are_chains_of_mesh_edges(head: HeadMesh) -> None:
    edges = set(directed_edges(np.array(head.polygons)))
    around_eyes = [f"{name}_{side}" for name in ("lash_line", "lid_margin", "lid_fold") for side in "lr"]
    for name in (*around_eyes, "lip_contact", "vermilion_border", "neck_rim"):
        loop = head.groups[name].tolist()
        assert len(set(loop)) == len(loop)
        for a, b in zip(loop, loop[1:] + loop[:1], strict=True):
            assert (a, b) in edges or (b, a) in edges, name


def test_an_unknown_point_is_refused(head: HeadMesh) -> None:
    with pytest.raises(ModelError, match=r"8\.44"):
        head.position("8.44")
