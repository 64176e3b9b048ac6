"""Text as pixels, written with Blender's own font: text objects in a scene of their own, rendered from above."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import bpy

from ...arrays import Floats
from ..attributes import read_pixels, write_pixels
from ..blender_types import Object, Scene, World
from ..materials import new_material, node_tree_of
from .look import Engine, usable_engine

#: Height of a line in letter sizes.
LINE = 1.45


@dataclass(frozen=True)
class Text:
    """Lines of text: the left (or right) end of the first one's baseline in pixels from the top left, and a size."""

    lines: tuple[str, ...]
    x: float
    y: float
    size: float
    right: bool = False


def write_text(texts: Sequence[Text], width: int, height: int, folder: Path) -> Floats:
    """(height, width, 3) black letters on white, 0..1, first row at the top; `folder` is for a passing file."""
    scene = bpy.data.scenes.new("Risorius Lettering")
    made: list[Object] = []
    try:
        made = [_text_object(scene, text) for text in texts]
        made.append(_camera(scene, width, height))
        _settings(scene, width, height)
        path = folder / "lettering.png"
        scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True, scene=scene.name)
        return read_picture(path)
    finally:
        world, material = scene.world, bpy.data.materials.get(INK)
        bpy.data.scenes.remove(scene)
        for obj in made:
            data = obj.data
            bpy.data.objects.remove(obj)
            (bpy.data.curves if isinstance(data, bpy.types.Curve) else bpy.data.cameras).remove(data)
        if world is not None:
            bpy.data.worlds.remove(world)
        if material is not None and material.users == 0:
            bpy.data.materials.remove(material)


INK = "Risorius Ink"


def _text_object(scene: Scene, text: Text) -> Object:
    """One text object; a pixel is a unit."""
    curve = bpy.data.curves.new("Risorius Text", "FONT")
    curve.body = "\n".join(text.lines)
    curve.size = text.size
    curve.space_line = LINE
    curve.align_x = "RIGHT" if text.right else "LEFT"
    curve.materials.append(bpy.data.materials.get(INK) or new_material(INK, (0.0, 0.0, 0.0), roughness=1.0))
    obj: Object = bpy.data.objects.new("Risorius Text", curve)
    obj.location = (text.x, -text.y, 0.0)
    scene.collection.objects.link(obj)
    return obj


def _camera(scene: Scene, width: int, height: int) -> Object:
    """A camera straight above that sees width x height units."""
    data = bpy.data.cameras.new("Risorius Lettering")
    data.type, data.ortho_scale = "ORTHO", float(max(width, height))
    camera: Object = bpy.data.objects.new("Risorius Lettering", data)
    camera.location = (0.5 * width, -0.5 * height, 10.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def _settings(scene: Scene, width: int, height: int) -> None:
    """Flat black on white."""
    engine, _ = usable_engine(Engine.WORKBENCH)
    render = scene.render
    render.engine = "BLENDER_WORKBENCH" if engine is Engine.WORKBENCH else "CYCLES"
    if engine is Engine.CYCLES:
        scene.cycles.samples = 8
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format, render.image_settings.color_mode = "PNG", "RGB"
    render.use_compositing = render.use_sequencer = False
    scene.view_settings.view_transform = "Standard"
    scene.display.render_aa = "16"
    shading = scene.display.shading
    shading.light, shading.color_type = "FLAT", "MATERIAL"
    world: World = bpy.data.worlds.new("Risorius Paper")
    world.color = (1.0, 1.0, 1.0)
    for node in node_tree_of(world).nodes:
        if node.type == "BACKGROUND":
            node.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    scene.world = world


def read_picture(path: Path) -> Floats:
    """(height, width, 3) of a picture file as stored, 0..1, first row at the top."""
    image = bpy.data.images.load(str(path))
    try:
        return read_pixels(image)
    finally:
        bpy.data.images.remove(image)


def write_picture(pixels: Floats, path: Path) -> Path:
    """Write (height, width, 3) pixels, 0..1, first row at the top, as a PNG."""
    height, width, _ = pixels.shape
    image = bpy.data.images.new("Risorius Picture", width, height, alpha=False)
    try:
        write_pixels(image, pixels)
        image.filepath_raw, image.file_format = str(path), "PNG"
        image.save()
    finally:
        bpy.data.images.remove(image)
    return path
