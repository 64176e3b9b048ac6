"""Pictures of neutral heads from several sides: what people's proportions are learnt from. Needs Blender's `bpy`."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np
from faithful.heads import HEADS, heads_folder, lash_vertices, load_face
from risorius.api import Face
from risorius.arrays import Floats, Ints
from risorius.scene import mesh as meshes
from risorius.scene.blender_types import Object
from risorius.scene.jobs.painting import paint_parts
from risorius.scene.pictures.framing import framing_of
from risorius.scene.points.stored import store_points

from .films import SIZE, Filmed
from .sides import SIDES

#: People on MakeHuman's mesh that are no caricatures.
VARIANTS = ("afr_f_young", "asi_m_young", "cau_m_old", "asi_f_old", "cau_f_child", "long")

#: Head -> file of `heads/others` with a neutral face, lids open and lips shut.
OTHERS = {"jeeliz_human": "jeeliz_human/shapes.npz", "mhr": "mhr/mhr_head.obj"}


def picture_neutral_heads(out: Path) -> Path:
    """Write pictures NAME/0001.png ... of every head into a folder, from each of `SIDES`."""
    for name in HEADS:
        face = load_face(name)
        _picture(Filmed.of_head(name, face, width=SIZE, height=SIZE), face.vertices, out / name)
    for name, face in _variants():
        _picture(Filmed([painted_object(name, face)], width=SIZE, height=SIZE), face.vertices, out / name)
    for name, file in OTHERS.items():
        mesh = read_mesh(heads_folder() / "others" / file)
        obj = bare_object(name, mesh)
        _picture(Filmed([obj], framing=framing_of(obj), width=SIZE, height=SIZE), mesh.vertices, out / name)
    return out


def _picture(sitter: Filmed, vertices: Floats, folder: Path) -> None:
    """A picture from each side."""
    for number, (degrees, nod) in enumerate(SIDES, 1):
        sitter.film([_nodding(vertices, nod)], degrees, folder)
        (folder / "0001.png").rename(folder / f"side-{number}.png")


def _nodding(vertices: Floats, degrees: float) -> Floats:
    """Vertices turned about the axis from ear to ear, down where positive."""
    middle, angle = vertices.mean(axis=0), np.radians(degrees)
    turn = np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]])
    turned: Floats = (vertices - middle) @ turn.T + middle
    return turned


def _variants() -> Iterator[tuple[str, Face]]:
    """Other people on MakeHuman's mesh."""
    folder, base = heads_folder(), load_face("makehuman")
    data = np.load(folder / "makehuman_variants.npz")
    points = json.loads((folder / "makehuman.fp.json").read_text(encoding="utf-8"))["points"]
    for name, vertices in zip(data["names"].tolist(), data["vertices"].astype(np.float64), strict=True):
        if name in VARIANTS:
            bound = {point: vertex for point, vertex in points.items() if point != "7.1"}
            yield f"makehuman-{name}", Face.from_arrays(vertices, base.polygons, bound, base.parts)


def painted_object(name: str, face: Face) -> Object:
    """A head on MakeHuman's mesh as the one object of a file, without its lashes."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    lashes = lash_vertices("makehuman")
    drawn = [polygon for polygon in face.polygons if not lashes[polygon[0]]]
    mesh = meshes.new_mesh(name, face.vertices, *meshes.flatten_polygons(drawn))
    meshes.write_parts(mesh, face.parts)
    obj: Object = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    store_points(obj, {n: tuple(point.position.tolist()) for n, point in face.points.items()})
    paint_parts(obj)
    return obj


@dataclass(frozen=True, eq=False)
class PlainMesh:
    """A head as a file has it: vertices (V, 3) looking along -Y, polygons."""

    vertices: Floats
    polygons: Sequence[Ints]


def bare_object(name: str, mesh: PlainMesh) -> Object:
    """A head without points or materials as the one object of a file."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    data = meshes.new_mesh(name, mesh.vertices, *meshes.flatten_polygons(mesh.polygons))
    obj = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(obj)
    return obj  # type: ignore[no-any-return]


def read_mesh(path: Path) -> PlainMesh:
    """A head of `heads/others`, whose up is Y."""
    if path.suffix == ".npz":
        data = np.load(path)
        return PlainMesh(_upright(data["positions"].astype(np.float64)), list(data["triangles"].astype(np.int64)))
    lines = [line.split() for line in path.read_text(encoding="utf-8").splitlines()]
    vertices = np.array([[float(number) for number in line[1:4]] for line in lines if line[:1] == ["v"]])
    corners = [[int(corner.split("/")[0]) - 1 for corner in line[1:]] for line in lines if line[:1] == ["f"]]
    return PlainMesh(_upright(vertices), [np.array(each, dtype=np.int64) for each in corners])


def _upright(vertices: Floats) -> Floats:
    """From Y up to Z up."""
    return np.stack([vertices[:, 0], -vertices[:, 2], vertices[:, 1]], axis=1)
