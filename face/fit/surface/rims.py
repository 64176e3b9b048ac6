"""The rims of the skin that faces a view: closed lines along which it ends.

Faces that look toward the viewer near an opening are joined over their sides; the piece that the skin round the
opening lies on ends at the lid margin, or where the lips meet. Sockets, eyeballs, gums and the mouth's bag are not
joined to it through faces that look outward. So no curvature is needed, and real holes are found the same way.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.spatial import cKDTree

from ....arrays import Floats, Ints
from .cloud import Surface
from .pieces import joined, joined_over, side_keys


class Neighbourhood:
    """The triangles round an opening."""

    def __init__(self, surface: Surface, middle: Floats, reach: float) -> None:
        centres = surface.vertices[surface.triangles].mean(axis=1)
        chosen = np.linalg.norm(centres - middle, axis=1) < reach
        self.vertices = surface.vertices
        self.triangles = surface.triangles[chosen]
        self.centres = centres[chosen]
        cross = surface.part(chosen).cross()
        self.normals = cross / np.maximum(np.linalg.norm(cross, axis=1), 1e-30)[:, None]

    def rims(self, view: Floats, facing: float, outside: Floats) -> Iterator[Ints]:
        """Rims (closed lines of vertices) of the skin that faces a view and holds the places outside the opening."""
        shown = np.flatnonzero(self.normals @ (view / np.linalg.norm(view)) > facing)
        if len(shown) < 8:
            return
        triangles = self.triangles[shown]
        piece = joined(triangles)
        _, votes = cKDTree(self.centres[shown]).query(outside, k=3)
        most = np.bincount(piece[np.ravel(votes)]).argmax()
        yield from _closed_lines(triangles[piece == most])

    def depth_behind(self, rim: Ints) -> float:
        """How much deeper than a rim (closed line of vertices) the surface that it encloses reaches, metres.

        Infinite where it encloses none, or one with open edges: the rim bounds a hole then.
        """
        ahead = np.roll(rim, -1)
        base = int(self.triangles.max()) + 1
        keys = side_keys(self.triangles, base)
        on_rim = np.isin(keys, np.minimum(rim, ahead) * base + np.maximum(rim, ahead))
        _, number, users = np.unique(keys, return_inverse=True, return_counts=True)
        side = number.reshape(keys.shape)
        piece = joined_over(side, ~on_rim)
        following = np.roll(self.triangles, -1, axis=1)
        beyond = np.isin(self.triangles * base + following, ahead * base + rim).any(axis=1)
        enclosed = np.isin(piece, piece[beyond])
        is_open = (users[side] == 1)[enclosed].any()
        if is_open or not enclosed.any():
            return float("inf")
        return float(self.vertices[self.triangles[enclosed], 1].max() - self.vertices[rim, 1].max())


def _closed_lines(triangles: Ints) -> Iterator[Ints]:
    """The closed lines along which a piece of surface ends, with the surface to the left of the way."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    base = int(triangles.max()) + 1
    ends = sides[~np.isin(sides[:, 0] * base + sides[:, 1], sides[:, 1] * base + sides[:, 0])]
    onward: dict[int, list[int]] = {}
    for a, b in ends.tolist():
        onward.setdefault(a, []).append(b)
    while onward:
        start = next(iter(onward))
        line = [start]
        place: dict[int, int] = {start: 0}
        while True:
            following = onward.get(line[-1])
            if not following:
                break
            step = following.pop()
            if not following:
                del onward[line[-1]]
            if step in place:
                loop = line[place[step] :]
                for vertex in loop[1:]:
                    del place[vertex]
                del line[place[step] + 1 :]
                yield np.array(loop, dtype=np.int64)
                if not onward.get(step):
                    break
                continue
            place[step] = len(line)
            line.append(step)
        onward = {vertex: steps for vertex, steps in onward.items() if steps}
