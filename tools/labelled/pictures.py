"""Neutral heads from several sides, and which place of the resting head each pixel shows. Needs Blender's `bpy`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from faithful.heads import HEADS, load_face
from faithful.sitter import Sitter, object_alone
from risorius.api import Face
from risorius.arrays import Floats
from risorius.labels.pictures import normals_of
from risorius.labels.raster import Triangles, draw
from risorius.scene.faces import Piece
from risorius.scene.labels.lens import view_of
from risorius.scene.labels.stage import stage_of
from risorius.scene.pictures.studio import render_frame, studio
from tracking.neutral_faces import _nodding, _variants, painted_object
from tracking.sides import SIDES

SIZE = 512


def picture_heads(out: Path) -> Path:
    """Write NAME/side-1.png ..., each with a .npz of what its pixels show, and NAME/head.npz, into a folder."""
    for name, obj, face in _sitters():
        folder = out / name
        folder.mkdir(parents=True, exist_ok=True)
        names = [point for point in face.points if face.points[point].is_bound]
        places = np.array([face.points[point].position for point in names])
        np.savez(folder / "head.npz", names=names, places=_in_head_space(face, places))
        sitter = Pictured([obj], width=SIZE, height=SIZE)
        for number, (degrees, nod) in enumerate(SIDES, 1):
            sitter.picture(face, _nodding(face.vertices, nod), degrees, folder / f"side-{number}")
    return out


def _sitters() -> Iterator[tuple[str, Any, Face]]:
    for name in HEADS:
        face = load_face(name)
        yield name, object_alone(name, face), face
    for name, face in _variants():
        yield name, painted_object(name, face), face


def _in_head_space(face: Face, places: Floats) -> Floats:
    """(n, 3) metres of head space."""
    return face.anatomy.mesh.head_frame.to_head(places)


class Pictured(Sitter):
    """A head that is pictured together with what each pixel shows."""

    def picture(self, face: Face, positions: Floats, degrees: float, to: Path) -> None:
        """Write a picture of positions (V, 3), and (H, W, 3) places in head space with (H, W) cosines to the camera."""
        mesh = self._object.data
        with studio(self._objects, self._framing, replace(self._look, yaw=float(np.radians(degrees)))) as scene:
            mesh.vertices.foreach_set("co", np.ascontiguousarray(positions, dtype=np.float32).ravel())
            mesh.update()
            render_frame(scene, 1, to.parent).rename(to.with_suffix(".png"))
            scene.view_layers[0].update()
            view = view_of(scene)
            shown = stage_of(scene, [Piece(self._object, 0, face.vertices, np.eye(4))]).shown
        drawn = draw(Triangles.of(view, view.before(shown.vertices), shown.triangles))
        corners = shown.source[shown.triangles[drawn.triangle]]
        places = np.einsum("hwk,hwki->hwi", drawn.shares, _in_head_space(face, face.vertices)[corners])
        places[~drawn.there] = np.nan
        facing = -normals_of(view, shown, drawn)[..., 2]
        np.savez_compressed(to.with_suffix(".npz"), places=places.astype(np.float32), facing=facing.astype(np.float32))
