"""The default head with controls of its own: a small rig of skull, jaw, mouth corners and brows; shape keys."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api

#: Bones in the skin, and the feature point that each is at.
SMALL = {"corner.L": "8.3", "corner.R": "8.4", "brow.L": "4.1", "brow.R": "4.2"}
#: Shape key -> FAPs that it shows at 1: such as users draw, some with left and right apart, under any names.
DRAWN = {
    "Jaw Drop": {3: 400.0},
    "smile_L": {6: 400.0, 12: 400.0, 59: 400.0},
    "smile_R": {7: 400.0, 13: 400.0, 60: 400.0},
    "Frown": {12: -150.0, 13: -150.0, 59: -150.0, 60: -150.0},
    "browUp": {31: 150.0, 32: 150.0, 33: 150.0, 34: 150.0, 35: 150.0, 36: 150.0},
    "browDown": {31: -150.0, 32: -150.0, 37: 80.0, 38: 80.0},
    "lids": {19: 400.0, 20: 400.0},
    "wide": {19: -250.0, 20: -250.0},
    "squint": {21: 250.0, 22: 250.0, 41: 200.0, 42: 200.0},
    "lipUp": {4: -150.0, 8: -150.0, 9: -150.0},
    "nose": {61: 100.0, 62: 100.0},
}


@pytest.fixture
def rigged(head: Any) -> SimpleNamespace:
    """The default head on an armature: `head`, `rig`, and `bones`, which are posed."""
    from risorius.scene.mesh import mesh_vertices
    from risorius.scene.points.stored import stored_points

    vertices = mesh_vertices(head.data)
    points = {n: vertices[p] if isinstance(p, int) else np.asarray(p) for n, p in stored_points(head).items()}
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone("skull", (0.0, 0.02, -0.05), (0.0, 0.02, 0.1), None)
    bone("jaw", (0.0, 0.0, 0.0), points["2.1"], "skull")
    for name, point in SMALL.items():
        bone(name, points[point], points[point] + (0.0, -0.02, 0.0), "skull")
    bpy.ops.object.mode_set(mode="OBJECT")
    weights = {n: np.exp(-((np.linalg.norm(vertices - points[p], axis=1) / 0.02) ** 2)) for n, p in SMALL.items()}
    below = np.clip((points["2.2"][2] - vertices[:, 2]) / 0.01 + 0.5, 0.0, 1.0) * (vertices[:, 1] < 0.03)
    weights["jaw"] = below * (1.0 - weights["corner.L"] - weights["corner.R"])
    weights["skull"] = np.clip(1.0 - np.sum(list(weights.values()), axis=0), 0.0, 1.0)
    for name, own in weights.items():
        group = head.vertex_groups.new(name=name)
        for vertex in np.flatnonzero(own > 1e-3):
            group.add([int(vertex)], float(own[vertex]), "REPLACE")
    head.modifiers.new("Armature", "ARMATURE").object = rig
    bpy.context.view_layer.update()
    return SimpleNamespace(head=head, rig=rig, bones=rig.pose.bones)


def bone(name: str, at: Any, to: Any, parent: str | None) -> None:
    """A bone of the armature that is being edited."""
    bones = bpy.context.object.data.edit_bones
    made = bones.new(name)
    made.head, made.tail, made.parent = at, to, bones.get(parent or "")


@pytest.fixture(scope="session")
def drawn_shapes() -> dict[str, np.ndarray]:
    """Name -> (V, 3) what each key adds to the default head, metres."""
    face = api.default_face()
    shapes = {}
    for name, faps in DRAWN.items():
        frame = np.full(68, np.nan)
        for number, value in faps.items():
            frame[number - 1] = value
        shapes[name] = np.asarray(face.pose(frame, drive="exact").positions) - face.vertices
    return shapes


@pytest.fixture
def drawn_head(head: Any, drawn_shapes: dict[str, np.ndarray]) -> Any:
    """The default head with those keys."""
    head.shape_key_add(name="Basis")
    rest = np.empty(3 * len(head.data.vertices))
    head.data.vertices.foreach_get("co", rest)
    for name, moved in drawn_shapes.items():
        key = head.shape_key_add(name=name, from_mix=False)
        key.value = 0.0
        key.data.foreach_set("co", rest + moved.ravel())
    return head
