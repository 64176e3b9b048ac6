"""A character of several objects: the default head, cut up as characters come."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.face.mesh.parts import Part
from risorius.scene import mesh as meshes
from risorius.scene.points.stored import store_points

#: Object -> the parts that it holds.
FIVE = {
    "Face": (Part.SKIN,),
    "Eyes": (Part.EYEBALL_L, Part.EYEBALL_R),
    "Teeth": (Part.TEETH_UPPER, Part.TEETH_LOWER),
    "Tongue": (Part.TONGUE,),
    "Brows": (Part.OTHER,),
}


@pytest.fixture
def character(built_head: Any) -> Callable[..., dict[str, Any]]:
    """Make objects of the default head; the first has the feature points and is active."""

    def make(parts_of: Mapping[str, tuple[Part, ...]] = FIVE) -> dict[str, Any]:
        corners, sizes = meshes.flatten_polygons(built_head.polygons)
        first = corners[np.cumsum(sizes) - sizes]
        made: dict[str, Any] = {}
        for name, parts in parts_of.items():
            kept = np.isin(built_head.parts, parts)
            number = np.cumsum(kept) - 1
            polygons = [tuple(number[list(p)]) for p, f in zip(built_head.polygons, first, strict=True) if kept[f]]
            mesh = meshes.new_mesh(name, built_head.vertices[kept], *meshes.flatten_polygons(polygons))
            made[name] = bpy.data.objects.new(name, mesh)
            bpy.context.collection.objects.link(made[name])
            if len(made) == 1:
                points = {
                    n: int(number[p]) if isinstance(p, int) and kept[p] else tuple(built_head.position(n))
                    for n, p in built_head.points.items()
                }
                store_points(made[name], points)
        bpy.context.view_layer.update()
        face = next(iter(made.values()))
        face.select_set(True)
        bpy.context.view_layer.objects.active = face
        return made

    return make
