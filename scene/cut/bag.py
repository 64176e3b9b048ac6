"""The mouth bag behind lips: their lining, then rings that lead into the dark."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from ...arrays import Floats
from ..blender_types import EditCorner, EditMesh, EditVertex
from .seam import Cut

if TYPE_CHECKING:
    from ...face.products.mouth_room import MouthRoom

Places: TypeAlias = "Callable[[EditVertex], Floats]"
"""Where a vertex lies at rest, (3,)."""

#: Rings of the bag: how deep, how high, and how much of its narrowing each has, as shares. Before them is the lining.
RINGS = ((0.35, 0.8, 0.3), (0.75, 1.0, 0.7), (0.95, 0.6, 1.0))


@dataclass(frozen=True, eq=False)
class BagShape:
    """Of a bag, in the mesh's own coordinates; see `face.products.mouth_room.MouthRoom`."""

    ends: Floats
    up: Floats
    inwards: Floats
    lining: float
    depth: float
    height: float
    narrowing: float

    def along(self, place: Sequence[float] | Floats) -> float:
        """Where a place (3,) lies between the right end, 0, and the left one, 1."""
        way = self.ends[0] - self.ends[1]
        return float((np.asarray(place, dtype=np.float64) - self.ends[1]) @ way / (way @ way))


def add_bag(edit: EditMesh, cut: Cut, shape: BagShape, at: Places, dark: int) -> None:
    """Hang a bag on both sides of a cut, whose vertices lie `at` some places at rest; all but its lining is dark.

    `dark` is the slot of that material.
    """
    loop = [*cut.upper, *cut.lower[-2:0:-1]]
    signs = [*[1.0] * len(cut.upper), *[-1.0] * (len(cut.lower) - 2)]
    backwards = _winds_along(loop[0], loop[1])
    rings, corners = [loop], [_corner(vertex) for vertex in loop]
    for deep, high, narrow in ((0.0, 0.0, 0.0), *RINGS):
        ways = [_way(at(v), sign, shape, (deep, high, narrow)) for v, sign in zip(loop, signs, strict=True)]
        rings.append([_behind(edit, v, way) for v, way in zip(loop, ways, strict=True)])
    count = len(loop)
    for number, (outer, inner) in enumerate(pairwise(rings)):
        for place in range(count):
            after = (place + 1) % count
            around = [(outer[after], after), (outer[place], place), (inner[place], place), (inner[after], after)]
            _face(edit, around if backwards else around[::-1], corners, None if number == 0 else dark)
    last = rings[-1]
    above, below = list(range(len(cut.upper))), [0, *range(count - 1, len(cut.upper) - 1, -1), len(cut.upper) - 1]
    steps = max(len(above), len(below)) - 1
    for step in range(1, steps + 1):  # the end is closed by a strip between both sides
        (a, before_a), (b, before_b) = (
            [k * (len(side) - 1) // steps for k in (step, step - 1)] for side in (above, below)
        )
        four = [above[a], above[before_a], below[before_b], below[b]]
        around = [(last[number], number) for number in four]
        if len(set(four)) > 2:
            _face(edit, around if backwards else around[::-1], corners, dark)


def bag_shape(room: MouthRoom, to_metres: Floats) -> tuple[BagShape, float]:
    """A room as a bag's shape in the coordinates of a mesh whose (4, 4) matrix is given, and its units to the metre."""
    back = np.linalg.inv(to_metres[:3, :3])
    size = float(np.cbrt(abs(np.linalg.det(back))))
    up, inwards = (back @ each / np.linalg.norm(back @ each) for each in (room.up, room.inwards))
    return BagShape(
        ends=room.ends @ back.T,
        up=up,
        inwards=inwards,
        lining=size * room.lining,
        depth=size * room.depth,
        height=size * room.height,
        narrowing=room.narrowing,
    ), size


def _way(place: Floats, sign: float, shape: BagShape, share: tuple[float, float, float]) -> Floats:
    """(3,) the way from a place on the upper (1) or lower (-1) side of the cut to its place in a ring."""
    deep, high, narrow = share
    along = shape.along(place)
    wide = float(np.sqrt(np.sin(np.pi * np.clip(along, 0.02, 0.98))))
    middle = (shape.ends[0] + shape.ends[1]) / 2.0
    aside = (shape.ends[0] - shape.ends[1]) * (along - 0.5)
    way = wide * (shape.lining + deep * (shape.depth - shape.lining)) * shape.inwards
    way = way + sign * wide * high * shape.height * shape.up - narrow * shape.narrowing * aside
    return np.asarray(way + narrow * wide * ((middle - place) @ shape.up) * shape.up)


def _behind(edit: EditMesh, vertex: EditVertex, way: Floats) -> EditVertex:
    """A vertex some way behind one of the cut, which it takes its layers from and whose shape keys it follows."""
    new = edit.verts.new(tuple(np.asarray(vertex.co, dtype=np.float64) + way), vertex)
    for layer in edit.verts.layers.shape.values():
        new[layer] = tuple(np.asarray(vertex[layer], dtype=np.float64) + way)
    return new


def _corner(vertex: EditVertex) -> EditCorner:
    """A corner of the skin at a vertex of the cut."""
    return vertex.link_loops[0]


def _winds_along(first: EditVertex, second: EditVertex) -> bool:
    """Whether the skin's face at an edge of the cut goes from its first to its second vertex."""
    edge = next(edge for edge in first.link_edges if edge.other_vert(first) is second)
    return edge.link_loops[0].vert is first


def _face(
    edit: EditMesh, around: Sequence[tuple[EditVertex, int]], corners: Sequence[EditCorner], slot: int | None
) -> None:
    """A face of the bag between vertices that stand behind those of the cut; None: with the material of the skin."""
    distinct = [pair for number, pair in enumerate(around) if pair[0] is not around[number - 1][0]]
    face = edit.faces.new([vertex for vertex, _ in distinct], corners[distinct[0][1]].face)
    if slot is not None:
        face.material_index = slot
    for corner in face.loops:
        corner.copy_from(corners[next(place for vertex, place in distinct if vertex is corner.vert)])
