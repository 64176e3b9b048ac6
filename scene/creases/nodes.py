"""Creases as node groups: one measures how squeezed the posed skin is, the other draws wrinkles by it.

Both are plain nodes of Blender, saved with the file: a baked face wrinkles without the extension, whatever moves it.
The formulas of the first are those of `face.products.creases`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from hashlib import blake2b

import bpy

from ...face.products.crease_table import CreaseRow, Look, read_creases
from ..blender_types import NodeSocket, NodeTree
from ..node_graph import NodeGraph, Value

#: Attributes of the mesh, written once: a vertex's resting place in the mesh's coordinates and in head space, and its
#: place on a crease. Blender's own resting places are without the shape keys that make a character what it is.
REST, HEAD, PLACE = "risorius_rest", "risorius_head", "risorius_place_"

#: Attributes that the modifier writes: place across, fullness; and how squeezed the skin is all round.
CREASE, STRAIN = "risorius_crease_", "risorius_strain"

#: Lengths over which lines stray, break off, and pebbles lie, as noise per metre.
STRAYS, BREAKS, PEBBLES = 75.0, 60.0, 260.0

#: A valley of this half width, metres, is dark to its bottom; light reaches into wider ones.
NARROW = 1.0e-3

MEASURE, DRAW = "Risorius Crease Strain", "Risorius Creases"
_FULLNESS, _LINES = "Risorius Crease Fullness", "Risorius Crease Lines"

#: Which table and variant a group was built from.
TABLE = "risorius_table"


def measuring_group(rounds: int) -> NodeTree:
    """The geometry node group that writes the attributes `CREASE` + name and `STRAIN` on a posed mesh.

    Parameters
    ----------
    rounds : over which compression is averaged (`Creases.rounds`). Built into the group, because how a script sets an
        input of a modifier differs from Blender to Blender.
    """
    return _ready(MEASURE, lambda rows: _measuring(rows, rounds), f"{REST}, {rounds} rounds")


def drawing_group() -> NodeTree:
    """The shader node group that turns the attributes `CREASE` + name into a normal and a shade."""
    return _ready(DRAW, _drawing, "")


def is_measuring(tree: NodeTree | None) -> bool:
    """Whether a node tree is the measuring group, or a copy of it."""
    return tree is not None and tree.bl_idname == "GeometryNodeTree" and tree.name.startswith(MEASURE)


def is_drawing(tree: NodeTree | None) -> bool:
    """Whether a node tree is the drawing group, or a copy of it."""
    return tree is not None and tree.bl_idname == "ShaderNodeTree" and tree.name.startswith(DRAW)


def forget_unused() -> None:
    """Remove our groups that nothing uses, outer ones first."""
    for name in (MEASURE, DRAW, _FULLNESS, _LINES):
        for tree in [tree for tree in bpy.data.node_groups if tree.name.startswith(name) and TABLE in tree]:
            if tree.users - tree.use_fake_user == 0:
                bpy.data.node_groups.remove(tree)


def seen(rows: Sequence[CreaseRow]) -> list[CreaseRow]:
    """The creases that are drawn."""
    return [row for row in rows if row.look is not Look.UNSEEN]


def _ready(name: str, build: Callable[[Sequence[CreaseRow]], NodeTree], variant: str) -> NodeTree:
    """The variant of the group for the table as it is: one that is there already, or a new one."""
    rows = read_creases()
    table = blake2b(f"{rows}{variant}".encode(), digest_size=8).hexdigest()
    there: Iterable[NodeTree] = bpy.data.node_groups
    for tree in there:
        if tree.name.startswith(name) and tree.get(TABLE) == table and tree.library is None:
            return tree
    tree = build(rows)
    tree[TABLE] = table
    return tree


def _measuring(rows: Sequence[CreaseRow], rounds: int) -> NodeTree:
    """See `measuring_group`."""
    graph = NodeGraph(MEASURE, "GeometryNodeTree")
    graph.tree.is_modifier = True
    geometry = graph.takes("Geometry", "NodeSocketGeometry")
    ends = graph.node("GeometryNodeInputMeshEdgeVertices").outputs
    rest = _named(graph, REST)
    length = graph.vector("DISTANCE", *(_at(graph, end, rest) for end in ends[:2])).outputs["Value"]
    length = graph.math("MAXIMUM", length, 1e-12)
    posed = graph.vector("DISTANCE", ends[2], ends[3]).outputs["Value"]
    shortening = graph.math("SUBTRACT", 1.0, graph.math("DIVIDE", posed, length))
    geometry = _stored(graph, geometry, STRAIN, _averaged(graph, shortening, rounds), "FLOAT")
    fullness = _fullness()
    for row in seen(rows):
        crease = graph.group(
            fullness,
            Place=_named(graph, PLACE + row.name),
            Gauge=_named(graph, PLACE + row.of),
            Shortening=shortening,
            Length=length,
            Rounds=rounds,
            Onset=row.onset,
            Full=row.full,
        )
        geometry = _stored(graph, geometry, CREASE + row.name, crease.outputs[0], "FLOAT_VECTOR")
    graph.gives(Geometry=geometry)
    return graph.arranged()


def _fullness() -> NodeTree:
    """The group that puts how full a crease is in the place of its presence."""
    graph = NodeGraph(_FULLNESS, "GeometryNodeTree")
    place, gauge = (graph.takes(name, "NodeSocketVector") for name in ("Place", "Gauge"))
    shortening, length = (graph.takes(name, "NodeSocketFloat") for name in ("Shortening", "Length"))
    rounds = graph.takes("Rounds", "NodeSocketInt", 1)
    onset, full = (graph.takes(name, "NodeSocketFloat") for name in ("Onset", "Full"))
    ends = graph.node("GeometryNodeInputMeshEdgeVertices").outputs[:2]
    (x1, y1), (x2, y2) = (graph.separate(_at(graph, end, gauge))[:2] for end in ends)
    slope = graph.math("DIVIDE", graph.math("SUBTRACT", x1, x2), length)
    square = graph.math("MULTIPLY", slope, slope)
    weight = graph.math("MULTIPLY", graph.math("MULTIPLY", y1, y2), graph.math("MULTIPLY", square, square))
    told = _averaged(graph, graph.math("MULTIPLY", weight, shortening), rounds)
    squeezed = graph.math("DIVIDE", told, _averaged(graph, weight, rounds))
    smooth = graph.node(
        "ShaderNodeMapRange",
        settings={"interpolation_type": "SMOOTHSTEP"},
        Value=squeezed,
        From_Min=onset,
        From_Max=full,
    ).outputs[0]
    x, y, _ = graph.separate(place)
    graph.gives(Crease=graph.combine(x, graph.math("MULTIPLY", y, smooth), 0.0))
    graph.tree[TABLE] = ""
    return graph.arranged()


def _named(graph: NodeGraph, name: str) -> Value:
    """A vector attribute of the mesh."""
    settings = {"data_type": "FLOAT_VECTOR"}
    return graph.node("GeometryNodeInputNamedAttribute", settings=settings, Name=name).outputs["Attribute"]


def _at(graph: NodeGraph, index: Value, vector: Value) -> Value:
    """What a vertex has."""
    settings = {"data_type": "FLOAT_VECTOR", "domain": "POINT"}
    return graph.node("GeometryNodeFieldAtIndex", settings=settings, Index=index, Value=vector).outputs[0]


def _averaged(graph: NodeGraph, value: Value, rounds: Value) -> Value:
    """Means of what edges have, over the edges of each vertex and then over neighbouring vertices."""
    mean = graph.node("GeometryNodeFieldOnDomain", settings={"data_type": "FLOAT", "domain": "EDGE"}, Value=value)
    return graph.node("GeometryNodeBlurAttribute", Value=mean.outputs[0], Iterations=rounds).outputs[0]


def _stored(graph: NodeGraph, geometry: Value, name: str, value: Value, kind: str) -> NodeSocket:
    """The geometry with one more attribute of its vertices."""
    settings = {"data_type": kind, "domain": "POINT"}
    node = graph.node("GeometryNodeStoreNamedAttribute", settings=settings, Geometry=geometry, Name=name, Value=value)
    return node.outputs[0]


def _drawing(rows: Sequence[CreaseRow]) -> NodeTree:
    """See `drawing_group`."""
    graph = NodeGraph(DRAW, "ShaderNodeTree")
    strength = graph.takes("Strength", "NodeSocketFloat", 1.0)
    scale = graph.takes("Scale", "NodeSocketFloat", 1.0)
    head = graph.node("ShaderNodeAttribute", settings={"attribute_name": HEAD}).outputs["Vector"]
    stray, breaks, pebbles = (_noise(graph, head, often) for often in (STRAYS, BREAKS, PEBBLES))
    lines = _lines()
    height: Value = 0.0
    shade: Value = 0.0
    for row in seen(rows):
        crease = graph.node("ShaderNodeAttribute", settings={"attribute_name": CREASE + row.name}).outputs["Vector"]
        if row.look is Look.PEBBLES:
            full = graph.separate(crease)[1]
            height = graph.math("MULTIPLY_ADD", graph.math("MULTIPLY", full, pebbles), row.depth, height)
            continue
        drawn = graph.group(
            lines,
            Crease=crease,
            Last=len(row.lines) - 1.0,
            Ratio=row.spacing / row.width,
            Stray=graph.math("MULTIPLY", stray, row.wander),
            Breaks=breaks,
        )
        height = graph.math("MULTIPLY_ADD", drawn.outputs["Height"], row.depth, height)
        dark = min(1.0, NARROW / row.width)
        shade = graph.math("MAXIMUM", graph.math("MULTIPLY", drawn.outputs["Shade"], dark), shade)
    bump = graph.node("ShaderNodeBump", Strength=strength, Distance=scale, Height=height)
    graph.gives(Normal=bump.outputs[0], Shade=graph.math("MULTIPLY", shade, strength))
    return graph.arranged()


def _noise(graph: NodeGraph, place: Value, often: float) -> Value:
    """Smooth noise of mean 0 and about -1 to 1."""
    noise = graph.node("ShaderNodeTexNoise", Vector=place, Scale=often, Detail=0.0)
    return graph.math("MULTIPLY_ADD", noise.outputs[0], 4.0, -2.0)


def _lines() -> NodeTree:
    """The group of valleys along the lines, ridges beside them, that stray a little and break here and there."""
    graph = NodeGraph(_LINES, "ShaderNodeTree")
    across, full, _ = graph.separate(graph.takes("Crease", "NodeSocketVector"))
    names = ("Last", "Ratio", "Stray", "Breaks")
    last, ratio, stray, breaks = (graph.takes(name, "NodeSocketFloat") for name in names)
    place = graph.math("ADD", across, graph.math("DIVIDE", stray, ratio))
    line = graph.math("MAXIMUM", graph.math("MINIMUM", graph.math("ROUND", place), last), 0.0)
    off = graph.math("MULTIPLY", graph.math("SUBTRACT", place, line), ratio)
    square = graph.math("MULTIPLY", off, off)
    full = graph.math("MULTIPLY", full, graph.math("MULTIPLY_ADD", breaks, 0.35, 0.85))
    full = graph.math("MAXIMUM", graph.math("MINIMUM", full, 1.0), 0.0)
    valley = graph.math("EXPONENT", graph.math("MULTIPLY", square, -0.5))
    ridges = graph.math("EXPONENT", graph.math("MULTIPLY", square, -0.5 / 9.0))
    profile = graph.math("SUBTRACT", graph.math("MULTIPLY", ridges, 0.35), graph.math("MULTIPLY", valley, 1.35))
    deepest = graph.math("EXPONENT", graph.math("MULTIPLY", square, -1.0))
    graph.gives(Height=graph.math("MULTIPLY", profile, full), Shade=graph.math("MULTIPLY", deepest, full))
    graph.tree[TABLE] = ""
    return graph.arranged()
