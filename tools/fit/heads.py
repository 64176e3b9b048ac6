"""Heads with known feature points for measuring how well they are found.

The shared heads, which the method was tuned on; a second set that it was tuned on later; and a reserved set that
nothing was ever chosen by. Both sets are mixtures of the shared people, and the default head bent by smooth random
fields that carry its feature points along.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
import risorius.api as api
from risorius.arrays import Bools, Floats, Ints

#: Bent default heads: size of the bends, metres, their width, and how far each axis is scaled.
BEND, BEND_WIDTH, BEND_SCALE = 3.5e-3, 45e-3, 0.12


@dataclass(frozen=True)
class TrueHead:
    """A head whose feature points are known: vertices (V, 3), polygons, name -> position (3,), metres."""

    name: str
    vertices: Floats
    polygons: Sequence[Sequence[int]] | Sequence[Ints]
    points: Mapping[str, Floats]


@dataclass(frozen=True)
class Recipe:
    """How a set of new heads is made.

    Attributes
    ----------
    ict, makehuman : mixtures (a, b, c, share) of the shared people by index: a + share * (b - c).
    bent : seeds of the bent default heads.
    """

    ict: Sequence[tuple[int, int, int, float]]
    makehuman: Sequence[tuple[int, int, int, float]]
    bent: Sequence[int]


SECOND = Recipe(
    ict=((1, 5, 0, 0.6), (3, 2, 5, 0.7), (0, 4, 2, 0.7), (2, 1, 3, 0.6), (4, 3, 5, 0.5)),
    makehuman=((0, 2, 4, 0.4), (4, 1, 0, 0.5), (7, 0, 1, 0.5), (1, 3, 2, 0.4), (6, 5, 7, 0.5)),
    bent=(21, 22, 23, 24, 25),
)
RESERVED = Recipe(
    ict=((0, 3, 1, 0.6), (5, 1, 4, 0.6), (2, 4, 0, 0.7), (1, 0, 3, 0.6), (3, 5, 4, 0.5)),
    makehuman=((2, 6, 1, 0.4), (3, 0, 7, 0.4), (5, 7, 2, 0.5), (0, 6, 3, 0.5), (6, 4, 2, 0.5)),
    bent=(61, 62, 63, 64, 65),
)


class SharedHeads:
    """The shared heads and what is made of them.

    Parameters
    ----------
    folder : the folder that holds `ict.npz` and so on.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def known(self) -> Iterator[TrueHead]:
        """The heads that the method was tuned on."""
        for name in ("ict", "ict_narrow", "makehuman", "mediapipe", "makehuman_body"):
            yield self.shared(name)
        for number in range(6):
            yield self._head(f"ict identity {number}", "ict", self._identity(number))
        variants = self._arrays("makehuman_variants")
        for label, vertices in zip(variants["names"], variants["vertices"], strict=True):
            yield self._head(f"makehuman {label}", "makehuman", vertices.astype(np.float64))

    def second(self) -> Iterator[TrueHead]:
        """The second set: once new to the method, tuned on since."""
        return self._made(SECOND)

    def reserved(self) -> Iterator[TrueHead]:
        """Heads that nothing was chosen by, for the report alone: tuning on them spoils them."""
        return self._made(RESERVED)

    def _made(self, recipe: Recipe) -> Iterator[TrueHead]:
        """The heads of a recipe."""
        for a, b, c, share in recipe.ict:
            mixed = self._identity(a) + share * (self._identity(b) - self._identity(c))
            yield self._head(f"ict {a} + {share} ({b} - {c})", "ict", mixed)
        people = self._arrays("makehuman_variants")["vertices"].astype(np.float64)
        for a, b, c, share in recipe.makehuman:
            mixed = people[a] + share * (people[b] - people[c])
            yield self._head(f"makehuman {a} + {share} ({b} - {c})", "makehuman", mixed)
        for seed in recipe.bent:
            yield bent_default_head(seed)

    def shared(self, name: str) -> TrueHead:
        """The head of a file: "ict", "ict_narrow", "makehuman", "mediapipe" or "makehuman_body"."""
        return self._head(name, name, self._arrays(name)["vertices"].astype(np.float64))

    def skin(self, name: str) -> Bools:
        """(V,) which vertices of such a head are skin."""
        skin: Bools = self._arrays(name)["labels"] == 0
        return skin

    def expression(self, name: str, weights: Mapping[str, float]) -> TrueHead:
        """The scanned mean head in an expression: the weights of its shapes."""
        vertices = self._arrays("ict")["vertices"].astype(np.float64)
        skin, inner = self._arrays("ict_expressions"), self._arrays("ict_expressions_inner")
        names = [str(name) for name in skin["names"]]
        count = skin["displacement"].shape[1]
        for shape, weight in weights.items():
            vertices[:count] += weight * skin["displacement"][names.index(shape)]
            vertices[count:] += weight * inner["displacement"][names.index(shape)].astype(np.float64)
        return self._head(f"ict, {name}", "ict", vertices)

    def _arrays(self, name: str) -> Mapping[str, np.ndarray]:
        return _read(self._folder / f"{name}.npz")

    def _head(self, name: str, mesh: str, vertices: Floats) -> TrueHead:
        """A head on one of the shared meshes."""
        arrays = self._arrays(mesh)
        polygons = np.split(arrays["loops"].astype(np.int64), np.cumsum(arrays["face_sizes"])[:-1])
        points = json.loads((self._folder / f"{mesh}.fp.json").read_text())["points"]
        return TrueHead(name, vertices, polygons, {key: vertices[index] for key, index in points.items()})

    def _identity(self, number: int) -> Floats:
        """Vertices of another person on the scanned mesh."""
        vertices = self._arrays("ict")["vertices"].astype(np.float64)
        skin = self._arrays("ict_identities")["vertices"][number]
        inner = next(array for array in self._arrays("ict_identities_inner").values() if array.ndim == 3)[number]
        vertices[: len(skin)] = skin
        vertices[len(skin) :] += inner.astype(np.float64)
        return vertices


@lru_cache(maxsize=8)
def _read(path: Path) -> Mapping[str, np.ndarray]:
    """The arrays of a file."""
    with np.load(path) as arrays:
        return {name: arrays[name] for name in arrays.files}


def bent_default_head(seed: int) -> TrueHead:
    """The default head bent by a smooth random field."""
    head = api.build_default_head()
    random = np.random.default_rng(seed)
    knots = head.vertices[random.choice(len(head.vertices), 24, replace=False)]
    ways = random.normal(scale=BEND, size=(len(knots), 3))
    scale = 1.0 + random.uniform(-BEND_SCALE, BEND_SCALE, 3)

    def bent(places: Floats) -> Floats:
        near = np.exp(-((places[:, None] - knots) ** 2).sum(axis=2) / (2.0 * BEND_WIDTH**2))
        return np.asarray((places + near @ ways) * scale)

    points = {name: bent(head.position(name)[None])[0] for name in head.points}
    return TrueHead(f"default head, bent ({seed})", bent(head.vertices), head.polygons, points)
