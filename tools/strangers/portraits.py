"""The pictures: small, Cycles, painted in the default head's colours, one light; kept by what is in them."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from faithful.sitter import Sitter, object_alone
from risorius.api import Face, build_default_head
from risorius.scene.attributes import write_vectors
from risorius.scene.materials import node_tree_of, principled_of
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.furniture import CLOSENESS
from risorius.scene.pictures.lettering import write_picture
from risorius.scene.pictures.look import Engine, Look

from . import light, paint
from .light import relight
from .poses import Poses, digest_of
from .sittings import Sitting

#: Small, on a background a little darker than the skin, and exposed as a photograph of a face would be (stops).
LOOK = Look(engine=Engine.CYCLES, width=288, height=288, background=(0.16, 0.175, 0.19))
EXPOSURE = 0.3

#: Roughness of skin: no highlights.
ROUGHNESS = 0.8

#: So much of a framing's height is shown, about a centre so much lower, in such heights.
SHOWN, LOWER = 0.8184, 0.02

#: The paint sets in over this depth into the lips (metres) and into a brow (a share of the distance between the eyes).
LIP_EDGE, BROW_EDGE = 0.0012, 0.012

#: The material that `paint_parts` gives the skin.
_SKIN = "Risorius plain skin"

#: The materials that it gives eyeballs.
_EYE_MATERIALS = ("Risorius plain sclera", "Risorius plain iris", "Risorius plain pupil")

#: Attributes of each vertex: along and above its brow, depth into the lips in `LIP_EDGE`; beside and above its iris.
_PAINT, _EYES = "strangers_paint", "strangers_eyes"


def picture(head: str, face: Face, asked: Sequence[Sitting], poses: Poses, folder: Path) -> dict[Sitting, Path]:
    """Files of the sittings of one head; only what is not there yet is rendered."""
    files = {sitting: folder / f"{digest(face, sitting, poses.digest(sitting))}.png" for sitting in asked}
    missing = [sitting for sitting in asked if not files[sitting].is_file()]
    if missing:
        folder.mkdir(parents=True, exist_ok=True)
        sitter = sitter_of(head, face)
        for yaw in sorted({sitting.turned for sitting in missing}):
            wanted = [sitting for sitting in missing if sitting.turned == yaw]
            shots = sitter.shots([poses.positions(sitting) for sitting in wanted], float(np.radians(yaw)))
            for sitting, pixels in zip(wanted, shots, strict=True):
                write_picture(paint.exposed(pixels, EXPOSURE), files[sitting])
    return files


def digest(face: Face, sitting: Sitting, pose: str) -> str:
    """What a picture depends on, in 24 letters: light and paint, the head, its pose's digest, the view."""
    known = hashlib.sha256()
    for source in (Path(__file__), Path(light.__file__), Path(paint.__file__)):
        known.update(source.read_bytes())
    known.update(f"{sitting.head} {sitting.turned} {digest_of(face.vertices)} {pose}".encode())
    return known.hexdigest()[:24]


def sitter_of(head: str, face: Face) -> Sitter:
    """A head as it is pictured here."""
    obj = object_alone(head, face)
    _dull(obj)
    if head != "default":
        _put_on_paint(obj, face)
    whole = framing_of(obj)
    framing = replace(whole, centre=whole.point(0.0, -LOWER, 0.0), height=SHOWN / CLOSENESS * whole.height)
    return Sitter([obj], framing=framing, look=LOOK, relight=relight)


def _dull(obj: Any) -> None:
    """No highlights on the skin, the default head's or plain."""
    for material in obj.data.materials:
        if material.name.endswith("skin"):
            for shading in principled_of(material):
                shading.inputs["Roughness"].default_value = ROUGHNESS


def _put_on_paint(obj: Any, face: Face) -> None:
    """Brows, lips, irises and the default head's skin on the plain materials.

    Each vertex says where it lies in brow and lips; the picture's points in between find out on their own, so that the
    edges are sharper than the mesh.
    """
    points = {name: point.position for name, point in face.points.items()}
    brow, lips = paint.brow_places(face.vertices, points), paint.lip_depths(face.vertices, points)
    write_vectors(obj.data, _PAINT, np.column_stack([brow, lips / LIP_EDGE]))
    _paint_eyes(obj, face)
    colours = {material.name: material.colour for material in build_default_head().materials}
    skin = next(material for material in obj.data.materials if material.name.startswith(_SKIN))
    tree = node_tree_of(skin)
    parts = tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(_stored(tree, _PAINT), parts.inputs[0])
    along, above, depth = parts.outputs
    red = _mixed(tree, colours["skin"], colours["lips"], depth)
    shown = _mixed(tree, red, colours["brow"], _in_brow(tree, along, above), cover=paint.BROW_COVER)
    for shading in principled_of(skin):
        tree.links.new(shown, shading.inputs["Base Color"])


def _paint_eyes(obj: Any, face: Face) -> None:
    """Grey irises that look straight ahead on whatever eyeballs there are."""
    between = float(np.linalg.norm(face.points["3.5"].position - face.points["3.6"].position))
    places = np.full((len(face.vertices), 3), paint.BEHIND)
    places[:, 2] = 0.0
    for ball in face.eyeballs:
        seen = paint.iris_places(face.vertices[ball.vertices], ball, face.axes[2], face.axes[1], between)
        places[ball.vertices, :2] = seen
    write_vectors(obj.data, _EYES, places)
    for material in obj.data.materials:
        if material.name.startswith(_EYE_MATERIALS):
            tree = node_tree_of(material)
            grey = _eye_grey(tree)
            for shading in principled_of(material):
                tree.links.new(grey, shading.inputs["Base Color"])


def _eye_grey(tree: Any) -> Any:
    """Socket of the colour of an eye, by how far from the middle of its iris a point lies."""
    away, greys = tree.nodes.new("ShaderNodeVectorMath"), tree.nodes.new("ShaderNodeValToRGB")
    away.operation = "LENGTH"
    tree.links.new(_stored(tree, _EYES), away.inputs[0])
    widest = paint.EYE_GREYS[-1][0]
    tree.links.new(_sum(tree, "DIVIDE", away.outputs["Value"], widest), greys.inputs["Fac"])
    stops = greys.color_ramp.elements
    while len(stops) < len(paint.EYE_GREYS):
        stops.new(1.0)
    for stop, (radius, grey) in zip(stops, paint.EYE_GREYS, strict=True):
        stop.position, stop.color = radius / widest, (grey, grey, grey, 1.0)
    return greys.outputs["Color"]


def _stored(tree: Any, name: str) -> Any:
    """The socket of an attribute of the vertices."""
    node = tree.nodes.new("ShaderNodeAttribute")
    setattr(node, "attribute_name", name)  # noqa: B010 - of this kind of node alone
    return node.outputs["Vector"]


def _in_brow(tree: Any, along: Any, above: Any) -> Any:
    """Socket that is 1 within a brow and 0 outside, from where along and above its line a point lies."""
    places, halves = np.array(paint.BROW_SHAPE).T
    share = tree.nodes.new("ShaderNodeMapRange")
    share.inputs["From Min"].default_value, share.inputs["From Max"].default_value = places[0], places[-1]
    tree.links.new(along, share.inputs["Value"])
    shape = tree.nodes.new("ShaderNodeFloatCurve")
    points = shape.mapping.curves[0].points
    while len(points) < len(places):
        points.new(0.5, 0.5)
    for point, place, half in zip(points, (places - places[0]) / (places[-1] - places[0]), halves, strict=True):
        point.location = place, half / halves.max()
    shape.mapping.update()
    tree.links.new(share.outputs["Result"], shape.inputs["Value"])
    half = _sum(tree, "MULTIPLY", shape.outputs["Value"], float(halves.max()))
    within = _sum(tree, "SUBTRACT", half, _sum(tree, "ABSOLUTE", above))
    return _sum(tree, "DIVIDE", within, BROW_EDGE)


def _sum(tree: Any, operation: str, *values: Any) -> Any:
    """The socket of a sum on sockets or numbers."""
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    for place, value in enumerate(values):
        if isinstance(value, float):
            node.inputs[place].default_value = value
        else:
            tree.links.new(value, node.inputs[place])
    return node.outputs[0]


def _mixed(tree: Any, ground: Any, laid: tuple[float, float, float], share: Any, *, cover: float = 1.0) -> Any:
    """The socket of a colour with another laid over it: from none at a share of 0 to `cover` at 1 and beyond."""
    node = tree.nodes.new("ShaderNodeMixRGB")
    clamped = tree.nodes.new("ShaderNodeClamp")
    tree.links.new(share, clamped.inputs["Value"])
    tree.links.new(_sum(tree, "MULTIPLY", clamped.outputs["Result"], cover), node.inputs["Fac"])
    if isinstance(ground, tuple):
        node.inputs["Color1"].default_value = (*ground, 1.0)
    else:
        tree.links.new(ground, node.inputs["Color1"])
    node.inputs["Color2"].default_value = (*laid, 1.0)
    return node.outputs["Color"]
