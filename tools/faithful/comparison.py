"""Sheets of expressions beside what the model makes of their FAPs: shape, model, distance between them in colour."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from risorius.api import Drive, Face, Part
from risorius.arrays import Floats
from risorius.face.mesh.template import MM

from .scans import Shape, head_displacement
from .sheet import Cell, write_grid
from .sitter import Sitter, View

#: Rows of a sheet, so that it can be read on a screen.
ROWS = 5

#: Distance and its colour (linear RGB); beyond the last it stays the last.
RAMP = ((0.0, (0.25, 0.3, 0.36)), (1.0, (0.1, 0.42, 0.5)), (2.5, (0.8, 0.6, 0.1)), (5.0, (0.75, 0.05, 0.03)))
INSIDE = (0.12, 0.12, 0.12)
LEGEND = "shape, model (exact drive), distance: grey 0, blue 1, yellow 2.5, red 5 mm"


def write_comparison(name: str, face: Face, shapes: Sequence[Shape], folder: Path) -> list[Path]:
    """Write NAME-scans-1.png and so on of a head's shapes into a folder."""
    sitter = Sitter.of_head(name, face, width=300, height=360)
    poses = [face.pose(shape.frame, drive=Drive.EXACT).positions for shape in shapes]
    cells = []
    coloured = [distance_colours(face, pose - shape.positions) for pose, shape in zip(poses, shapes, strict=True)]
    views = []
    for view in View:
        scans = sitter.shots([shape.positions for shape in shapes], view)
        views.append((scans, sitter.shots(poses, view), sitter.shots(poses, view, coloured)))
    for number, (shape, pose) in enumerate(zip(shapes, poses, strict=True)):
        pictures = [column[number] for columns in views for column in columns]
        cells.append(Cell(shape.name, _caption(face, shape, pose), pictures))
    return [
        write_grid(
            cells[start : start + ROWS],
            folder / f"{name}-scans-{start // ROWS + 1}.png",
            columns=1,
            heading=f"{name}: {LEGEND}",
        )
        for start in range(0, len(cells), ROWS)
    ]


def _caption(face: Face, shape: Shape, pose: Floats) -> str:
    """How much is explained, and how far off the worst of the skin is."""
    share = shape.explained_by(head_displacement(face, pose)[shape.skin])
    away = np.linalg.norm(pose - shape.positions, axis=1)[shape.skin] / MM
    return f"explained {share:.2f}; worst {away.max():.1f} mm"


def distance_colours(face: Face, difference: Floats) -> Floats:
    """(V, 3) linear RGB by the lengths of differences (V, 3) in metres; what is not skin is dark."""
    distances = np.linalg.norm(difference, axis=1) / MM
    steps, colours = np.array([step for step, _ in RAMP]), np.array([colour for _, colour in RAMP])
    shown = np.stack([np.interp(distances, steps, channel) for channel in colours.T], axis=1)
    return np.where((np.asarray(face.parts) == Part.SKIN)[:, None], shown, np.array(INSIDE))
