"""Where places fall in the picture, against Blender's own answer."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Euler, Vector
from risorius.errors import SceneError
from risorius.scene.labels.lens import view_of

#: What a camera may be set to.
CAMERAS: dict[str, dict[str, Any]] = {
    "usual": {},
    "long lens, shifted": {"lens": 135.0, "shift_x": 0.13, "shift_y": -0.21},
    "sensor fitted upright": {"sensor_fit": "VERTICAL", "sensor_height": 24.0, "lens": 85.0},
    "sensor fitted across": {"sensor_fit": "HORIZONTAL", "sensor_width": 22.3},
    "without perspective": {"type": "ORTHO", "ortho_scale": 1.7, "shift_x": 0.1},
}


def camera(settings: dict[str, Any]) -> Any:
    """A camera set up askew, and scaled, in the current scene."""
    data = bpy.data.cameras.new("Eye")
    for name, value in settings.items():
        setattr(data, name, value)
    obj = bpy.data.objects.new("Eye", data)
    obj.location, obj.rotation_euler, obj.scale = (0.3, -2.0, 0.4), Euler((1.3, 0.15, 0.2)), (2.0, 2.0, 2.0)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.scene.camera = obj
    return obj


@pytest.mark.parametrize("settings", CAMERAS.values(), ids=CAMERAS)
@pytest.mark.parametrize(("width", "height", "aspect", "share"), [(640, 480, 1.0, 100), (300, 500, 1.5, 50)])
@pytest.mark.parametrize("metres", [1.0, 0.01])
def test_a_place_falls_where_blender_says(
    settings: dict[str, Any], width: int, height: int, aspect: float, share: int, metres: float
) -> None:
    scene, eye = bpy.context.scene, camera(settings)
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, share
    render.pixel_aspect_x = aspect
    scene.unit_settings.scale_length = metres
    bpy.context.view_layer.update()
    view = view_of(scene)
    places = np.random.default_rng(3).normal(size=(50, 3)) * 0.4
    before = view.before(places * metres)
    pixels = view.pixels(before)
    told = np.array([world_to_camera_view(scene, eye, Vector(place)) for place in places])
    told[:, 1] = 1.0 - told[:, 1]
    shown = told[:, 2] > 0.0
    assert shown.sum() > 20
    assert (view.width, view.height) == (width * share // 100, height * share // 100)
    np.testing.assert_allclose(before[:, 2], told[:, 2] * metres, atol=1e-6)
    np.testing.assert_allclose(pixels[shown], (told[:, :2] * [view.width, view.height])[shown], atol=2e-3)


def test_a_panoramic_camera_is_refused_with_the_remedy() -> None:
    camera({"type": "PANO"})
    bpy.context.view_layer.update()
    with pytest.raises(SceneError, match="Perspective"):
        view_of(bpy.context.scene)
