"""The template bent onto a head: the cage's nodes are moved until the skin that it carries lies on the target."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

from ....arrays import Bools, Floats, Ints
from ..surface.cloud import nearest
from ..template.template import FitTemplate
from .target import Target, feature

#: Share of a match's offset along the surface that is followed.
ALONG = 0.15
#: Distance at which a match counts half, metres; least cosine between matched normals.
HALF, FACING = 6e-3, 0.35
#: How firmly left and right move alike, and how firmly every node stays, beside the matches' weight of 1.
MIRROR, STAY = 0.05, 1e-4
#: A wish's weight.
WISH = 8.0


@dataclass(frozen=True)
class Stage:
    """A run of rounds.

    Attributes
    ----------
    rounds : how many.
    stiffness : weight of the cage's smoothness in the first and last round.
    front_gate : farthest match of the face's front in the first and last round, metres.
    rest_gate : the same for all else; None: the front alone is matched.
    """

    rounds: int
    stiffness: tuple[float, float]
    front_gate: tuple[float, float]
    rest_gate: tuple[float, float] | None


@dataclass(frozen=True, eq=False)
class Wishes:
    """Where some of the skin shall come to.

    Attributes
    ----------
    rows : (N, C) read these places' displacements off the cage's.
    offsets : (N, 3) displacements wished for, metres of the template.
    """

    rows: sparse.csr_array
    offsets: Floats

    @classmethod
    def of_nodes(cls, template: FitTemplate, nodes: Ints, places: Floats) -> Wishes:
        """Wishes for cage nodes (N,) to come to places (N, 3)."""
        rows = sparse.csr_array(template.skin.cage_matrix)[nodes]
        return cls(rows, places - template.skin.vertices[nodes])


def bend(template: FitTemplate, target: Target, moved: Floats, stage: Stage, wishes: Sequence[Wishes] = ()) -> Floats:
    """Displacements (C, 3) of the cage after a stage that starts from `moved`."""
    matrix = sparse.csr_array(template.skin.cage_matrix)
    smooth = sparse.csr_array(template.laplacian.T @ template.laplacian)
    count = matrix.shape[1]
    identity = sparse.csr_array(sparse.diags_array(np.ones(count)))
    mirror = identity[template.cage_mirror]
    twins = [(identity + sign * mirror).T @ (identity + sign * mirror) for sign in (1.0, -1.0, -1.0)]
    wished = sparse.csr_array((count, count))
    pull = np.zeros((count, 3))
    for wish in wishes:
        wished = wished + WISH * (wish.rows.T @ wish.rows)
        pull = pull + WISH * (wish.rows.T @ wish.offsets)
    matcher = _Matcher(template, target, everything=stage.rest_gate is not None)
    for number in range(stage.rounds):
        share = number / max(1, stage.rounds - 1)
        stiffness = _between(stage.stiffness, share)
        rest_gate = 0.0 if stage.rest_gate is None else _between(stage.rest_gate, share)
        rows, aims, weights = matcher.matches(matrix @ moved, _between(stage.front_gate, share), rest_gate)
        read = matrix[rows]
        weighted = sparse.diags_array(weights) @ read
        common = read.T @ weighted + wished + stiffness * smooth + STAY * identity
        right = weighted.T @ aims + pull
        side = splu(sparse.csc_array(common + MIRROR * twins[0])).solve(right[:, 0])
        others = splu(sparse.csc_array(common + MIRROR * twins[1])).solve(right[:, 1:])
        moved = np.column_stack([side, others])
    return moved


def _between(ends: tuple[float, float], share: float) -> float:
    """From one figure to another by equal ratios."""
    return float(ends[0] * (ends[1] / ends[0]) ** share)


class _Matcher:
    """Finds, for the template's visible skin, where on the target it belongs."""

    def __init__(self, template: FitTemplate, target: Target, *, everything: bool) -> None:
        self._rest = template.skin.vertices
        self._triangles = template.surface.triangles
        self._front: Bools = template.front
        self._chosen: Ints = np.flatnonzero(template.exterior if everything else template.front)
        self._target = target
        points = target.outside
        self._every = np.arange(len(points))
        self._seen = np.flatnonzero(target.front)
        features = feature(points.positions, points.normals)
        self._front_tree = cKDTree(features[self._seen])
        self._tree = cKDTree(features) if everything else self._front_tree

    def matches(self, moved: Floats, front_gate: float, rest_gate: float) -> tuple[Ints, Floats, Floats]:
        """Skin vertices (N,), displacements (N, 3) that would bring them to their matches, and weights (N,)."""
        skin = self._rest + moved
        normals = _normals(skin, self._triangles)
        rows, matches = [], []
        for in_front, tree, index, gate in (
            (True, self._front_tree, self._seen, front_gate),
            (False, self._tree, self._every, rest_gate),
        ):
            here = self._chosen[self._front[self._chosen] == in_front]
            if len(here) == 0 or gate <= 0.0:
                continue
            distance, match = nearest(tree, feature(skin[here], normals[here]), within=3.0 * gate)
            found = np.isfinite(distance)
            rows.append(here[found])
            matches.append(index[match[found]])
        row, hit = np.concatenate(rows), np.concatenate(matches)
        points = self._target.outside
        away = points.positions[hit] - skin[row]
        facing = points.normals[hit]
        distance = np.linalg.norm(away, axis=1)
        gates = np.where(self._front[row], front_gate, rest_gate)
        kept = (distance <= gates) & ((facing * normals[row]).sum(axis=1) >= FACING) & ~self._target.edge[hit]
        row, away, facing, distance = row[kept], away[kept], facing[kept], distance[kept]
        across = (away * facing).sum(axis=1)[:, None] * facing
        aims = moved[row] + across + ALONG * (away - across)
        return row, aims, 1.0 / (1.0 + (distance / HALF) ** 2)


def _normals(vertices: Floats, triangles: Ints) -> Floats:
    """(V, 3) smooth unit normals."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    flat = triangles.T.ravel()
    normals = np.stack([np.bincount(flat, np.tile(cross[:, k], 3), len(vertices)) for k in range(3)], axis=1)
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None])
