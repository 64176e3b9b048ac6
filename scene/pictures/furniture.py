"""Camera, lights and world of a scene in which a face is pictured."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...arrays import Floats
from ..blender_types import Object, Scene, World
from ..materials import Colour, node_tree_of
from .framing import Framing
from .irises import has_irises
from .look import Lighting, Look, apply_look

#: How much of the framing's height a picture shows: 1 is head and neck with air around them, this is the face.
CLOSENESS = 0.85
#: How high the picture is, mm, for which a lens is named.
FILM = 24.0
#: Height that the framing of a life-size face shows, the default head's, metres.
LIFE_SIZE = 0.288


@dataclass(frozen=True)
class Furniture:
    """What was made for a scene."""

    camera: Object
    lights: tuple[Object, ...]
    world: World


def furnish(scene: Scene, framing: Framing, look: Look) -> Furniture:
    """Give a scene a camera, lights, a world and render settings for the face; returns what is new.

    Raises
    ------
    SceneError : the engine is not available.
    """
    apply_look(scene, look)
    if look.lighting.stays:
        shading, forward = scene.display.shading, framing.forward
        shading.use_world_space_lighting = True
        shading.studiolight_rotate_z = -look.lighting.yaw - float(np.arctan2(forward[0], -forward[1]))
    if any(has_irises(obj) for obj in scene.objects):
        scene.display.shading.color_type = "TEXTURE"
    return Furniture(_camera(scene, framing, look), tuple(_lights(scene, framing, look.lighting)), _world(scene, look))


def discard(made: Furniture) -> None:
    """Take it away again, with its data."""
    for obj in (made.camera, *made.lights):
        data: object = obj.data
        bpy.data.objects.remove(obj)
        owner = bpy.data.cameras if isinstance(data, bpy.types.Camera) else bpy.data.lights
        owner.remove(data)
    bpy.data.worlds.remove(made.world)


def carry(scene: Scene, motion: Floats) -> None:
    """Move the camera and the lights of a furnished scene by a (4, 4) motion."""
    for obj in scene.collection.objects:
        if obj.type in {"CAMERA", "LIGHT"}:
            obj.matrix_world = Matrix(motion.tolist()) @ obj.matrix_world


def aim(position: Floats, target: Floats, up: Floats) -> Matrix:
    """(4, 4) matrix of a camera or light at `position` that looks at `target`."""
    back = Vector(position - target).normalized()
    right = Vector(up).cross(back).normalized()
    return Matrix.Translation(Vector(position)) @ Matrix([right, back.cross(right), back]).transposed().to_4x4()


def _camera(scene: Scene, framing: Framing, look: Look) -> Object:
    """The camera: a portrait lens, a little to the side where nothing else is said."""
    data = bpy.data.cameras.new("Risorius Camera")
    data.lens, data.sensor_fit, data.sensor_height = look.lens, "VERTICAL", FILM
    camera: Object = bpy.data.objects.new("Risorius Camera", data)
    position = framing.point(*_turned((0.0, 0.0, _distance(look)), look.yaw, look.pitch))
    position = position + 0.02 * framing.height * framing.up
    camera.matrix_world = aim(position, framing.centre, framing.up) @ Matrix.Rotation(-look.roll, 4, "Z")
    data.clip_start, data.clip_end = 0.01 * framing.height, max(100.0, 2.0 * _distance(look)) * framing.height
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def _distance(look: Look) -> float:
    """How far the camera stands from the face, as a multiple of the framing's height."""
    if look.distance is not None:
        return look.distance / LIFE_SIZE
    return max(CLOSENESS, 0.8 * CLOSENESS * look.height / look.width) * look.lens / FILM


def _turned(place: tuple[float, float, float], yaw: float, pitch: float = 0.0) -> tuple[float, float, float]:
    """A place (left, up, forward) of a face raised by `pitch`, then turned by `yaw` to the subject's left, radians."""
    left, up, forward = place
    up, forward = up * np.cos(pitch) + forward * np.sin(pitch), forward * np.cos(pitch) - up * np.sin(pitch)
    return left * np.cos(yaw) + forward * np.sin(yaw), up, forward * np.cos(yaw) - left * np.sin(yaw)


def _lights(scene: Scene, framing: Framing, lighting: Lighting) -> list[Object]:
    """Key, fill and rim light for EEVEE and Cycles; Workbench has its own."""
    made = []
    for name, place, size, power in (
        ("Key", (0.75, 1.25, 1.35), 0.5, 32.0),
        ("Fill", (-1.3, 0.2, 1.5), 1.2, 6.0),
        ("Rim", (-0.9, 1.1, -1.3), 0.7, 6.0),
    ):
        data = bpy.data.lights.new(f"Risorius {name}", "AREA")
        data.size = size * framing.height
        data.energy = power * lighting.strength * framing.height**2
        light: Object = bpy.data.objects.new(f"Risorius {name}", data)
        light.matrix_world = aim(framing.point(*_turned(place, lighting.yaw)), framing.centre, framing.up)
        scene.collection.objects.link(light)
        made.append(light)
    return made


def _behind(scene: Scene, look: Look) -> Colour:
    """Linear RGB of the world behind the face."""
    if look.backdrop is None:
        return look.background
    red, green, blue = (share / 2.0**scene.view_settings.exposure for share in look.backdrop)
    return red, green, blue


def _world(scene: Scene, look: Look) -> World:
    """An even background to look at, that lights the face only a little."""
    world: World = bpy.data.worlds.new("Risorius World")
    colour = _behind(scene, look)
    world.color = colour
    nodes, links = node_tree_of(world).nodes, node_tree_of(world).links
    background = next(node for node in nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (*colour, 1.0)
    seen = nodes.new("ShaderNodeLightPath")
    strength = nodes.new("ShaderNodeMapRange")
    strength.inputs["To Min"].default_value, strength.inputs["To Max"].default_value = look.lighting.ambient, 1.0
    links.new(seen.outputs["Is Camera Ray"], strength.inputs["Value"])
    links.new(strength.outputs["Result"], background.inputs["Strength"])
    scene.world = world
    return world
