"""The pictures and what they truly show. Needs Blender's `bpy`."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from faithful.heads import load_face
from faithful.sitter import Sitter, object_alone
from risorius.api import Face, build_default_head
from risorius.arrays import Bools
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.lettering import write_picture
from risorius.scene.pictures.look import Engine, Lighting, Look
from strangers import paint

from .stills import LIGHTS, TRACED, Still, posed

TRUTH = "truth.json"

#: Pixels of a side: a face is about half as wide.
SIZE = 512

#: Our lights -> Blender's for Workbench: from one side, as a user gets it, and even from the front.
STUDIO_LIGHTS = dict(zip(LIGHTS, ("Default", "paint.sl"), strict=True))

#: Lights in Cycles: a portrait's, and one that comes from the subject's left with little around it. Pixels of
#: a side, which are fewer to take seconds, and rays of a pixel.
LAMPS = dict(zip(TRACED, (Lighting(), Lighting(strength=1.2, yaw=float(np.radians(60.0)), ambient=0.1)), strict=True))
TRACED_SIZE, SAMPLES = 256, 8


def picture_all(asked: Sequence[Still], out: Path) -> None:
    """Write every still that is not there, and the FAPs measured on each mesh: TRUTH, file -> 68 values or null."""
    out.mkdir(parents=True, exist_ok=True)
    truth: dict[str, list[float | None]] = {}
    if (out / TRUTH).is_file():
        truth = json.loads((out / TRUTH).read_text(encoding="utf-8"))
    for head in dict.fromkeys(still.head for still in asked):
        missing = [s for s in asked if s.head == head and (s.file not in truth or not (out / s.file).is_file())]
        if missing:
            _picture(head, missing, out, truth)
            print(f"{head}: {len(missing)} pictures", flush=True)


def _picture(head: str, asked: Sequence[Still], out: Path, truth: dict[str, list[float | None]]) -> None:
    """The stills of one head: each pose once, then light by light and side by side."""
    face = load_face(head)
    poses = {key: posed(face, still) for key, still in {(s.shows, s.strength): s for s in asked}.items()}
    measured = {
        key: [None if np.isnan(value) else round(float(value), 2) for value in face.measure(positions)]
        for key, positions in poses.items()
    }
    truth |= {still.file: measured[still.shows, still.strength] for still in asked}
    (out / TRUTH).write_text(json.dumps(truth), encoding="utf-8")
    obj = object_alone(head, face)
    if head != "default":
        _make_up(obj, face)
    for lit in (*LIGHTS, *TRACED):
        sitter = _sitter(obj, lit)
        for yaw in sorted({still.yaw for still in asked if still.light == lit}):
            wanted = [still for still in asked if (still.light, still.yaw) == (lit, yaw)]
            shots = sitter.shots([poses[s.shows, s.strength] for s in wanted], float(np.radians(yaw)))
            for still, pixels in zip(wanted, shots, strict=True):
                write_picture(pixels, out / still.file)


def _sitter(obj: Any, lit: str) -> Sitter:
    """A head in a light."""
    if lit in TRACED:
        side, lamps = TRACED_SIZE, LAMPS[lit]
        look = Look(engine=Engine.CYCLES, width=side, height=side, samples=SAMPLES, lighting=lamps)
        return Sitter([obj], framing=framing_of(obj), look=look)
    return Sitter([obj], width=SIZE, height=SIZE, framing=framing_of(obj), relight=_lit_by(lit))


def _lit_by(lit: str) -> Callable[[Any, object], None]:
    """What sets the studio light of a scene."""

    def relight(scene: Any, _framing: object) -> None:
        scene.display.shading.studio_light = STUDIO_LIGHTS[lit]

    return relight


def _make_up(obj: Any, face: Face) -> None:
    """Brows and lips on a head that brings no paint, polygon by polygon, in the default head's colours."""
    colours = {material.name: material.colour for material in build_default_head().materials}
    points = {name: point.position for name, point in face.points.items()}
    along, above = paint.brow_places(face.vertices, points).T
    places, breadths = np.array(paint.BROW_SHAPE).T
    widths = np.interp(along, places, breadths, left=0.0, right=0.0)
    skin = [index for index, material in enumerate(obj.data.materials) if "skin" in material.name]
    of_polygon = np.array([polygon.material_index for polygon in obj.data.polygons])
    corners = [polygon.vertices[:] for polygon in obj.data.polygons]
    for name, inside in (
        ("brow", widths > np.abs(above)),
        ("lips", paint.lip_depths(face.vertices, points) > 0.0),
    ):
        material = bpy.data.materials.new(name)
        material.diffuse_color = (*colours[name], 1.0)
        obj.data.materials.append(material)
        painted: Bools = np.array([inside[list(each)].mean() > 0.5 for each in corners]) & np.isin(of_polygon, skin)
        for index in np.flatnonzero(painted):
            obj.data.polygons[int(index)].material_index = len(obj.data.materials) - 1
    obj.data.update()
