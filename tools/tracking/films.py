"""Films of heads that show a known stream, as pictures with the FAPs measured on every one. Needs Blender's `bpy`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from faithful.heads import load_face
from faithful.sitter import Sitter, object_alone
from risorius.arrays import Floats
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.studio import render_frame, studio

from .known import FPS, STREAMS, TRUTH, stream_of

SIZE = 512


#: Where the camera stands: degrees to the subject's left.
VIEWS = (0, 20)


class Filmed(Sitter):
    """A face that is filmed from any side."""

    def film(self, poses: Sequence[Floats], degrees: float, folder: Path) -> None:
        """Write 0001.png, 0002.png, ... of poses (V, 3)."""
        folder.mkdir(parents=True, exist_ok=True)
        mesh = self._object.data
        with studio(self._objects, self._framing, replace(self._look, yaw=float(np.radians(degrees)))) as scene:
            for number, positions in enumerate(poses, 1):
                mesh.vertices.foreach_set("co", np.ascontiguousarray(positions, dtype=np.float32).ravel())
                mesh.update()
                render_frame(scene, number, folder)


def film_head(name: str, kind: str, out: Path) -> list[Path]:
    """Film a stream of `STREAMS` on a head of `faithful.heads` from every side; the folders, each with its truth."""
    face = load_face(name)
    stream, shown = stream_of(STREAMS[kind]())
    poses, truth = [], []
    for frame in stream:
        silent = np.isnan(frame).all()
        positions = face.vertices if silent else face.pose(frame).positions
        poses.append(positions)
        truth.append(face.measure(positions))
    obj = object_alone(name, face)
    sitter = Filmed([obj], width=SIZE, height=SIZE, framing=framing_of(obj))  # whole, as before a webcam
    folders = []
    for degrees in VIEWS:
        folder = out / kind / f"{name}-{degrees}"
        sitter.film(poses, degrees, folder)
        np.savez(folder / TRUTH, frames=np.array(truth), shown=np.array(shown), fps=FPS)
        folders.append(folder)
    return folders
