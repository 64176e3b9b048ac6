"""A face as a Blender object that takes any positions and is pictured in them."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import Any, Self

import bpy
import numpy as np
import risorius.api as api
from risorius.api import Face
from risorius.arrays import Floats
from risorius.scene import mesh as meshes
from risorius.scene.head import head_object
from risorius.scene.jobs.painting import paint_parts
from risorius.scene.pictures.framing import Framing, framing_of
from risorius.scene.pictures.lettering import read_picture
from risorius.scene.pictures.look import Look
from risorius.scene.pictures.studio import render_frame, studio
from risorius.scene.points.stored import store_points

from .heads import lash_vertices

#: The face fills the picture: of the height that a portrait shows, this much, about a centre so much lower and deeper.
CLOSENESS, LOWER, DEEPER = 0.8315, 0.045, 0.14

_COLOUR = "faithful"


class View(StrEnum):
    """Where the camera stands."""

    FRONT = "front"
    THREE_QUARTER = "three-quarter"

    @property
    def yaw(self) -> float:
        """How far to the subject's left, radians."""
        return 0.0 if self is View.FRONT else float(np.radians(38.0))


class Sitter:
    """One face that is pictured in any positions."""

    def __init__(
        self,
        objects: Sequence[Any],
        *,
        width: int = 360,
        height: int = 432,
        fine: bool = False,
        framing: Framing | None = None,
        look: Look | None = None,
        relight: Callable[[Any, Framing], None] | None = None,
    ) -> None:
        """`objects`: the face, then what is pictured with it; `width`, `height` in even pixels; `fine` as in `Look`.

        `framing`: by default the face fills the picture. `look` takes the place of the size and `fine`; the view is
        that of each shot. `relight` changes the lights of the scene in which it is pictured.
        """
        self._object, self._objects = objects[0], list(objects)
        self._look = look or Look(width=width, height=height, fine=fine)
        self._framing, self._relight = framing or _close(framing_of(self._object)), relight

    @classmethod
    def of_head(cls, name: str, face: Face, *, width: int = 360, height: int = 432, fine: bool = False) -> Self:
        """A head of `HEADS` in an otherwise empty Blender file."""
        return cls([object_alone(name, face)], width=width, height=height, fine=fine)

    def shots(
        self, poses: Sequence[Floats], view: View | float, colours: Sequence[Floats] | None = None
    ) -> list[Floats]:
        """Pictures (height, width, 3) of poses (V, 3) in the face's coordinates.

        `view`: or how far to the subject's left the camera stands, radians. `colours`, one (V, 3) linear RGB per
        pose, take the place of the materials.
        """
        mesh = self._object.data
        pictures = []
        look = replace(self._look, yaw=view.yaw if isinstance(view, View) else view)
        with (
            tempfile.TemporaryDirectory(prefix="risorius-") as folder,
            studio(self._objects, self._framing, look) as scene,
        ):
            if self._relight is not None:
                self._relight(scene, self._framing)
            if colours is not None:
                scene.display.shading.color_type = "VERTEX"
            for number, positions in enumerate(poses, 1):
                mesh.vertices.foreach_set("co", np.ascontiguousarray(positions, dtype=np.float32).ravel())
                if colours is not None:
                    _paint(mesh, colours[number - 1])
                mesh.update()
                pictures.append(read_picture(render_frame(scene, number, Path(folder))))
        return pictures


def _close(framing: Framing) -> Framing:
    """The face rather than head and neck."""
    return replace(framing, centre=framing.point(0.0, -LOWER, -DEEPER), height=CLOSENESS * framing.height)


def object_alone(name: str, face: Face) -> Any:
    """A head of `HEADS` as the one object of a Blender file that is otherwise empty."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    if name != "default":
        return _plain_object(name, face)
    obj = head_object(api.build_default_head(), name)
    bpy.context.collection.objects.link(obj)
    return obj


def _plain_object(name: str, face: Face) -> Any:
    """An object for a face that brings no materials, coloured by its parts, in the scene; lash strips are not drawn."""
    lashes = lash_vertices(name)
    drawn = [polygon for polygon in face.polygons if not lashes[polygon[0]]]
    mesh = meshes.new_mesh(name, face.vertices, *meshes.flatten_polygons(drawn))
    meshes.write_parts(mesh, face.parts)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    store_points(obj, {n: tuple(point.position.tolist()) for n, point in face.points.items()})
    paint_parts(obj)
    return obj


def _paint(mesh: Any, colours: Floats) -> None:
    """Store (V, 3) linear RGB as the mesh's active colours."""
    layer = mesh.color_attributes.get(_COLOUR) or mesh.color_attributes.new(_COLOUR, "FLOAT_COLOR", "POINT")
    mesh.color_attributes.active_color = layer
    rgba = np.concatenate([colours, np.ones((len(colours), 1))], axis=1)
    layer.data.foreach_set("color", np.ascontiguousarray(rgba, dtype=np.float32).ravel())
