"""A scene of its own to picture a face in: camera, light and render settings that are not the user's.

The user's scene is never changed: the face's objects are linked into a new scene beside a camera and lights, and
the whole is removed afterwards, whatever happens.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...arrays import Floats
from ...errors import ParameterError, SceneError
from ..creases.marks import unmeasured
from .framing import Framing
from .gpu_probe import REMEDY, can_draw
from .irises import has_irises

#: How much of the background's light falls on the face.
AMBIENT = 0.35


class Engine(StrEnum):
    """Who draws the picture."""

    WORKBENCH = "WORKBENCH"
    EEVEE = "EEVEE"
    CYCLES = "CYCLES"


class Camera(StrEnum):
    """Who looks: a portrait camera on the face, or the one of the user's scene, with all that is in it."""

    FACE = "FACE"
    SCENE = "SCENE"


#: Stops by which Workbench's studio light is too dark for skin.
EXPOSURE = 0.45

#: How much of the framing's height a picture shows; 1 is head and neck with air around them.
CLOSENESS = 0.93


@dataclass(frozen=True)
class Look:
    """How a face is pictured.

    Attributes
    ----------
    engine : who draws it.
    width, height : pixels.
    yaw : how far the camera stands to the subject's left, radians.
    background : linear RGB.
    camera : on the face, or the scene's own with its lights, world, objects and view settings.
    fine : for stills: twice the smoothing, and shading that shows every fold. Three times as long without a GPU.
    """

    engine: Engine = Engine.WORKBENCH
    width: int = 512
    height: int = 512
    yaw: float = 0.17
    background: tuple[float, float, float] = (0.42, 0.45, 0.48)
    camera: Camera = Camera.FACE
    fine: bool = False

    def __post_init__(self) -> None:
        for name in ("width", "height"):
            size = getattr(self, name)
            if not (16 <= size <= 8192 and size % 2 == 0):
                raise ParameterError(name, "must be an even number of pixels from 16 to 8192", size)


def usable_engine(wanted: Engine) -> tuple[Engine, str | None]:
    """The engine that can draw here, and a remark where it is another than `wanted`."""
    if wanted is not Engine.CYCLES and not can_draw():
        return Engine.CYCLES, REMEDY
    return wanted, None


@contextmanager
def studio(objects: Sequence[Any], framing: Framing, look: Look) -> Iterator[Any]:
    """A temporary scene that shows `objects`, ready to render; removed on leaving with all that was made for it.

    Raises
    ------
    SceneError : the engine is not available, or the scene's own camera is wanted and there is none.
    """
    made: list[Any] = []
    scene = bpy.data.scenes.new("Risorius Studio")
    try:
        source = bpy.context.scene
        scene.unit_settings.scale_length = source.unit_settings.scale_length
        scene.frame_set(source.frame_current)
        scene.render.fps, scene.render.fps_base = source.render.fps, source.render.fps_base
        if look.camera is Camera.SCENE:
            _borrow(scene, source, look)
        else:
            for obj in objects:
                scene.collection.objects.link(obj)
            made = furnish(scene, framing, look)
        draws_wrinkles = scene.render.engine != "BLENDER_WORKBENCH"
        with nullcontext() if draws_wrinkles else unmeasured(objects):
            yield scene
    finally:
        bpy.data.scenes.remove(scene)
        for datablock in made:
            _discard(datablock)


def _borrow(scene: Any, source: Any, look: Look) -> None:
    """Show all that the user's scene shows, through its own camera."""
    if source.camera is None:
        raise SceneError(source.name, "has no camera: add one (Add > Camera), or set Camera to Portrait")
    for obj in source.collection.objects:
        scene.collection.objects.link(obj)
    for collection in source.collection.children:
        scene.collection.children.link(collection)
    _settings(scene, look)
    scene.camera, scene.world = source.camera, source.world
    for name in ("view_transform", "look", "exposure", "gamma"):
        setattr(scene.view_settings, name, getattr(source.view_settings, name))


def furnish(scene: Any, framing: Framing, look: Look) -> list[Any]:
    """Give a scene a camera, lights, a world and render settings for the face; returns the new datablocks.

    Raises
    ------
    SceneError : the engine is not available.
    """
    _settings(scene, look)
    if any(has_irises(obj) for obj in scene.objects):
        scene.display.shading.color_type = "TEXTURE"
    return [_camera(scene, framing, look), *_lights(scene, framing), _world(scene, look)]


def _discard(datablock: Any) -> None:
    """Remove a temporary object with its data, or a world."""
    if isinstance(datablock, bpy.types.World):
        bpy.data.worlds.remove(datablock)
        return
    data = datablock.data
    bpy.data.objects.remove(datablock)
    owner = bpy.data.cameras if isinstance(data, bpy.types.Camera) else bpy.data.lights
    owner.remove(data)


def aim(position: Floats, target: Floats, up: Floats) -> Any:
    """(4, 4) matrix of a camera or light at `position` that looks at `target`."""
    back = Vector(position - target).normalized()
    right = Vector(up).cross(back).normalized()
    return Matrix.Translation(Vector(position)) @ Matrix([right, back.cross(right), back]).transposed().to_4x4()


def _camera(scene: Any, framing: Framing, look: Look) -> Any:
    """The camera: an 85 mm portrait lens, a little to the side."""
    data = bpy.data.cameras.new("Risorius Camera")
    data.lens, data.sensor_fit, data.sensor_height = 85.0, "VERTICAL", 24.0
    camera = bpy.data.objects.new("Risorius Camera", data)
    shown = max(CLOSENESS, 0.8 * CLOSENESS * look.height / look.width)
    distance = shown * 85.0 / 24.0
    position = framing.point(distance * np.sin(look.yaw), 0.02, distance * np.cos(look.yaw))
    camera.matrix_world = aim(position, framing.centre, framing.up)
    data.clip_start, data.clip_end = 0.01 * framing.height, 100.0 * framing.height
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def _lights(scene: Any, framing: Framing) -> list[Any]:
    """Key, fill and rim light for EEVEE and Cycles; Workbench has its own."""
    made = []
    for name, place, size, power in (
        ("Key", (1.1, 0.9, 1.6), 0.9, 26.0),
        ("Fill", (-1.5, 0.1, 1.3), 1.5, 8.0),
        ("Rim", (-0.9, 1.1, -1.3), 0.7, 12.0),
    ):
        data = bpy.data.lights.new(f"Risorius {name}", "AREA")
        data.size = size * framing.height
        data.energy = power * framing.height**2
        light = bpy.data.objects.new(f"Risorius {name}", data)
        light.matrix_world = aim(framing.point(*place), framing.centre, framing.up)
        scene.collection.objects.link(light)
        made.append(light)
    return made


def _world(scene: Any, look: Look) -> Any:
    """An even background to look at, that lights the face only a little."""
    world = bpy.data.worlds.new("Risorius World")
    world.color = look.background
    if world.node_tree is None:
        world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    background = next(node for node in nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (*look.background, 1.0)
    seen = nodes.new("ShaderNodeLightPath")
    strength = nodes.new("ShaderNodeMapRange")
    strength.inputs["To Min"].default_value, strength.inputs["To Max"].default_value = AMBIENT, 1.0
    links.new(seen.outputs["Is Camera Ray"], strength.inputs["Value"])
    links.new(strength.outputs["Result"], background.inputs["Strength"])
    scene.world = world
    return world


def _settings(scene: Any, look: Look) -> None:
    """Render settings of the temporary scene."""
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = look.width, look.height, 100
    render.use_file_extension = render.use_overwrite = True
    render.use_compositing = render.use_sequencer = False
    engine = _set_engine(scene, look)
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.look = "None"
    scene.view_settings.exposure = EXPOSURE if engine is Engine.WORKBENCH else 0.0
    render.image_settings.file_format = "PNG"
    render.image_settings.color_mode = "RGB"
    scene.display.render_aa = "16" if look.fine else "5"
    shading = scene.display.shading
    shading.light, shading.color_type = "STUDIO", "MATERIAL"
    shading.show_cavity, shading.cavity_type = True, "BOTH" if look.fine else "SCREEN"
    shading.cavity_ridge_factor, shading.cavity_valley_factor = 0.4, 1.0
    shading.curvature_ridge_factor, shading.curvature_valley_factor = 0.2, 0.7
    shading.show_shadows, shading.show_specular_highlight = False, True


def _set_engine(scene: Any, look: Look) -> Engine:
    """Choose the render engine by what this Blender calls it, and say which it is."""
    engine, _ = usable_engine(look.engine)
    names = {
        Engine.WORKBENCH: ("BLENDER_WORKBENCH",),
        Engine.EEVEE: ("BLENDER_EEVEE", "BLENDER_EEVEE_NEXT"),
        Engine.CYCLES: ("CYCLES",),
    }[engine]
    for name in names:
        try:
            scene.render.engine = name
        except TypeError:
            continue
        break
    else:
        raise SceneError(engine.value.title(), "is not available in this Blender: choose another engine")
    if engine is Engine.CYCLES:
        scene.cycles.samples = 64 if look.fine else 16
        scene.cycles.use_denoising = True
    return engine


def render_frame(scene: Any, frame: int, folder: Path) -> Path:
    """Render one frame of a studio scene to a numbered PNG in `folder`.

    As an animation of one frame: a still is rendered without evaluating shape keys anew in a scene that no window
    shows, and would show the resting face.
    """
    scene.frame_start = scene.frame_end = frame
    scene.render.filepath = str(folder / "####.png")
    path = Path(scene.render.frame_path(frame=frame))
    bpy.ops.render.render(animation=True, scene=scene.name)
    if not path.is_file():
        raise SceneError(str(path), "was not written: choose a folder you may write to")
    return path
