"""Cutting an edited mesh along a line through its faces, where figures of its vertices change their sign."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import bmesh

from ..blender_types import EditEdge, EditFace, EditMesh, EditVertex

#: An edge is not cut nearer to one of its ends than this share of it: the line then goes through the vertex.
SNAP = 0.15


@dataclass(frozen=True, eq=False)
class Cut:
    """A cut from one end to the other: both sides' vertices in order; the ends, first and last, belong to both."""

    upper: tuple[EditVertex, ...]
    lower: tuple[EditVertex, ...]


class Line:
    """The line where figures of vertices are 0, drawn into an edited mesh."""

    def __init__(self, edit: EditMesh, above: Mapping[EditVertex, float], along: Callable[[EditVertex], float]) -> None:
        """Draw it.

        Parameters
        ----------
        above : the figure of each vertex near the line; others are left alone.
        along : how far along the line a vertex lies; it ends at 0 and at 1.
        """
        self._above, self._along = dict(above), along
        self._on = self._snapped(edit)
        for edge in list(edit.edges):
            self._cross(edge)
        for face in list(edit.faces):
            self._part(face)

    def path(self, edit: EditMesh) -> list[EditVertex]:
        """The vertices of the line's longest piece, from its end near 0 to the one near 1; none where there is none."""
        ties: dict[EditVertex, list[EditVertex]] = {}
        for edge in edit.edges:
            first, second = edge.verts
            if first in self._on and second in self._on and self._divides(edge):
                ties.setdefault(first, []).append(second)
                ties.setdefault(second, []).append(first)
        best: list[EditVertex] = []
        seen: set[EditVertex] = set()
        for start in ties:
            if start in seen:
                continue
            piece = list(_reached(ties, start))
            seen.update(piece)
            first, last = min(piece, key=self._along), max(piece, key=self._along)
            if not best or self._along(last) - self._along(first) > self._along(best[-1]) - self._along(best[0]):
                best = _way(_reached(ties, last), first)
        return best

    def side(self, face: EditFace) -> float:
        """Above 0 for a face above the line, below 0 for one below it."""
        sure = sum(self._above.get(vertex, 0.0) for vertex in face.verts if vertex not in self._on)
        return sure or sum(self._above.get(vertex, 0.0) for vertex in face.verts)

    def _figure(self, vertex: EditVertex) -> float | None:
        """The figure of a vertex, 0 on the line, None away from it."""
        return 0.0 if vertex in self._on else self._above.get(vertex)

    def _snapped(self, edit: EditMesh) -> set[EditVertex]:
        """Vertices so near to the line that it goes through them."""
        on = {vertex for vertex, figure in self._above.items() if figure == 0.0 and self._is_within(vertex)}
        for edge in edit.edges:
            first, second = edge.verts
            one, other = self._above.get(first), self._above.get(second)
            if one is None or other is None or one * other >= 0.0:
                continue
            share = one / (one - other)
            if share < SNAP and self._is_within(first):
                on.add(first)
            elif share > 1.0 - SNAP and self._is_within(second):
                on.add(second)
        return on

    def _is_within(self, vertex: EditVertex) -> bool:
        """Whether a vertex lies between the ends."""
        return 0.0 <= self._along(vertex) <= 1.0

    def _cross(self, edge: EditEdge) -> None:
        """A vertex where the line crosses an edge."""
        first, second = edge.verts
        one, other = self._figure(first), self._figure(second)
        if one is None or other is None or one * other >= 0.0:
            return
        if not (self._is_within(first) or self._is_within(second)):
            return
        _, new = bmesh.utils.edge_split(edge, first, one / (one - other))
        self._above[new] = 0.0
        self._on.add(new)

    def _part(self, face: EditFace) -> None:
        """Split a face between vertices on the line that have one side of it between them and the other beyond."""
        corners = list(face.verts)
        figures = [self._figure(vertex) for vertex in corners]
        on = [place for place, vertex in enumerate(corners) if vertex in self._on]
        for start, first in enumerate(on):
            for second in on[start + 1 :]:
                within, beyond = figures[first + 1 : second], figures[second + 1 :] + figures[:first]
                if _sign(within) * _sign(beyond) < 0:
                    new, _ = bmesh.utils.face_split(face, corners[first], corners[second])
                    self._part(face)
                    self._part(new)
                    return

    def _divides(self, edge: EditEdge) -> bool:
        """Whether an edge has a face on either side of the line."""
        faces = edge.link_faces
        return len(faces) == 2 and self.side(faces[0]) * self.side(faces[1]) < 0.0


def _sign(figures: Sequence[float | None]) -> int:
    """1 or -1 where the sum of figures is above or below 0; 0 where there are none."""
    total = sum(figure for figure in figures if figure is not None)
    return (total > 0.0) - (total < 0.0)


def _reached(ties: Mapping[EditVertex, Sequence[EditVertex]], start: EditVertex) -> dict[EditVertex, EditVertex]:
    """Every vertex that hangs together with a first one -> the one before it on the shortest way from there."""
    before, waiting = {start: start}, deque([start])
    while waiting:
        vertex = waiting.popleft()
        for other in ties[vertex]:
            if other not in before:
                before[other] = vertex
                waiting.append(other)
    return before


def _way(before: Mapping[EditVertex, EditVertex], start: EditVertex) -> list[EditVertex]:
    """From a vertex back to where `before` begins."""
    way = [start]
    while before[way[-1]] is not way[-1]:
        way.append(before[way[-1]])
    return way


def cut_open(edit: EditMesh, line: Line, path: Sequence[EditVertex]) -> Cut:
    """Part a mesh along a path of its line; the path's ends hold both sides together."""
    wanted = {frozenset(pair) for pair in pairwise(path)}
    edges = [edge for edge in edit.edges if frozenset(edge.verts) in wanted]
    bmesh.ops.split_edges(edit, edges=edges)
    chains = {}
    for edge in path[0].link_edges:
        if len(edge.link_faces) == 1:
            chains[line.side(edge.link_faces[0]) > 0.0] = _border(path[0], edge, path[-1])
    return Cut(chains[True], chains[False])


def _border(start: EditVertex, edge: EditEdge, end: EditVertex) -> tuple[EditVertex, ...]:
    """Vertices along an open border, from a first one over its edge to a last one."""
    chain = [start]
    while chain[-1] is not end:
        vertex = edge.other_vert(chain[-1])
        assert vertex is not None
        chain.append(vertex)
        if vertex is not end:
            edge = next(other for other in vertex.link_edges if len(other.link_faces) == 1 and other is not edge)
    return tuple(chain)
