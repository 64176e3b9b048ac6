"""The camera of a scene as labels have it."""

from __future__ import annotations

from typing import cast

import numpy as np

from ...arrays import Floats
from ...errors import SceneError
from ...labels.view import View
from ..blender_types import Lens, Scene
from ..mesh import world_matrix

#: Blender's camera axes (x right, y up, looking along -z) in those of `View`.
TURNED = np.diag([1.0, -1.0, -1.0])


def view_of(scene: Scene) -> View:
    """The camera of a scene as it stands at the current frame, through Blender's own projection matrix.

    Raises
    ------
    SceneError : there is no camera, or it is panoramic.
    """
    if scene.camera is None:
        raise SceneError(scene.name, "has no camera: add one (Add > Camera)")
    depsgraph, render = scene.view_layers[0].depsgraph, scene.render
    camera = scene.camera.evaluated_get(depsgraph)
    lens = cast("Lens", camera.data)
    if lens.type not in ("PERSP", "ORTHO"):
        raise SceneError(camera.name, "is panoramic, and labels need a flat picture: set its type to Perspective")
    share = render.resolution_percentage / 100.0
    width, height = (int(size * share) for size in (render.resolution_x, render.resolution_y))
    projection = np.array(
        camera.calc_matrix_camera(
            depsgraph, x=width, y=height, scale_x=render.pixel_aspect_x, scale_y=render.pixel_aspect_y
        ),
        dtype=np.float64,
    )
    metres = scene.unit_settings.scale_length
    is_perspective = lens.type == "PERSP"
    world = world_matrix(camera)
    axes = TURNED @ (world[:3, :3] / np.linalg.norm(world[:3, :3], axis=0)).T
    return View(
        width,
        height,
        _intrinsics(projection, width, height, is_perspective=is_perspective, metres=metres),
        axes,
        -axes @ world[:3, 3] * metres,
        is_perspective,
        lens.clip_start * metres,
        lens.clip_end * metres,
        lens.lens if is_perspective else np.nan,
        (lens.sensor_width, lens.sensor_height) if is_perspective else (np.nan, np.nan),
    )


def _intrinsics(
    projection: Floats,
    width: int,
    height: int,
    *,
    is_perspective: bool,
    metres: float,
) -> Floats:
    """(3, 3) intrinsics from an OpenGL projection (4, 4)."""
    unit = 1.0 if is_perspective else 1.0 / metres
    right, down = (-projection[0, 2], projection[1, 2]) if is_perspective else (projection[0, 3], -projection[1, 3])
    return np.array(
        [
            [projection[0, 0] * width / 2.0 * unit, 0.0, (1.0 + right) * width / 2.0],
            [0.0, projection[1, 1] * height / 2.0 * unit, (1.0 + down) * height / 2.0],
            [0.0, 0.0, 1.0],
        ]
    )
