"""How bright a mesh is painted: the images of its materials, else its colour attribute."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...arrays import Floats, Ints
from .. import mesh as meshes
from ..attributes import read_floats, read_ints, read_pixels
from ..blender_types import Image, Material, Mesh, Node, NodeTree, Object

if TYPE_CHECKING:
    from ...face.fit.surface.paint import Brightness, Paint

#: How much red, green and blue count (ITU-R BT.601).
LUMA = np.array([0.299, 0.587, 0.114])
#: Larger images are passed over: reading one would take seconds. Of others so many rows are kept at most.
LARGEST, ROWS = 8192 * 8192, 2048
#: So many nodes may lie between an image and a shader.
HOPS = 6
#: Colours that differ by less than this all over are no paint.
PLAIN = 0.02


def paint_of(obj: Object, stretch: Floats) -> Paint | None:
    """The paint of a mesh object, or None where it has none.

    Parameters
    ----------
    stretch : (3, 3) from the mesh's own coordinates to those that its face is sought in.
    """
    from ...face.fit.surface.paint import Paint

    mesh = obj.data
    brightness = _of_images(mesh) or _of_colours(mesh)
    if brightness is None:
        return None
    vertices = meshes.rest_vertices(mesh) @ stretch.T
    return Paint(vertices[meshes.triangle_corners(mesh)], brightness)


def _of_images(mesh: Mesh) -> Brightness | None:
    """Brightness of the images that the materials of a mesh are coloured by; None where none is."""
    from ...face.fit.surface.paint import of_image

    layer = next((layer for layer in mesh.uv_layers if layer.active_render), None)
    images = {number: _image_of(material) for number, material in enumerate(mesh.materials)}
    pictures = {number: _luminance(image) for number, image in images.items() if image is not None}
    if layer is None or not pictures:
        return None
    uv = read_floats(layer.data, "uv", 2)[read_ints(mesh.loop_triangles, "loops", 3)]
    material = read_ints(mesh.loop_triangles, "material_index")
    looks = {number: of_image(uv, picture) for number, picture in pictures.items()}
    plain = float(np.mean([picture.mean() for picture in pictures.values()]))

    def brightness(triangles: Ints, weights: Floats) -> Floats:
        found = np.full(len(triangles), plain)
        for number, look in looks.items():
            chosen = material[triangles] == number
            found[chosen] = look(triangles[chosen], weights[chosen])
        return found

    return brightness


def _of_colours(mesh: Mesh) -> Brightness | None:
    """Brightness of the first colour attribute of a mesh that is not plain; None where there is none."""
    from ...face.fit.surface.paint import of_corners

    for attribute in mesh.attributes:
        if attribute.data_type not in ("FLOAT_COLOR", "BYTE_COLOR") or attribute.domain not in ("POINT", "CORNER"):
            continue
        values = read_floats(attribute.data, "color", 4)[:, :3] @ LUMA
        if np.ptp(values) > PLAIN:
            at_corners = attribute.domain == "CORNER"
            corners = read_ints(mesh.loop_triangles, "loops", 3) if at_corners else meshes.triangle_corners(mesh)
            return of_corners(values[corners])
    return None


def _image_of(material: Material | None) -> Image | None:
    """The image behind the colour of a material's shader."""
    tree = None if material is None else material.node_tree
    if tree is None:
        return None
    for link in tree.links:
        if link.to_socket.name == "Base Color" or (link.to_node.type, link.to_socket.name) == ("EMISSION", "Color"):
            image = _behind(tree, link.from_node)
            if image is not None:
                return image
    return None


def _behind(tree: NodeTree, node: Node, hops: int = HOPS) -> Image | None:
    """The image that a node passes on."""
    if node.type == "TEX_IMAGE":
        image = node.image
        return image if image is not None and 0 < image.size[0] * image.size[1] <= LARGEST else None
    if hops == 0:
        return None
    before = [link.from_node for link in tree.links if link.to_node.name == node.name]
    return next((image for each in before if (image := _behind(tree, each, hops - 1)) is not None), None)


def _luminance(image: Image) -> Floats:
    """(rows from below, columns) brightness of an image, at most `ROWS` rows or columns of it."""
    step = max(1, -(-max(image.size) // ROWS))
    return np.asarray(read_pixels(image, step)[::-1] @ LUMA)
