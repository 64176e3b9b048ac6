"""Meshes that are no faces, made by code: what the finding of feature points must refuse."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import risorius.api as api
from risorius.arrays import Floats, Ints

Mesh = tuple[Floats, Ints]


def _grid(rows: int, columns: int, *, wrap_rows: bool) -> Ints:
    """Quads of a grid that closes round its columns, and round its rows where asked."""
    row, column = np.meshgrid(np.arange(rows if wrap_rows else rows - 1), np.arange(columns), indexing="ij")
    down, right = (row + 1) % rows, (column + 1) % columns
    corners = [row * columns + column, row * columns + right, down * columns + right, down * columns + column]
    return np.stack(corners, axis=-1).reshape(-1, 4).astype(np.int64)


def sphere(rings: int = 40, around: int = 64) -> Mesh:
    """A unit sphere."""
    polar, turn = np.meshgrid(
        np.linspace(1e-3, np.pi - 1e-3, rings), np.linspace(0.0, 2.0 * np.pi, around, endpoint=False), indexing="ij"
    )
    vertices = np.stack([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], axis=-1)
    return vertices.reshape(-1, 3), _grid(rings, around, wrap_rows=False)[:, ::-1]


def egg() -> Mesh:
    """A head's proportions with a bump where a nose would be, and no more."""
    vertices, quads = sphere(60, 90)
    vertices = vertices * np.array([0.075, 0.1, 0.12])
    bump = np.exp(-((vertices[:, 0] / 0.012) ** 2 + (vertices[:, 2] / 0.02) ** 2)) * (vertices[:, 1] < 0.0)
    vertices[:, 1] -= 0.022 * bump
    return vertices, quads


def rock(seed: int = 3, *, symmetric: bool = True) -> Mesh:
    """A bumpy sphere."""
    vertices, quads = sphere(60, 90)
    random = np.random.default_rng(seed)
    radius = np.ones(len(vertices))
    for _ in range(24):
        wave, phase = random.normal(scale=3.0, size=3), random.uniform(0.0, 6.0)
        places = np.column_stack([np.abs(vertices[:, 0]), vertices[:, 1:]]) if symmetric else vertices
        radius += 0.05 * np.sin(places @ wave + phase)
    return vertices * radius[:, None], quads


def torus() -> Mesh:
    """A ring."""
    a, b = np.meshgrid(np.arange(64) * 2.0 * np.pi / 64, np.arange(32) * 2.0 * np.pi / 32, indexing="ij")
    away = 1.0 + 0.35 * np.cos(b)
    vertices = np.stack([away * np.cos(a), away * np.sin(a), 0.35 * np.sin(b)], axis=-1).reshape(-1, 3)
    return vertices, _grid(64, 32, wrap_rows=True)


def boxes(*sizes_and_places: tuple[tuple[float, float, float], tuple[float, float, float]]) -> Mesh:
    """Boxes (size, middle), side by side."""
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    vertices = [corners * size + np.array(place) for size, place in sizes_and_places]
    faces = [quads + 8 * number for number in range(len(vertices))]
    return np.concatenate(vertices), np.concatenate(faces)


def cube() -> Mesh:
    """A cube."""
    return boxes(((1.0, 1.0, 1.0), (0.0, 0.0, 0.0)))


def chair() -> Mesh:
    """Four legs, a seat and a back."""
    legs = [((0.05, 0.05, 0.45), (x, y, 0.22)) for x in (-0.2, 0.2) for y in (-0.2, 0.2)]
    return boxes(*legs, ((0.46, 0.46, 0.05), (0.0, 0.0, 0.47)), ((0.46, 0.05, 0.5), (0.0, 0.2, 0.75)))


def hand() -> Mesh:
    """A palm with five fingers, of boxes."""
    fingers = [((0.017, 0.016, 0.08), (x, 0.0, 0.09)) for x in (-0.033, -0.011, 0.011, 0.033)]
    return boxes(((0.09, 0.025, 0.1), (0.0, 0.0, 0.0)), *fingers, ((0.06, 0.018, 0.02), (0.07, 0.0, -0.01)))


def back_of_head() -> Mesh:
    """The default head without its face."""
    return _part_of_head(lambda places: places[:, 1] > -0.05)


def half_head() -> Mesh:
    """The default head's left half."""
    return _part_of_head(lambda places: places[:, 0] > 0.0)


def _part_of_head(keep: Callable[[Floats], np.ndarray]) -> Mesh:
    """What a rule keeps of the default head."""
    head = api.build_default_head()
    quads = np.array(head.polygons)
    quads = quads[keep(head.vertices)[quads].all(axis=1)]
    used, numbered = np.unique(quads, return_inverse=True)
    return head.vertices[used], numbered.reshape(quads.shape)


NON_FACES: Mapping[str, Callable[[], Mesh]] = {
    "cube": cube,
    "sphere": sphere,
    "torus": torus,
    "egg with a nose": egg,
    "symmetric rock": rock,
    "rock": lambda: rock(5, symmetric=False),
    "chair": chair,
    "hand": hand,
    "back of a head": back_of_head,
    "half a face": half_head,
}
