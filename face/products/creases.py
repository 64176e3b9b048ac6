"""Creases: how squeezed the skin is, and where on it a material is to draw which wrinkle.

A mesh whose edges are wider than a wrinkle cannot fold, but a material can draw on it: where a vertex lies across a
crease is a smooth figure that a renderer interpolates over the polygons, so lines come out far finer than the mesh.
The places are fixed; what changes with the pose is the compression across the lines, and it follows from the lengths
of the mesh's edges alone. `scene.creases.nodes` states the same formulas as nodes, so that a baked face wrinkles by
itself wherever it plays.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Floats
from ...errors import ParameterError
from ...physics.mesh import unique_edges
from ..face import Face
from ..skin.outer import smoothstep
from .crease_places import place_crease
from .crease_table import CREASES, CreaseRow, Look, read_creases

#: Compression is averaged in at most so many rounds over neighbouring vertices.
MOST_ROUNDS = 12


@dataclass(frozen=True, eq=False)
class Crease:
    """One crease on one face.

    Attributes
    ----------
    row : its figures.
    places : (V, 2) of every vertex; see `place_crease`. Presence is 0 off the outer skin.
    """

    row: CreaseRow
    places: Floats


class Creases:
    """The creases of one face, and how full they are in a pose.

    Examples
    --------
    >>> face = api.default_face()
    >>> creases = api.Creases(face)
    >>> surprised = face.pose(api.archetype("surprise").frame())
    >>> creases.amounts(surprised.positions)["forehead"] > creases.amounts(face.vertices)["forehead"]
    True
    """

    def __init__(self, face: Face, rows: Sequence[CreaseRow] | None = None) -> None:
        """Place the creases of a table (the built-in one) on a face."""
        anatomy, skin = face.anatomy, face.anatomy.given_skin
        self.rest, self.index, self.leads = face.vertices, skin.index, anatomy.mesh.seams.leads
        #: (V, 3) resting vertices in head space, metres: where a renderer takes its noise from.
        self.head_positions = anatomy.mesh.positions
        self.edges = unique_edges(face.polygons)
        self.degree = np.maximum(np.bincount(self.edges.ravel(), minlength=len(self.rest)), 1)
        self.lengths = np.maximum(np.linalg.norm(self._along(self.rest), axis=1), 1e-12)
        self.areas = np.zeros(len(self.rest))
        self.areas[self.index] = skin.areas
        edge = float(np.median(np.sqrt(skin.areas)))
        #: Rounds over which compression is averaged.
        self.rounds = int(np.clip(round(2.5 * (CREASES.averaged / edge) ** 2), 1, MOST_ROUNDS))
        #: Crease by name.
        self.creases: Mapping[str, Crease] = {
            row.name: Crease(row, self._spread(place_crease(skin, anatomy.warp, row)))
            for row in (read_creases() if rows is None else rows)
        }

    def strain(self, positions: ArrayLike) -> Floats:
        """(V,) share by which the edges round each vertex are shorter than at rest; negative: stretched.

        Parameters
        ----------
        positions : (V, 3) posed vertices in the face's coordinates.

        Raises
        ------
        ParameterError : positions of another shape.
        """
        return self._averaged(self._shortening(positions))

    def fullness(self, positions: ArrayLike) -> dict[str, Floats]:
        """(V,) how full each crease is at each vertex, 0 to 1, by name; parameters and errors as `strain`."""
        shortening = self._shortening(positions)
        full = {}
        for name, crease in self.creases.items():
            row = crease.row
            weight = self._weight(self.creases[row.of])
            total = self._averaged(weight)
            squeezed = self._averaged(weight * shortening) / np.where(total > 0.0, total, 1.0)
            full[name] = crease.places[:, 1] * smoothstep((squeezed - row.onset) / (row.full - row.onset))
        return full

    def amounts(self, positions: ArrayLike) -> dict[str, float]:
        """How full each crease is as a whole, 0 to 1, by name ("forehead", "nasolabial_l"); errors as `strain`."""
        amounts, left = {}, self.head_positions[:, 0] > 0.0
        for name, full in self.fullness(positions).items():
            crease = self.creases[name]
            if crease.row.look is Look.UNSEEN:
                continue
            sides = {"_l": left, "_r": ~left} if crease.row.paired else {"": np.ones_like(left)}
            for side, mask in sides.items():
                areas = self.areas * mask
                amounts[name + side] = float(areas @ full) / max(float(areas @ crease.places[:, 1]), 1e-18)
        return amounts

    def _weight(self, crease: Crease) -> Floats:
        """(E,) how much every edge tells of compression across a crease: those count that lie on it and run across."""
        across, presence = crease.places.T
        slope = np.diff(across[self.edges], axis=1)[:, 0] / self.lengths
        weight: Floats = presence[self.edges].prod(axis=1) * slope**4
        return weight

    def _spread(self, places: Floats) -> Floats:
        """(V, 2) places of all vertices from those of the outer skin (n, 2)."""
        spread = np.zeros((len(self.rest), 2))
        spread[self.index] = places
        return spread[self.leads]

    def _along(self, positions: Floats) -> Floats:
        """(E, 3) from end to end of every edge."""
        ends: Floats = np.diff(positions[self.edges], axis=1)[:, 0]
        return ends

    def _shortening(self, positions: ArrayLike) -> Floats:
        """(E,) share by which every edge is shorter than at rest."""
        posed = np.asarray(positions, dtype=np.float64)
        if posed.shape != self.rest.shape:
            raise ParameterError("positions", f"must be of shape {self.rest.shape}", posed.shape)
        shortening: Floats = 1.0 - np.linalg.norm(self._along(posed), axis=1) / self.lengths
        return shortening

    def _averaged(self, values: Floats) -> Floats:
        """(V,) means of what edges (E,) have, over the edges of each vertex and then over neighbouring vertices."""
        count = len(self.rest)
        a, b = self.edges.T
        mean = (np.bincount(a, values, count) + np.bincount(b, values, count)) / self.degree
        for _ in range(self.rounds):
            mean = (mean + np.bincount(a, mean[b], count) + np.bincount(b, mean[a], count)) / (1.0 + self.degree)
        averaged: Floats = mean
        return averaged
