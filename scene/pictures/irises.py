"""Irises of eyeballs that bring no colours: a picture laid on each, round however coarse the eyeball's polygons are."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...arrays import Bools, Floats, Ints
from .. import mesh as meshes
from ..attributes import write_floats, write_pixels
from ..blender_types import Image, Material, Object
from ..materials import node_tree_of, principled_of

if TYPE_CHECKING:
    from ...api import EyeballPlace, Face

#: Name of the picture and of the layer of coordinates on it.
IRISES = "Risorius irises"
#: Pixels of the picture, and how much of its half the iris takes; sclera all round, which goes on beyond its edge.
SIZE, SHARE = 256, 0.4
#: Share of the iris' radius that its dark rim takes, and how dark it is.
RIM, RIM_SHADE = 0.15, 0.4
#: Only polygons this far about the pupil have a picture, radians: behind, its middle would show again.
FRONT = 1.6


def lay_irises(
    obj: Object, face: Face, materials: Iterable[Material], *, sclera: Floats, iris: Floats, pupil: Floats
) -> None:
    """Lay the picture of an iris on the eyeballs of `obj`.

    Parameters
    ----------
    obj : the object of the whole face, vertex for vertex.
    materials : those of its eyeballs; their solid colours stay for windows that show no pictures.
    sclera, iris, pupil : (3,) linear RGB.
    """
    balls = face.eyeballs
    if not balls or obj.data.uv_layers.get(IRISES) is not None:
        return
    layer = obj.data.uv_layers.new(name=IRISES)
    if layer is None:  # a mesh has no more than eight
        return
    places, behind = np.zeros((len(face.vertices), 2)), np.zeros(len(face.vertices), dtype=bool)
    for ball in balls:
        away, angle = _seen_from(ball, face.vertices[ball.vertices])
        side = np.cross(face.axes[1], ball.gaze)
        side /= np.linalg.norm(side)
        across = np.stack([away @ side, away @ np.cross(ball.gaze, side)], axis=1)
        across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
        places[ball.vertices] = 0.5 + across * (0.5 * SHARE * angle / ball.iris)[:, None]
        behind[ball.vertices] = angle > FRONT
    corners, sizes = meshes.polygon_arrays(obj.data)
    hidden = np.logical_or.reduceat(behind[corners], np.cumsum(sizes) - sizes)
    shown = np.where(np.repeat(hidden, sizes)[:, None], 0.0, places[corners])
    write_floats(layer.data, "uv", shown)
    obj.data.uv_layers.active = layer
    layer.active_render = True
    picture = _picture(sclera, iris, pupil, float(np.mean([ball.pupil / ball.iris for ball in balls])))
    for material in materials:
        _show(material, picture)


def iris_polygons(face: Face, corners: Ints, sizes: Ints) -> tuple[Bools, Bools]:
    """(F,) polygons of irises and of pupils, by all polygons' corners (L,) and their sizes (F,)."""
    starts = np.cumsum(sizes) - sizes
    centres = np.add.reduceat(face.vertices[corners], starts) / sizes[:, None]
    iris, pupil = np.zeros(len(sizes), dtype=bool), np.zeros(len(sizes), dtype=bool)
    for ball in face.eyeballs:
        own = np.isin(corners[starts], ball.vertices)
        _, angle = _seen_from(ball, centres)
        iris |= own & (angle < ball.iris)
        pupil |= own & (angle < ball.pupil)
    return iris, pupil


def _seen_from(ball: EyeballPlace, positions: Floats) -> tuple[Floats, Floats]:
    """Directions (n, 3) of places from the middle of an eyeball, and their angles (n,) from where it looks."""
    away = positions - ball.centre
    away /= np.maximum(np.linalg.norm(away, axis=1, keepdims=True), 1e-12)
    return away, np.arccos(np.clip(away @ ball.gaze, -1.0, 1.0))


def has_irises(obj: Object) -> bool:
    """Whether an object's eyeballs show a picture."""
    return obj.type == "MESH" and obj.data.uv_layers.get(IRISES) is not None


def _picture(sclera: Floats, iris: Floats, pupil: Floats, pupil_share: float) -> Image:
    """The image: a pupil, an iris that darkens towards its rim, and sclera."""
    step = (np.arange(SIZE) + 0.5) / SIZE * 2.0 - 1.0
    radius = np.hypot(step[:, None], step[None, :]) / SHARE
    soft = 2.0 / SIZE / SHARE

    def outside(edge: float, width: float = soft) -> Floats:
        return np.asarray(np.clip((radius - edge) / width + 0.5, 0.0, 1.0))[..., None]

    colour = np.asarray(iris) * (1.0 - (1.0 - RIM_SHADE) * outside(1.0 - RIM, RIM))
    colour = np.asarray(pupil) + (colour - np.asarray(pupil)) * outside(pupil_share)
    colour = colour + (np.asarray(sclera) - colour) * outside(1.0)
    coded = np.where(colour <= 0.0031308, 12.92 * colour, 1.055 * np.maximum(colour, 0.0) ** (1.0 / 2.4) - 0.055)
    image: Image = bpy.data.images.new(IRISES, SIZE, SIZE)
    write_pixels(image, coded)
    image.pack()
    return image


def _show(material: Material, picture: Image) -> None:
    """Make a material show the picture."""
    nodes, links = node_tree_of(material).nodes, node_tree_of(material).links
    image = nodes.new("ShaderNodeTexImage")
    image.image, image.extension = picture, "EXTEND"
    where = nodes.new("ShaderNodeUVMap")
    where.uv_map = IRISES
    links.new(where.outputs["UV"], image.inputs["Vector"])
    for node in principled_of(material):
        links.new(image.outputs["Color"], node.inputs["Base Color"])
    nodes.active = image
    material.roughness = 1.0  # a highlight on a flat cornea hides the pupil
