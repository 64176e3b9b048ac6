"""One light for every head: from one side and above, so that folds, wings and forehead throw shadows. Needs bpy.

Light and paint were chosen by two things that no emotion of Risorius touches: resting heads are seen as neutral, and
scanned actions are named about as surely as in pictures that others made of them.
"""

from __future__ import annotations

from typing import Any

from risorius.scene.materials import node_tree_of
from risorius.scene.pictures.framing import Framing
from risorius.scene.pictures.furniture import CLOSENESS, aim

#: (name, place in heights of the picture from the face's middle: subject's left, up, forward; size; power).
LIGHTS = (("Key", (0.8065, 1.3441, 1.4516), 0.3763, 34.686), ("Fill", (-1.3978, 0.2151, 1.6129), 1.2903, 6.937))

#: How much of the background's light falls on the face.
AMBIENT = 0.5


def relight(scene: Any, framing: Framing) -> None:
    """Put these lights in the place of a studio's own, on a face that is framed so."""
    height = CLOSENESS * framing.height
    lamps = [obj for obj in scene.collection.objects if obj.type == "LIGHT"]
    for lamp, (_, place, size, power) in zip(lamps, LIGHTS, strict=False):
        lamp.data.size, lamp.data.energy = size * height, power * height**2
        at = framing.point(*(CLOSENESS * share for share in place))
        lamp.matrix_world = aim(at, framing.centre, framing.up)
    for lamp in lamps[len(LIGHTS) :]:
        lamp.data.energy = 0.0
    for node in node_tree_of(scene.world).nodes:
        if node.type == "MAP_RANGE":
            node.inputs["To Min"].default_value = AMBIENT
