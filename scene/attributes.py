"""One figure of all items at once: Blender's collections to arrays and back. The only place that does so.

Blender holds figures in single precision and numbers in 32 bits; a buffer of the same type is copied as a whole.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Ints
from .blender_types import Image, Items, Mesh


def read_floats(items: Items[object], name: str, width: int = 1) -> Floats:
    """(n,) a figure of each item, or (n, width) where it has several, such as "co" of vertices."""
    flat = np.empty(width * len(items), dtype=np.float32)
    items.foreach_get(name, flat)
    values = flat.astype(np.float64)
    return values if width == 1 else values.reshape(-1, width)


def read_ints(items: Items[object], name: str, width: int = 1) -> Ints:
    """(n,) a whole number of each item, or (n, width) where it has several."""
    flat = np.empty(width * len(items), dtype=np.int32)
    items.foreach_get(name, flat)
    values = flat.astype(np.int64)
    return values if width == 1 else values.reshape(-1, width)


def write_floats(items: Items[object], name: str, values: Floats) -> None:
    """Set a figure of each item, or several; (n,) or (n, width)."""
    items.foreach_set(name, np.ascontiguousarray(values, dtype=np.float32).ravel())


def write_ints(items: Items[object], name: str, values: Ints) -> None:
    """Set a whole number of each item, or several; (n,) or (n, width)."""
    items.foreach_set(name, np.ascontiguousarray(values, dtype=np.int32).ravel())


def write_flags(items: Items[object], name: str, values: Bools) -> None:
    """Set a flag of each item (n,)."""
    items.foreach_set(name, np.ascontiguousarray(values, dtype=np.bool_))


def read_vectors(mesh: Mesh, name: str) -> Floats | None:
    """(V, 3) a vector attribute of the vertices of a mesh; None where it has no such one."""
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.domain != "POINT" or attribute.data_type != "FLOAT_VECTOR":
        return None
    return read_floats(attribute.data, "vector", 3)


def write_vectors(mesh: Mesh, name: str, vectors: Floats) -> None:
    """Store a vector attribute (V, 3) of the vertices with a mesh, in place of the one it had."""
    attribute = mesh.attributes.get(name)
    if attribute is not None and len(attribute.data) != len(vectors):
        mesh.attributes.remove(attribute)
        attribute = None
    if attribute is None:
        attribute = mesh.attributes.new(name, "FLOAT_VECTOR", "POINT")
    write_floats(attribute.data, "vector", vectors)


def read_numbers(mesh: Mesh, name: str) -> Ints | None:
    """(V,) an integer attribute of the vertices of a mesh; None where it has no such one."""
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.domain != "POINT" or attribute.data_type != "INT":
        return None
    return read_ints(attribute.data, "value")


def write_numbers(mesh: Mesh, name: str, numbers: Ints) -> None:
    """Store an integer attribute (V,) of the vertices with a mesh, in place of the one it had."""
    attribute = mesh.attributes.get(name) or mesh.attributes.new(name, "INT", "POINT")
    write_ints(attribute.data, "value", numbers)


def remove_attribute(mesh: Mesh, name: str) -> None:
    """Take an attribute away, where it is there."""
    attribute = mesh.attributes.get(name)
    if attribute is not None:
        mesh.attributes.remove(attribute)


def read_pixels(image: Image, step: int = 1) -> Floats:
    """(rows, columns, 3) colours of a picture as stored, 0..1, first row at the top; one in `step` of each way."""
    width, height = image.size
    flat = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(flat)
    return flat.reshape(height, width, 4)[::step, ::step, :3][::-1].astype(np.float64)


def write_pixels(image: Image, colours: Floats) -> None:
    """Fill a picture with opaque colours (height, width, 3), 0..1, first row at the top."""
    full = np.ones((*colours.shape[:2], 4), dtype=np.float32)
    full[:, :, :3] = colours[::-1]
    image.pixels.foreach_set(full.ravel())
