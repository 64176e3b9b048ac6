"""Contact sheets: the muscles' own poses above, the same emotions on a head's own keys below."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import risorius.api as api
from risorius.api import Retargeting
from risorius.arrays import Floats

from .heads import KeyedHead
from .measuring import WORDS

SIDE, YAWS = 300, (0.0, 0.6)


def write_sheet(head: KeyedHead, path: Path) -> None:
    """Write the sheet of a head: at rest and six emotions; two rows from the front, two from its left.

    Needs Blender's module.
    """
    obj = _object(head)
    own, keyed = _poses(head)
    rows = []
    for yaw in YAWS:
        for poses in (own, keyed):
            rows.append(_row(obj, [head.face.vertices, *poses], yaw))
    from risorius.scene.pictures.lettering import write_picture

    path.parent.mkdir(parents=True, exist_ok=True)
    write_picture(np.concatenate(rows, axis=0), path)


def _poses(head: KeyedHead) -> tuple[list[Floats], list[Floats]]:
    """Positions (V, 3) of the six emotions, by the muscles and on the keys."""
    retargeting = Retargeting(head.face, head.keys)
    own, keyed = [], []
    for word in WORDS:
        profile = api.expression(word)
        own.append(head.face.pose(profile.frame(), emotion=profile.weights).positions)
        take = retargeting.take()
        take.add(own[-1])
        found = retargeting.values(take, requested=profile.frame())
        keyed.append(head.face.vertices + retargeting.controls.displacement(found.values[0]))
    return own, keyed


def _object(head: KeyedHead) -> Any:
    """The head as an object, upright, its feature points stored, its parts painted."""
    import bpy
    from risorius.scene import mesh as meshes
    from risorius.scene.jobs.painting import paint_parts
    from risorius.scene.points.stored import store_points

    bpy.ops.wm.read_factory_settings(use_empty=True)
    flat = meshes.flatten_polygons(head.face.polygons)
    mesh = meshes.new_mesh("Head", head.face.vertices, *flat)
    meshes.write_parts(mesh, head.face.parts)
    obj = bpy.data.objects.new("Head", mesh)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    store_points(obj, head.face.points.nearest)
    paint_parts(obj)
    bpy.context.view_layer.update()
    return obj


def _row(obj: Any, poses: list[Floats], yaw: float) -> Floats:
    """(SIDE, N SIDE, 3) pictures of poses (V, 3) side by side."""
    from risorius.scene.pictures.framing import framing_of
    from risorius.scene.pictures.lettering import read_picture
    from risorius.scene.pictures.look import Look
    from risorius.scene.pictures.studio import render_frame, studio

    seen = []
    with (
        tempfile.TemporaryDirectory() as folder,
        studio([obj], framing_of(obj), Look(width=SIDE, height=SIDE, yaw=yaw)) as scene,
    ):
        for number, positions in enumerate(poses):
            obj.data.vertices.foreach_set("co", positions.astype(np.float32).ravel())
            obj.data.update()
            seen.append(read_picture(render_frame(scene, number + 1, Path(folder))))
    obj.data.vertices.foreach_set("co", poses[0].astype(np.float32).ravel())
    return np.concatenate(seen, axis=1)
