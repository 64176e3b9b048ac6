"""How bright a mesh is painted, read from images and colour attributes."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
from risorius.scene.points.painted import LUMA, paint_of


@pytest.fixture
def sheet(empty_file: None) -> Any:
    """A square of 2 by 2 with coordinates on images."""
    bpy.ops.mesh.primitive_plane_add(size=2.0)
    return bpy.context.object


def brightness(obj: Any) -> tuple[np.ndarray, np.ndarray]:
    """Places (N, 3) on an object and how bright they are."""
    paint = paint_of(obj, np.eye(3))
    assert paint is not None
    return paint.within(np.full(3, -2.0), np.full(3, 2.0), lambda positions: positions)


def painted_material(image: Any, *, between: bool) -> Any:
    """A material coloured by an image, with a node between them where asked."""
    material = bpy.data.materials.new("Skin")
    material.use_nodes = True
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    colour = texture.outputs["Color"]
    if between:
        gamma = tree.nodes.new("ShaderNodeGamma")
        tree.links.new(colour, gamma.inputs["Color"])
        colour = gamma.outputs["Color"]
    tree.links.new(colour, shader.inputs["Base Color"])
    return material


@pytest.mark.parametrize("between", [False, True])
def test_an_image_is_read_where_it_lies_on_the_mesh(sheet: Any, between: bool) -> None:
    image = bpy.data.images.new("Skin", 2, 2)
    image.pixels.foreach_set(np.repeat(np.float32([0.0, 1.0, 0.25, 0.5]), 4))
    sheet.data.materials.append(painted_material(image, between=between))
    places, bright = brightness(sheet)
    quarter = 2 * (places[:, 1] > 0.0) + (places[:, 0] > 0.0)
    expected = np.array([0.0, 1.0, 0.25, 0.5])[quarter]
    assert np.abs(bright - expected).mean() < 0.01


@pytest.mark.parametrize("domain", ["POINT", "CORNER"])
def test_colours_are_read_at_vertices_and_corners(sheet: Any, domain: str) -> None:
    colours = sheet.data.attributes.new("Col", "FLOAT_COLOR", domain)
    vertex = np.arange(4) if domain == "POINT" else np.array([loop.vertex_index for loop in sheet.data.loops])
    right = np.array([corner.co.x > 0.0 for corner in sheet.data.vertices], dtype=np.float32)[vertex]
    colours.data.foreach_set("color", np.column_stack([right, 0.0 * right, 0.0 * right, 1.0 + 0.0 * right]).ravel())
    places, bright = brightness(sheet)
    np.testing.assert_allclose(bright, LUMA[0] * (places[:, 0] + 1.0) / 2.0, atol=1e-6)


def test_plain_meshes_have_no_paint(sheet: Any) -> None:
    assert paint_of(sheet, np.eye(3)) is None
    sheet.data.materials.append(bpy.data.materials.new("Plain"))
    sheet.data.materials.append(None)
    sheet.data.attributes.new("Col", "BYTE_COLOR", "CORNER")
    assert paint_of(sheet, np.eye(3)) is None


def test_an_image_without_pixels_is_no_paint(sheet: Any) -> None:
    image = bpy.data.images.new("Lost", 4, 4)
    image.source, image.filepath = "FILE", "//lost.png"
    sheet.data.materials.append(painted_material(image, between=False))
    assert paint_of(sheet, np.eye(3)) is None
