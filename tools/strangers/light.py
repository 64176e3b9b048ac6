"""One light for every head: from one side and above, so that folds, wings and forehead throw shadows. Needs bpy.

Light and paint were chosen by two things that no emotion of Risorius touches: resting heads are seen as neutral, and
scanned actions are named about as surely as in pictures that others made of them.
"""

from __future__ import annotations

from typing import Any

from risorius.scene.materials import node_tree_of
from risorius.scene.pictures.framing import Framing
from risorius.scene.pictures.furniture import aim

#: (name, place in picture heights from the face's middle: subject's left, up, forward; size; power).
LIGHTS = (("Key", (0.75, 1.25, 1.35), 0.35, 30.0), ("Fill", (-1.3, 0.2, 1.5), 1.2, 6.0))

#: How much of the background's light falls on the face.
AMBIENT = 0.5


def relight(scene: Any, framing: Framing) -> None:
    """Put these lights in the place of a studio's own, on a face that is framed so."""
    lamps = [obj for obj in scene.collection.objects if obj.type == "LIGHT"]
    for lamp, (_, place, size, power) in zip(lamps, LIGHTS, strict=False):
        lamp.data.size, lamp.data.energy = size * framing.height, power * framing.height**2
        lamp.matrix_world = aim(framing.point(*place), framing.centre, framing.up)
    for lamp in lamps[len(LIGHTS) :]:
        lamp.data.energy = 0.0
    for node in node_tree_of(scene.world).nodes:
        if node.type == "MAP_RANGE":
            node.inputs["To Min"].default_value = AMBIENT
