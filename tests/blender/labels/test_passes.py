"""Depth and normals as drawn here against those that Cycles traces."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.labels.pictures import normals_of
from risorius.labels.raster import Triangles, draw
from risorius.scene.faces import read_face
from risorius.scene.labels.lens import view_of
from risorius.scene.labels.stage import stage_of
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.look import Engine, Look
from risorius.scene.pictures.studio import studio

SIZE = 96


def showing(output: str, node: str) -> Any:
    """A material that shines with what a node tells, in the world's axes."""
    material = bpy.data.materials.new(output)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    source, light, out = (tree.nodes.new(name) for name in (node, "ShaderNodeEmission", "ShaderNodeOutputMaterial"))
    tree.links.new(source.outputs[output], light.inputs["Color"])
    tree.links.new(light.outputs["Emission"], out.inputs["Surface"])
    return material


def traced(scene: Any, material: Any, path: Path) -> Any:
    """(height, width, 3) figures that Cycles sees at the middle of each pixel."""
    scene.view_layers[0].material_override = material
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = 1, False, False
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True, scene=scene.name)
    image = bpy.data.images.load(scene.render.frame_path(frame=scene.frame_current) if not path.exists() else str(path))
    return np.array(image.pixels[:]).reshape(SIZE, SIZE, 4)[::-1, :, :3]


@pytest.mark.slow
def test_depth_and_normals_are_those_that_cycles_traces(head: Any, tmp_path: Path) -> None:
    head.rotation_euler, head.location = (0.1, 0.2, 0.5), (0.3, -0.1, 0.2)
    bpy.context.view_layer.update()
    look = Look(engine=Engine.CYCLES, width=SIZE, height=SIZE, yaw=0.4, background=(0.0, 0.0, 0.0))
    with studio([head], framing_of(head), look) as scene:
        depth = traced(scene, showing("View Z Depth", "ShaderNodeCameraData"), tmp_path / "depth.exr")[..., 0]
        normals = traced(scene, showing("Normal", "ShaderNodeNewGeometry"), tmp_path / "normals.exr")
        scene.view_layers[0].update()
        view = view_of(scene)
        shown = stage_of(scene, read_face(head).pieces).shown
    drawn = draw(Triangles.of(view, view.before(shown.vertices), shown.triangles))
    there = depth > 0.1
    assert (there != drawn.there).sum() <= 2  # pixels whose middle lies on an outline
    both = there & drawn.there
    off = np.abs(depth - drawn.depth)[both]
    assert np.median(off) < 1e-5
    assert (off > 1e-3).mean() < 0.002
    ours = normals_of(view, shown, drawn)[both]
    theirs = normals[both] @ view.rotation.T
    assert np.median(np.abs(ours - theirs).max(axis=1)) < 1e-3
    assert (np.abs(ours - theirs).max(axis=1) > 0.05).mean() < 0.01
