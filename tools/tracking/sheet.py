"""Emotions shown by one head, and what another head makes of what the camera saw. Needs Blender's `bpy`."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import risorius.api as api
from faithful.heads import load_face
from faithful.sheet import Cell, write_grid
from faithful.sitter import Sitter, View
from risorius.scene.pictures.lettering import read_picture

from .known import EMOTIONS, READ, TRUTH

SIZE = 256


def write_sheet(film: Path, path: Path) -> Path:
    """The six emotions of a film at their apexes, each beside the default head playing what was read; a JPEG."""
    shown = np.load(film / TRUTH)["shown"].tolist()
    apexes = [shown.index(word) + 1 for word in EMOTIONS]
    frames = api.read_fap(film / READ).frames
    face = load_face("default")
    poses = [face.pose(frames[apex]).positions for apex in apexes]
    played = Sitter.of_head("default", face, width=SIZE, height=SIZE).shots(poses, View.FRONT)
    cells = [
        Cell(word, "filmed, played", (read_picture(film / f"{apex + 1:04d}.png")[::2, ::2], picture))
        for word, apex, picture in zip(EMOTIONS, apexes, played, strict=True)
    ]
    grid = write_grid(
        cells, film / "sheet.png", columns=2, heading="a film of one head, tracked, and played on another"
    )
    image = bpy.data.images.load(str(grid))
    len(image.pixels)  # loads it
    image.filepath_raw, image.file_format = str(path), "JPEG"
    image.save(quality=85)
    grid.unlink()
    return path
