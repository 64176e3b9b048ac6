"""The linear operator: Dirichlet integral, definiteness, Green's function, solves."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius.errors import ParameterError, SolverError
from risorius.physics import elastic, mesh
from scipy import sparse


def hexagonal(rows: int) -> tuple[Any, Any]:
    """Equilateral triangles: springs of equal weight reproduce the Dirichlet integral exactly."""
    i, j = np.meshgrid(np.arange(rows), np.arange(rows), indexing="ij")
    vertices = np.stack([i + 0.5 * j, np.sqrt(0.75) * j, 0.0 * i], axis=2).reshape(-1, 3)
    index = np.arange(rows * rows).reshape(rows, rows)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    return vertices, np.concatenate([np.stack([a, b, d], 2).reshape(-1, 3), np.stack([b, c, d], 2).reshape(-1, 3)])


def squares(count: int, side: float) -> tuple[Any, Any]:
    x, y = np.meshgrid(np.arange(count + 1) * side, np.arange(count + 1) * side)
    corner = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    quads = np.stack([corner, corner + 1, corner + count + 2, corner + count + 1], axis=1)
    return np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), quads


@pytest.mark.parametrize("form", list(elastic.LaplacianForm))
@pytest.mark.parametrize("build", [lambda: hexagonal(7), lambda: squares(6, 0.01)])
def test_linear_field_gives_the_dirichlet_integral(form: Any, build: Any) -> None:
    vertices, polygons = build()
    gradient = np.array([1.7, -0.6, 0.0])
    u = vertices @ gradient
    matrix = elastic.laplacian(vertices, polygons, form=form)
    area = mesh.polygon_areas(vertices, polygons).sum()
    assert u @ (matrix @ u) == pytest.approx(gradient @ gradient * area, rel=1e-12)


def test_regular_polygons_of_any_size_keep_the_dirichlet_integral() -> None:
    for size in (3, 4, 5, 6, 7, 8, 9, 12, 31):
        angle = 2 * np.pi * np.arange(size) / size
        vertices = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
        u = vertices @ np.array([0.4, -1.1, 0])
        matrix = elastic.laplacian(vertices, [list(range(size))])
        area = mesh.polygon_areas(vertices, [list(range(size))])[0]
        assert u @ (matrix @ u) == pytest.approx((0.4**2 + 1.1**2) * area, rel=1e-12)


def test_cotangents_are_exact_on_irregular_triangles() -> None:
    vertices, triangles = hexagonal(6)
    vertices[:, :2] += 0.25 * np.random.default_rng(1).uniform(-1, 1, (len(vertices), 2))
    u = vertices @ np.array([0.3, 2.0, 0])
    matrix = elastic.laplacian(vertices, triangles, form="cotangent")
    area = mesh.polygon_areas(vertices, triangles).sum()
    assert u @ (matrix @ u) == pytest.approx((0.3**2 + 2.0**2) * area, rel=1e-10)


def test_forms_agree_on_a_face(shared: Path) -> None:
    data = np.load(shared / "heads" / "mediapipe.npz")
    vertices, triangles = data["vertices"].astype(float), data["loops"].reshape(-1, 3)
    springs, cotangents = (elastic.laplacian(vertices, triangles, form=form) for form in elastic.LaplacianForm)
    for u in vertices.T:
        assert u @ (springs @ u) == pytest.approx(u @ (cotangents @ u), rel=0.05)


def test_laplacian_is_symmetric_semidefinite_and_kills_constants() -> None:
    vertices, polygons = squares(5, 1.0)
    vertices += 0.1 * np.random.default_rng(0).normal(size=vertices.shape)
    matrix = elastic.laplacian(vertices, polygons).toarray()
    assert matrix == pytest.approx(matrix.T)
    assert np.abs(matrix.sum(axis=1)).max() < 1e-12
    assert np.linalg.eigvalsh(matrix).min() > -1e-12


def test_mask_leaves_other_vertices_alone() -> None:
    vertices, polygons = squares(4, 1.0)
    mask = vertices[:, 0] < 2.5
    matrix = elastic.laplacian(vertices, polygons, mask).toarray()
    assert not matrix[~mask].any()
    assert matrix[mask].any()


def test_elastic_matrix_of_a_uniform_load_is_the_anchor_alone() -> None:
    vertices, polygons = squares(8, 0.005)
    areas = mesh.vertex_areas(vertices, polygons)
    matrix = elastic.elastic_matrix(elastic.laplacian(vertices, polygons), areas, 0.01**2, 1 / 0.012**2)
    moved = elastic.Factor(matrix).solve(areas)
    assert moved == pytest.approx(np.full(len(areas), 0.012**2), rel=1e-9)


def test_membrane_on_anchors_decays_over_the_anchor_length() -> None:
    """A strip pulled at one end: u = cosh((l - x)/la) / cosh(l/la), with and without the fourth-order term's root."""
    length, side, anchor = 0.1, 0.0005, 0.012
    count = round(length / side)
    x = np.arange(count + 1) * side
    vertices = np.concatenate([np.stack([x, 0 * x + y, 0 * x], axis=1) for y in (0.0, side)])
    start = np.arange(count)
    quads = np.stack([start, start + 1, start + count + 2, start + count + 1], axis=1)
    areas = mesh.vertex_areas(vertices, quads)
    matrix = elastic.elastic_matrix(elastic.laplacian(vertices, quads), areas, 0.0, 1 / anchor**2)
    load = np.zeros(len(areas))
    load[[0, count + 1]] = 1.0
    moved = elastic.Factor(matrix).solve(load)[: count + 1]
    assert moved / moved[0] == pytest.approx(np.cosh((length - x) / anchor) / np.cosh(length / anchor), abs=2e-4)


def test_bending_penalises_the_surface_laplacian() -> None:
    """On a quadratic u = x^2 away from the border, div grad u = 2 at every vertex."""
    vertices, polygons = squares(10, 0.1)
    areas = mesh.vertex_areas(vertices, polygons)
    matrix = elastic.laplacian(vertices, polygons)
    inside = (np.abs(vertices[:, :2] - 0.5) < 0.45).all(axis=1)
    curvature = (matrix @ vertices[:, 0] ** 2)[inside] / areas[inside]
    assert curvature == pytest.approx(-2.0, rel=1e-9)
    weight = np.where(inside, 0.3, 0.0)
    energy = vertices[:, 0] ** 2 @ (elastic.bending_matrix(matrix, areas, weight) @ vertices[:, 0] ** 2)
    assert energy == pytest.approx(4 * 0.3 * areas[inside].sum(), rel=1e-9)


def test_factor_solves_many_columns() -> None:
    vertices, polygons = squares(6, 0.01)
    matrix = elastic.elastic_matrix(
        elastic.laplacian(vertices, polygons), mesh.vertex_areas(vertices, polygons), 1e-4, 1e4
    )
    right = np.random.default_rng(2).normal(size=(len(vertices), 5))
    assert matrix @ elastic.Factor(matrix).solve(right) == pytest.approx(right, abs=1e-9)


@pytest.mark.parametrize("order", ["C", "F"])
def test_many_columns_are_solved_as_each_alone(order: Any) -> None:
    vertices, quads = squares(5, 0.2)
    matrix = elastic.elastic_matrix(elastic.laplacian(vertices, quads), mesh.vertex_areas(vertices, quads), 0.1, 2.0)
    right = np.array(np.random.default_rng(3).normal(size=(len(vertices), 61)), order=order)
    for factor, scale in ((elastic.Factor(matrix), 1.0), (elastic.Factor(matrix).times(4.0), 4.0)):
        alone = np.stack([factor.solve(column) for column in right.T], axis=1)
        assert factor.solve(right) == pytest.approx(alone, abs=1e-12)
        assert scale * (matrix @ factor.solve(right)) == pytest.approx(right, abs=1e-9)


def test_vertices_without_area_stay_at_rest() -> None:
    vertices, polygons = squares(3, 0.01)
    vertices = np.concatenate([vertices, [[9.0, 9.0, 9.0]]])
    matrix = elastic.elastic_matrix(
        elastic.laplacian(vertices, polygons), mesh.vertex_areas(vertices, polygons), 1e-4, 1e4
    )
    load = np.ones(len(vertices))
    load[-1] = 0
    assert elastic.Factor(matrix).solve(load)[-1] == 0


def test_a_skin_without_anchor_cannot_be_factored() -> None:
    with pytest.raises(SolverError, match="anchor"):
        elastic.Factor(elastic.laplacian(*squares(1, 1.0)))


@pytest.mark.parametrize(("name", "arguments"), [("bending", (-1.0, 1.0)), ("anchor", (1.0, np.nan))])
def test_negative_or_missing_parameters_are_named(name: str, arguments: tuple[float, float]) -> None:
    vertices, polygons = squares(2, 1.0)
    areas = mesh.vertex_areas(vertices, polygons)
    with pytest.raises(ParameterError, match=name):
        elastic.elastic_matrix(elastic.laplacian(vertices, polygons), areas, *arguments)
    with pytest.raises(ParameterError, match="form"):
        elastic.laplacian(vertices, polygons, form="umbrella")


def test_pivots_are_not_looked_at_where_the_least_eigenvalue_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    loose = sparse.csr_array(np.array([[1.0, -1.0], [-1.0, 1.0]]))
    held = loose + 0.1 * sparse.eye_array(2)
    with pytest.raises(SolverError):
        elastic.Factor(loose)
    with pytest.raises(SolverError):
        elastic.Factor(loose, least=1e-15)  # so little tells nothing
    monkeypatch.setattr(elastic.Factor, "_SMALLEST_PIVOT", 1.0)  # fails whatever is looked at
    with pytest.raises(SolverError):
        elastic.Factor(held)
    with pytest.raises(SolverError):
        elastic.Factor(held, least=0.1)
    monkeypatch.setattr(elastic.Factor, "_SMALLEST_PIVOT", 0.05)
    assert np.allclose(elastic.Factor(held, least=0.1).solve(np.ones(2)), 10.0)
