"""Motion trajectories: the paths of skin from rest to each of the six expressions, in out/trajectories.png.

    make trajectories                                   ARGS="..." passes options on
    python tools/trajectories.py --timing spontaneous   another timing of presets/timing.toml

After figure 8 of the second paper (Zhang, Sung, Prakash 2001): every onset is simulated on the default head, and a
sample of skin vertices draws its path, blue where it rests, through green and yellow to red where it has arrived.
Skin that hardly moves is a blue dot. Needs a Python that has bpy.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import risorius.api as api
from faithful.sheet import Cell, write_grid
from places import OUT
from risorius.api import Face
from risorius.arrays import Floats, Ints
from risorius.face.products.trajectories import sampled_vertices
from risorius.physics.mesh import vertex_normals
from risorius.scene import mesh as meshes
from risorius.scene.head import head_object
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.lettering import read_picture
from risorius.scene.pictures.look import Look
from risorius.scene.pictures.studio import render_frame, studio

EMOTIONS = ("joy", "surprise", "fear", "anger", "sadness", "disgust")

#: Frames per second of the simulation, and seconds after the onset in which the skin comes to rest.
FPS, REST = 60.0, 0.4

#: Distance of the sampled vertices, radius of a path, and motion below which a vertex is a dot; metres.
SPACING, RADIUS, STILL = 4.6e-3, 0.72e-3, 0.7e-3

#: The head stands back behind the paths by this along its normals, metres, in this linear colour.
BEHIND, HEAD = 3.5e-3, (0.80, 0.78, 0.75)

#: Linear RGB from rest to the apex, evenly spaced.
COLOURS = np.array(
    [[0.02, 0.10, 0.90], [0.0, 0.55, 0.95], [0.05, 0.75, 0.15], [1.0, 0.75, 0.0], [1.0, 0.10, 0.0], [0.85, 0.0, 0.02]]
)

#: Sides of a path's tube.
SIDES = 6

#: Pictures in pixels, and where the camera stands, radians to the subject's left.
WIDTH, HEIGHT, VIEWS = 430, 500, (0.0, 0.62)
CLOSENESS, LOWER, DEEPER = 0.78, 0.03, 0.14


def paths(face: Face, word: str, timing: api.Timing, vertices: Ints) -> Floats:
    """(T, k, 3) positions of vertices (k,) from rest to the held apex of a word."""
    cue = replace(timing.cue(api.expression(word)), apex=REST, offset=0.0)
    moving = np.stack([positions[vertices] for positions in face.performance([cue], fps=FPS)])
    return moving[:-1]


def tubes(moving: Floats) -> tuple[Floats, Ints, Floats]:
    """Positions (v, 3), quads (q, 4) and colours (v, 3) of the paths (T, k, 3) as tubes; dots where nothing moves."""
    path = np.linalg.norm(moving - moving[0], axis=2).max(axis=0)
    still = path < STILL
    steps, count, _ = moving.shape
    along = np.gradient(moving, axis=0)
    along[:, still] = (0.0, 0.0, 1.0)
    along = _unit(np.where(np.linalg.norm(along, axis=2, keepdims=True) < 1e-7, moving[-1] - moving[0] + 1e-9, along))
    aside = _unit(np.cross(along, [0.31, 0.86, 0.4]))
    upright = np.cross(along, aside)
    turn = 2.0 * np.pi * np.arange(SIDES) / SIDES
    ring = np.cos(turn)[:, None] * aside[:, :, None] + np.sin(turn)[:, None] * upright[:, :, None]
    swell = np.full((steps, count, 1, 1), RADIUS)
    swell[0] = swell[-1] = 0.05 * RADIUS
    swell[:, :] *= (0.45 + 0.55 * np.linspace(0.0, 1.0, steps))[:, None, None, None]
    points = moving.copy()
    points[:, still] = moving[0, still] + np.linspace(-1.0, 1.0, steps)[:, None, None] * RADIUS * np.array(
        [0.0, 0.0, 1.0]
    )
    number = np.arange(steps * count * SIDES).reshape(steps, count, SIDES)
    after = np.roll(number, -1, axis=2)
    quads = np.stack([number[:-1], after[:-1], after[1:], number[1:]], axis=-1).reshape(-1, 4)
    gone = np.linalg.norm(np.diff(moving, axis=0), axis=2).cumsum(axis=0)
    share = np.concatenate([np.zeros((1, count)), gone / np.maximum(gone[-1], 1e-12)])
    share[:, still] = 0.0
    hue = np.stack([np.interp(share, np.linspace(0.0, 1.0, len(COLOURS)), COLOURS[:, c]) for c in range(3)], axis=-1)
    surface = (points[:, :, None] + swell * ring).reshape(-1, 3)
    return surface, quads, np.repeat(hue.reshape(-1, 3), SIDES, axis=0)


def _unit(vectors: Floats) -> Floats:
    """Vectors (..., 3) at length 1."""
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12))


def _paint(mesh: Any, colours: Floats) -> None:
    """Store (v, 3) linear RGB as the mesh's active colours."""
    layer = mesh.color_attributes.new("path", "FLOAT_COLOR", "POINT")
    mesh.color_attributes.active_color = layer
    rgba = np.concatenate([colours, np.ones((len(colours), 1))], axis=1)
    layer.data.foreach_set("color", np.ascontiguousarray(rgba, dtype=np.float32).ravel())


def _head(face: Face) -> Any:
    """The default head, pale, and a little behind its own skin."""
    obj = head_object(api.build_default_head(), "head")
    bpy.context.collection.objects.link(obj)
    mesh = obj.data
    behind = face.vertices - BEHIND * vertex_normals(face.vertices, face.polygons)
    mesh.vertices.foreach_set("co", np.ascontiguousarray(behind, dtype=np.float32).ravel())
    _paint(mesh, np.broadcast_to(np.array(HEAD), face.vertices.shape))
    mesh.update()
    return obj


def pictures(face: Face, head: Any, moving: Floats) -> list[Floats]:
    """Pictures of paths (T, k, 3) over the head, one per view."""
    positions, quads, colours = tubes(moving)
    mesh = meshes.new_mesh("paths", positions, *meshes.flatten_polygons(list(quads)))
    _paint(mesh, colours)
    drawn = bpy.data.objects.new("paths", mesh)
    bpy.context.collection.objects.link(drawn)
    framing = framing_of(head)
    framing = replace(framing, centre=framing.point(0.0, -LOWER, -DEEPER), height=CLOSENESS * framing.height)
    seen = []
    for yaw in VIEWS:
        look = Look(width=WIDTH, height=HEIGHT, yaw=yaw, background=(0.82, 0.83, 0.85), fine=True)
        with tempfile.TemporaryDirectory(prefix="risorius-") as folder, studio([head, drawn], framing, look) as scene:
            scene.display.shading.color_type = "VERTEX"
            scene.display.shading.show_specular_highlight = False
            seen.append(read_picture(render_frame(scene, 1, Path(folder))))
    bpy.data.objects.remove(drawn)
    return seen


def main(arguments: Sequence[str]) -> int:
    """Write the picture; 0 when it is there."""
    parser = argparse.ArgumentParser(description="Paths of the skin from rest to the six expressions.")
    parser.add_argument("--timing", default="posed", choices=list(api.load_timings()))
    parser.add_argument("--out", type=Path, default=OUT / "trajectories.png")
    chosen = parser.parse_args(arguments)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    face, timing = api.default_face(), api.load_timings()[chosen.timing]
    head, vertices = _head(face), sampled_vertices(face, SPACING)
    cells = []
    for word in EMOTIONS:
        moving = paths(face, word, timing, vertices)
        longest = 1e3 * float(np.linalg.norm(np.diff(moving, axis=0), axis=2).sum(axis=0).max())
        cells.append(Cell(word, f"longest path {longest:.0f} mm", pictures(face, head, moving)))
    heading = f"Paths of the skin from rest (blue) to the apex (red), {timing.onset:g} s, {len(vertices)} places"
    print(write_grid(cells, chosen.out, columns=2, heading=heading))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
