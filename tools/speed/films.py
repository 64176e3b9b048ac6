"""Films of a motion before and after laid over one another: how far vertices, pixels and flicker differ.

Before: the implicit integrator with eight steps per frame; after: the way that faces move. Seen from the front and
left by Workbench. Needs a Python that has bpy.
"""

from __future__ import annotations

import argparse
import json
import tempfile
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import risorius.api as api
from mathutils import Matrix
from places import OUT
from risorius.scene.mesh import flatten_polygons, new_mesh

from .motion import SUBSTEPS, head, positions

#: Heads; pixels of a side of the picture; where camera and middle are in head space, metres; focal length, mm.
HEADS, SIDE = ("default", "ict.npz"), 300
CAMERA, MIDDLE, LENS = np.array([0.22, 0.06, 0.55]), np.array([0.0, 0.01, 0.0]), 68.0
#: Frames that are shown, and how much brighter their differences are.
SHOWN, BRIGHTER = 5, 8.0
#: The grey behind the head; differences of a pixel above so much of 255 are counted.
BEHIND, SEEN = 0.93, 8.0


class Stage:
    """One face before a camera."""

    def __init__(self, face: api.Face) -> None:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self._mesh: Any = new_mesh("face", face.vertices, *flatten_polygons(face.polygons))
        self._mesh.polygons.foreach_set("use_smooth", np.ones(len(self._mesh.polygons), dtype=np.bool_))
        camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        for each in (bpy.data.objects.new("face", self._mesh), camera):
            bpy.context.collection.objects.link(each)
        frame = face.anatomy.mesh.head_frame
        placed = [frame.to_face(place) for place in (CAMERA, MIDDLE)]
        away = placed[0] - placed[1]
        across = np.cross([0.0, 0.0, 1.0], away)
        axes = [each / np.linalg.norm(each) for each in (across, np.cross(away, across), away)]
        camera.matrix_world = Matrix(np.vstack([np.column_stack([*axes, placed[0]]), [0.0, 0.0, 0.0, 1.0]]).tolist())
        camera.data.lens, camera.data.clip_start = LENS, 1e-3 * face.scale
        scene = bpy.context.scene
        scene.camera, scene.render.engine, scene.render.film_transparent = camera, "BLENDER_WORKBENCH", True
        scene.render.resolution_x = scene.render.resolution_y = SIDE
        scene.render.image_settings.file_format, scene.display.shading.show_cavity = "PNG", True

    def picture(self, vertices: Any, path: Path) -> Any:
        """(SIDE, SIDE, 3) of the face with its vertices (V, 3) here, 0..1; `path` is written over."""
        self._mesh.vertices.foreach_set("co", vertices.astype(np.float32).ravel())
        self._mesh.update()
        bpy.context.scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(str(path))
        pixels = np.array(image.pixels[:]).reshape(SIDE, SIDE, 4)[::-1]
        bpy.data.images.remove(image)
        return pixels[..., :3] * pixels[..., 3:] + BEHIND * (1.0 - pixels[..., 3:])


def laid_over(face: api.Face) -> tuple[dict[str, float], Any]:
    """Figures of both films of a face, and rows of their pictures: before, after, difference."""
    before, after = positions(face, integrator="implicit", substeps=SUBSTEPS), positions(face)
    apart = np.linalg.norm(after - before, axis=2)
    stage = Stage(face)
    with tempfile.TemporaryDirectory() as folder:
        films = [np.array([stage.picture(each, Path(folder) / "one.png") for each in film]) for film in (before, after)]
    differ = np.abs(films[0] - films[1]).max(axis=3)
    change = [255.0 * np.abs(np.diff(film, axis=0)).mean(axis=(1, 2, 3)) for film in films]
    jolts = [1e3 * np.linalg.norm(np.diff(film, n=2, axis=0), axis=2).mean() for film in (before, after)]
    figures = {
        "frames": len(before),
        "vertex_mm": 1e3 * float(apart.max()) / face.scale,
        "pixel": 255.0 * float(differ.max()),
        "pixels_seen": float((255.0 * differ > SEEN).mean()),
        "pixel_mean": 255.0 * float(differ.mean()),
        "flicker_before": float(change[0].mean()),
        "flicker_after": float(change[1].mean()),
        "flicker_apart": float(np.abs(change[0] - change[1]).max()),
        "jolt_before_mm": float(jolts[0]),
        "jolt_after_mm": float(jolts[1]),
    }
    worst = int(apart.max(axis=1).argmax())
    shown = np.linspace(0, len(before) - 1, SHOWN + 2).astype(int)[1:-1]
    shown[np.abs(shown - worst).argmin()] = worst
    rows = [np.concatenate(list(film[shown]), axis=1) for film in films]
    rows.append(
        np.repeat(np.clip(1.0 - BRIGHTER * np.concatenate(list(differ[shown]), axis=1), 0.0, 1.0)[..., None], 3, 2)
    )
    return figures, np.concatenate(rows)


def main(argv: list[str]) -> None:
    """Lay the films of each head over one another; write figures and pictures."""
    parser = argparse.ArgumentParser(prog="bench_speed.py films", description=__doc__)
    parser.add_argument("--out", type=Path, default=OUT / "bench")
    folder: Path = parser.parse_args(argv).out
    folder.mkdir(parents=True, exist_ok=True)
    found: dict[str, dict[str, float]] = {}
    for name in HEADS:
        title = name.removesuffix(".npz")
        found[title], rows = laid_over(head(name))
        np.save(folder / f"films_{title}.npy", (255.0 * rows).round().astype(np.uint8))
        print(title, json.dumps(found[title]), flush=True)
    (folder / "films.json").write_text(json.dumps(found, indent=1))
