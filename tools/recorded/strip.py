"""Moments of a recording on the default head, each with what the recording says there. Needs Blender's `bpy`."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import bpy
import numpy as np
from faithful.heads import load_face
from faithful.sheet import Cell, write_grid
from faithful.sitter import Sitter, View
from risorius.arrays import Floats

from .takes import Take

WIDTH, HEIGHT = 232, 280

#: What is shown -> which FAPs are largest there, with their signs.
MOMENTS: Mapping[str, tuple[tuple[int, ...], int]] = {
    "eyes shut": ((19, 20), 1),
    "brows up": ((31, 32, 35, 36), 1),
    "brows down": ((31, 32), -1),
    "to the left": ((23, 24), 1),
    "jaw open": ((3,), 1),
    "smile": ((12, 13, 6, 7), 1),
    "corners down": ((12, 13), -1),
    "pucker": ((6, 7), -1),
    "jaw aside": ((15,), 1),
    "up": ((25, 26), -1),
}


def write_strip(take: Take, path: Path) -> Path:
    """The moments of a recording as a JPEG; between them the seconds at which they are."""
    face = load_face("default")
    frames = {name: _moment(take.frames, *wanted) for name, wanted in MOMENTS.items()}
    poses = [face.pose(take.frames[frame]).positions for frame in frames.values()]
    pictures = Sitter.of_head("default", face, width=WIDTH, height=HEIGHT).shots(poses, View.FRONT)
    fps = take.recording.stream.fps
    cells = [
        Cell(name, f"{frame / fps:.1f} s", (picture,))
        for (name, frame), picture in zip(frames.items(), pictures, strict=True)
    ]
    heading = f"a recording of {take.title}, on the default head"
    grid = write_grid(cells, path.with_suffix(".png"), columns=5, heading=heading)
    _as_jpeg(grid, path)
    grid.unlink()
    return path


def _moment(frames: Floats, numbers: tuple[int, ...], sign: int) -> int:
    """The frame in which FAPs are largest together, each as a share of what it moves."""
    values = frames[:, np.array(numbers) - 1]
    return int((sign * values / np.ptp(values, axis=0)).sum(axis=1).argmax())


def _as_jpeg(source: Path, target: Path) -> None:
    """A picture in the format of the documentation's."""
    image = bpy.data.images.load(str(source))
    len(image.pixels)  # loads it
    image.filepath_raw, image.file_format = str(target), "JPEG"
    image.save(quality=85)
