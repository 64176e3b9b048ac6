"""A mesh that brings no materials is painted: round irises on its eyeballs, a dark mouth behind its lips."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.face.mesh.parts import Part
from risorius.scene import mesh as meshes
from risorius.scene.faces import face_of, read_face
from risorius.scene.jobs.painting import PLAIN_COLOURS, paint_parts
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.irises import IRISES
from risorius.scene.pictures.look import Look
from risorius.scene.pictures.studio import studio
from risorius.scene.points.stored import store_points


@pytest.fixture
def plain() -> Any:
    """The default head as a mesh without materials."""
    head = api.build_default_head()
    mesh = meshes.new_mesh("plain", head.vertices, *meshes.flatten_polygons(head.polygons))
    meshes.write_parts(mesh, head.parts)
    obj = bpy.data.objects.new("plain", mesh)
    bpy.context.collection.objects.link(obj)
    store_points(obj, {name: tuple(head.position(name).tolist()) for name in head.points})
    return obj


def painted(obj: Any, name: str) -> np.ndarray:
    """(F,) which polygons have a colour."""
    index = np.empty(len(obj.data.polygons), dtype=np.int32)
    obj.data.polygons.foreach_get("material_index", index)
    return index == list(PLAIN_COLOURS).index(name)


def seen_colours(obj: Any) -> tuple[np.ndarray, np.ndarray]:
    """Vertex (L,) of each corner, and what the picture shows there (L, 3)."""
    corners, _ = meshes.polygon_arrays(obj.data)
    uv = np.empty(2 * len(corners), dtype=np.float32)
    obj.data.uv_layers[IRISES].data.foreach_get("uv", uv)
    image = bpy.data.images[IRISES]
    pixels = np.array(image.pixels[:]).reshape(*image.size, 4)
    column, row = np.clip((uv.reshape(-1, 2) * image.size[0]).astype(int), 0, image.size[0] - 1).T
    return corners, pixels[row, column, :3]


def test_the_picture_on_an_eyeball_is_dark_in_the_pupil_and_light_beyond_the_iris(plain: Any) -> None:
    paint_parts(plain)
    corners, colours = seen_colours(plain)
    light = colours.sum(axis=1)
    for ball in face_of(read_face(plain)).anatomy.eyeballs:
        away = ball.positions - ball.centre
        angle = np.arccos(np.clip(away @ ball.gaze / np.linalg.norm(away, axis=1), -1.0, 1.0))
        white = np.isin(corners, ball.index[angle > 1.1 * ball.iris])
        iris = np.isin(corners, ball.index[(angle > 1.2 * ball.pupil) & (angle < 0.9 * ball.iris)])
        pupil = np.isin(corners, ball.index[angle < 0.9 * ball.pupil])
        assert min(white.sum(), iris.sum(), pupil.sum()) > 0
        assert light[white].min() > 2.4
        assert light[pupil].max() < 0.5 < light[iris].min()
        assert light[iris].max() < 1.6


def test_the_studio_shows_the_picture(plain: Any) -> None:
    with studio([plain], framing_of(plain), Look()) as scene:
        assert scene.display.shading.color_type == "MATERIAL"
    paint_parts(plain)
    with studio([plain], framing_of(plain), Look()) as scene:
        assert scene.display.shading.color_type == "TEXTURE"


def test_the_mouth_behind_the_lips_is_dark_and_nothing_else(plain: Any) -> None:
    paint_parts(plain)
    face = face_of(read_face(plain))
    mouth = painted(plain, "Mouth")
    assert mouth.sum() > 50
    corners = np.unique(np.concatenate([np.asarray(face.polygons[k]) for k in np.flatnonzero(mouth)]))
    assert (np.asarray(face.parts)[corners] == Part.SKIN).all()
    places = face.vertices[corners]
    lips = face.points["2.2"].position
    assert np.abs(places[:, 0]).max() < 0.05
    assert places[:, 1].min() > lips[1] - 0.006
    assert places[:, 2].max() < face.points["9.3"].position[2]
