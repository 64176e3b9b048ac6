"""Irises for eyeballs too coarse to paint one on: discs bent round the eyeball, at rest as the eyes are in words."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from risorius.api import Face, Part
from risorius.arrays import Floats
from risorius.face.template import MM
from risorius.scene import mesh as meshes
from risorius.scene.subjects import PLAIN_COLOURS

#: Eyeballs of fewer vertices get discs.
COARSE = 400

#: Disc: radius of a grown-up's iris and of a pupil, and how far before the eyeball it lies.
DISCS = (("Iris", 5.9 * MM, 0.15 * MM), ("Pupil", 2.2 * MM, 0.25 * MM))

RINGS, SPOKES = 5, 32


def irises(head: Any, face: Face) -> list[Any]:
    """Disc objects in the scene for both eyes of a painted head; none where its own eyeballs are fine enough."""
    parts = np.asarray(face.parts)
    made: list[Any] = []
    for part, side, pupil in ((Part.EYEBALL_L, "l", "3.5"), (Part.EYEBALL_R, "r", "3.6")):
        count = int((parts == part).sum())
        if not 0 < count < COARSE:
            continue
        eye, frame = face.anatomy.eyes[side], face.anatomy.mesh.frame
        centre = frame.to_face(eye.centre[None])[0]
        gaze = face.points[pupil].position - centre
        for colour, radius, before in DISCS:
            made.append(_disc(centre, gaze, eye.radius * frame.scale + before, radius, colour))
    if made:
        _whiten(head, parts)
    return made


def _disc(centre: Floats, gaze: Floats, sphere: float, radius: float, colour: str) -> Any:
    """A cap of a sphere (metres) about the direction of gaze."""
    forward = gaze / np.linalg.norm(gaze)
    across = np.cross(forward, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across)
    angle = np.linspace(0.0, np.arcsin(radius / sphere), RINGS)[1:, None, None]
    turn = np.linspace(0.0, 2.0 * np.pi, SPOKES, endpoint=False)[None, :, None]
    sideways = np.cos(turn) * across + np.sin(turn) * np.cross(across, forward)
    rim = (np.cos(angle) * forward + np.sin(angle) * sideways).reshape(-1, 3)
    vertices = centre + sphere * np.concatenate([forward[None], rim])
    polygons: list[tuple[int, ...]] = [(0, 1 + (s + 1) % SPOKES, 1 + s) for s in range(SPOKES)]
    for ring in range(RINGS - 2):
        here, there = 1 + ring * SPOKES, 1 + (ring + 1) * SPOKES
        for s in range(SPOKES):
            after = (s + 1) % SPOKES
            polygons.append((here + s, here + after, there + after, there + s))
    mesh = meshes.new_mesh(colour, vertices, *meshes.flatten_polygons(polygons))
    material = bpy.data.materials.new(colour)
    material.diffuse_color = (*PLAIN_COLOURS[colour], 1.0)
    mesh.materials.append(material)
    disc = bpy.data.objects.new(colour, mesh)
    bpy.context.collection.objects.link(disc)
    return disc


def _whiten(head: Any, parts: Any) -> None:
    """Take the painted irises off the eyeballs."""
    corners, sizes = meshes.polygon_arrays(head.data)
    eyeball = np.isin(parts[corners[np.cumsum(sizes) - sizes]], (Part.EYEBALL_L, Part.EYEBALL_R))
    index = np.empty(len(sizes), dtype=np.int32)
    head.data.polygons.foreach_get("material_index", index)
    index[eyeball] = list(PLAIN_COLOURS).index("Sclera")
    head.data.polygons.foreach_set("material_index", index)
