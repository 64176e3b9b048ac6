"""The sheet of one head: its points as they were found, and the emotions that they make. Needs Blender."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import risorius.api as api
from faithful.sheet import Cell, write_grid
from faithful.sitter import Sitter, View
from risorius.api import Face
from risorius.arrays import Floats
from risorius.errors import RisoriusError
from risorius.face.fit.doubt import DOUBTFUL
from risorius.scene import mesh as meshes
from risorius.scene.faces import face_of, read_face
from risorius.scene.jobs.painting import paint_parts
from risorius.scene.pictures.framing import Framing, framing_of
from risorius.scene.points.stored import store_points

from .heads import TrueHead
from .sheet import Strip

#: Radius of a drawn point as a share of the distance between the eyes' outer corners, and the same for true places.
DOT, TRUE_DOT = 0.024, 0.016
#: What a picture shows, as shares of the way from the eyes to the chin: how much, about where.
SHOWN, LOWER, DEEPER = 2.4, 0.33, 0.4
#: From this error on the true place is drawn, too, metres.
FAR = 5e-3
SURE, UNSURE, WRONG, TRUE = (0.02, 0.35, 0.8), (0.95, 0.6, 0.02), (0.9, 0.02, 0.02), (0.0, 0.0, 0.0)

#: An octahedron.
_TIPS = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=np.float64)
_SIDES = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])


def portrait(head: TrueHead, emotions: Sequence[str], path: Path, *, width: int, height: int) -> Strip:
    """Find the points of a head, pose the emotions, write its sheet; pictures from the front for the overview."""
    try:
        found = api.find_points(head.vertices, head.polygons, topologies=())
    except RisoriusError as refused:
        return Strip(head.name, f"refused: {str(refused).split(';')[0]}", [])
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    obj = _object(head)
    store_points(obj, {name: tuple(place.tolist()) for name, place in found.positions.items()})
    try:
        face = face_of(read_face(obj))
        profiles = [api.expression(word) for word in emotions]
        poses = [face.pose(profile.frame(), emotion=profile.weights).positions for profile in profiles]
    except RisoriusError as refused:
        return Strip(head.name, f"no face: {refused}", [])
    paint_parts(obj)
    dots = _dots(head, found.positions, found.confidence)
    framing = _framing(obj, found.positions)
    with_dots = Sitter([obj, dots], width=width, height=height, framing=framing)
    neutral = [with_dots.shots([face.vertices], view)[0] for view in View]
    alone = Sitter([obj], width=width, height=height, framing=framing)
    plain = [alone.shots([face.vertices, *poses], view) for view in View]
    remark = _remark(head, found)
    cells = [Cell("points", remark, neutral), Cell("neutral", _parts_said(face), [seen[0] for seen in plain])]
    cells += [Cell(word, "", [seen[k] for seen in plain]) for k, word in enumerate(emotions, 1)]
    write_grid(cells, path, columns=4, heading=head.name)
    return Strip(head.name, remark, [neutral[0], *plain[0][1:]])


def _object(head: TrueHead) -> Any:
    """The head as a mesh object in the scene."""
    mesh = meshes.new_mesh(head.name, head.vertices, *meshes.flatten_polygons(head.polygons))
    obj = bpy.data.objects.new(head.name, mesh)
    bpy.context.collection.objects.link(obj)
    return obj


def _framing(obj: Any, positions: Mapping[str, Floats]) -> Framing:
    """From the hairline to below the chin, on masks and busts alike."""
    framing = framing_of(obj)
    eyes = np.mean([positions[name] for name in ("3.7", "3.11", "3.8", "3.12")], axis=0)
    length = float(np.linalg.norm(positions["2.1"] - eyes))
    centre = eyes - LOWER * length * framing.up - DEEPER * length * framing.forward
    return replace(framing, centre=centre, height=SHOWN * length)


def _remark(head: TrueHead, found: api.FoundPoints) -> str:
    """Score and error of the points but ears and skull."""
    errors = [
        1000.0 * float(np.linalg.norm(place - head.points[name]))
        for name, place in found.positions.items()
        if name in head.points and not name.startswith(("10.", "11."))
    ]
    return f"score {found.score:.2f}; {np.median(errors):.1f} / {np.quantile(errors, 0.95):.1f} mm"


def _parts_said(face: Face) -> str:
    """What the mesh has besides skin."""
    names = [part.name.lower() for part in api.Part if part in set(np.unique(face.parts).tolist())]
    return ", ".join(dict.fromkeys(name.split("_")[0] for name in names if name != "skin"))


def _dots(head: TrueHead, positions: Mapping[str, Floats], confidence: Mapping[str, float]) -> Any:
    """An object of dots at the points that were found, and at the true places of those that are far off."""
    radius = DOT * float(np.linalg.norm(positions["3.7"] - positions["3.12"]))
    places, sizes, colours = [], [], []
    for name, place in positions.items():
        places.append(place)
        sizes.append(radius)
        colours.append(0 if confidence[name] >= DOUBTFUL else 1 if confidence[name] >= DOUBTFUL / 2.0 else 2)
        truth = head.points.get(name)
        if truth is not None and np.linalg.norm(truth - place) > FAR:
            places.append(truth)
            sizes.append(radius * TRUE_DOT / DOT)
            colours.append(3)
    middles = np.array(places)[:, None] + _TIPS * np.array(sizes)[:, None, None]
    sides = np.arange(len(places))[:, None, None] * len(_TIPS) + _SIDES
    mesh = meshes.new_mesh("dots", middles.reshape(-1, 3), *meshes.flatten_polygons(sides.reshape(-1, 3)))
    for colour in (SURE, UNSURE, WRONG, TRUE):
        material = bpy.data.materials.new("dot")
        material.diffuse_color = (*colour, 1.0)
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", np.repeat(colours, len(_SIDES)).astype(np.int32))
    obj = bpy.data.objects.new("dots", mesh)
    bpy.context.collection.objects.link(obj)
    return obj
