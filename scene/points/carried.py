"""What shows of a mesh whose modifiers make other polygons of it, and the resting place of each of its vertices.

Blender can carry every vertex's resting place through shape keys and modifiers (`Object.add_rest_position_attribute`):
so a place of the resting surface is found again on what a Subdivision Surface makes of it, however it is posed.
"""

from __future__ import annotations

import hashlib
from collections import OrderedDict
from dataclasses import dataclass
from typing import Any

import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

from ...arrays import Floats
from .bound import Held, shares

#: The name that Blender gives it.
REST = "rest_position"
#: Building one takes a moment, and every redraw asks: so many are kept.
KEPT = 2
_kept: OrderedDict[bytes, Carried] = OrderedDict()


@dataclass(frozen=True)
class Carried:
    """The resting places of the vertices that show: (V', 3), the triangles between them, and a tree to look them up."""

    rest: Floats
    triangles: list[tuple[int, int, int]]
    tree: Any

    @classmethod
    def of(cls, shown: Any) -> Carried | None:
        """Of an evaluated mesh; None where Blender carries none along."""
        attribute = shown.attributes.get(REST)
        if attribute is None or attribute.domain != "POINT" or attribute.data_type != "FLOAT_VECTOR":
            return None
        flat = np.empty(3 * len(attribute.data), dtype=np.float32)
        attribute.data.foreach_get("vector", flat)
        corners = np.empty(3 * len(shown.loop_triangles), dtype=np.int32)
        shown.loop_triangles.foreach_get("vertices", corners)
        name = hashlib.blake2b(flat.tobytes() + corners.tobytes(), digest_size=16).digest()
        carried = _kept.pop(name, None)
        if carried is None:
            rest = flat.astype(np.float64).reshape(-1, 3)
            triangles = [(int(a), int(b), int(c)) for a, b, c in corners.reshape(-1, 3)]
            carried = cls(rest, triangles, BVHTree.FromPolygons(rest.tolist(), triangles, all_triangles=True))
        _kept[name] = carried
        while len(_kept) > KEPT:
            _kept.popitem(last=False)
        return carried

    def held(self, rest: Floats) -> Held | None:
        """Vertices of what shows, and their shares, for the resting place nearest to `rest` (3,)."""
        found, _, triangle, _ = self.tree.find_nearest(Vector(rest))
        return None if found is None else shares(self.triangles[triangle], self.rest, np.array(found))


def carry_rest(obj: Any) -> None:
    """Let Blender carry the resting places through the modifiers of `obj`, where it may be written to."""
    if obj.library is None and not obj.add_rest_position_attribute:
        obj.add_rest_position_attribute = True
