"""The default head put together: skin, eyeballs, teeth, tongue, brows, materials, feature points."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...arrays import Floats, Ints
from ..mesh.parts import Part
from .brows import build_brow
from .cage import Region
from .eyes import PUPIL_VERTEX, build_eyeball
from .figures import DEFAULT_FIGURES, HeadFigures, read_figures
from .folding import folding_skin
from .groups import skin_groups
from .head_mesh import HeadMesh, Material
from .piece import Piece
from .points import skin_points
from .shades import shaded_materials
from .skin import HeadSkin
from .teeth import DentalArch, build_teeth
from .tongue import TIP_VERTEX, build_tongue, tongue_vertex

REGION_MATERIALS = {
    Region.UNDER_LID: "lid_rim",
    Region.NOSTRIL_DEPTH: "nostril",
}


def build_default_head(figures: str | Path | HeadFigures = DEFAULT_FIGURES) -> HeadMesh:
    """Build the default head, or another one from a table of the same form.

    Parameters
    ----------
    figures : the table (TOML file) or the figures read from it.

    Raises
    ------
    FormatError : a table with a missing or wrong entry.
    ModelError, SolverError : figures that make no head.

    Examples
    --------
    >>> head = api.build_default_head()
    >>> head.vertices.shape[1], len(head.polygons[0])
    (3, 4)
    """
    measured = figures if isinstance(figures, HeadFigures) else read_figures(figures)
    skin = folding_skin(measured)
    eye, brow = build_eyeball(measured.eyeball), build_brow(measured.brow, skin)
    upper = build_teeth(measured.teeth_upper, Part.TEETH_UPPER)
    lower = build_teeth(measured.teeth_lower, Part.TEETH_LOWER)
    tongue = build_tongue(measured.tongue)
    pieces = [eye, eye.mirrored(Part.EYEBALL_R), upper.piece, lower.piece, tongue, brow, brow.mirrored(Part.OTHER)]
    first = np.cumsum([len(skin.vertices), *(len(piece.vertices) for piece in pieces)])

    points = skin_points(measured, skin) | _inner_points(measured, first, upper, lower)
    points["11.5"] = points["11.4"]
    groups = skin_groups(skin) | {
        "brow_l": np.arange(first[5], first[6], dtype=np.int64),
        "brow_r": np.arange(first[6], first[7], dtype=np.int64),
    }
    centre = measured.eyeball.centre
    return HeadMesh(
        vertices=np.concatenate([skin.vertices, *(piece.vertices for piece in pieces)]),
        polygons=tuple(map(tuple, _all_quads(skin, pieces, first).tolist())),
        parts=_all_parts(skin, pieces),
        materials=tuple(Material(m.name, m.colour, m.roughness, m.metallic) for m in measured.materials),
        material_index=_material_index(measured, skin, pieces),
        points=points,
        groups=groups,
        figures=dict(skin.node_index),
        mirror=_all_mirror(skin, pieces, first),
        landmarks={
            "eyeball_l": centre,
            "eyeball_r": centre * np.array([-1.0, 1.0, 1.0]),
            "jaw_hinge": measured.condyle,
        },
    )


def _inner_points(figures: HeadFigures, first: Ints, upper: DentalArch, lower: DentalArch) -> dict[str, int | Floats]:
    """Feature points that are not on the skin; `first` (P + 1,) holds each piece's first vertex."""
    left, right, above, below, tongue = (int(i) for i in first[:5])
    return {
        "3.5": left + PUPIL_VERTEX,
        "3.6": right + PUPIL_VERTEX,
        "6.1": tongue + TIP_VERTEX,
        "6.2": tongue + tongue_vertex(0.5, 0),
        "6.3": tongue + tongue_vertex(0.5, 1),
        "6.4": tongue + tongue_vertex(0.5, -1),
        "7.1": figures.neck_pivot,
        "9.8": above + upper.gum_line,
        "9.9": below + lower.gum_line,
        "9.10": above + upper.edge,
        "9.11": below + lower.edge,
    }


def _all_quads(skin: HeadSkin, pieces: list[Piece], first: Ints) -> Ints:
    """Quads (F, 4) of the whole head."""
    return np.concatenate([skin.quads, *(piece.quads + start for piece, start in zip(pieces, first, strict=False))])


def _all_parts(skin: HeadSkin, pieces: list[Piece]) -> Ints:
    """Part of every vertex."""
    parts = [Part.SKIN, *(piece.part for piece in pieces)]
    counts = [len(skin.vertices), *(len(piece.vertices) for piece in pieces)]
    return np.repeat(np.array(parts, dtype=np.int64), counts)


def _all_mirror(skin: HeadSkin, pieces: list[Piece], first: Ints) -> Ints:
    """Mirror vertex of every vertex; a piece without its own mirror is next to its twin."""
    mirrors = [skin.mirror]
    twin: Ints | None = None
    for piece, start in zip(pieces, first, strict=False):
        here = np.arange(len(piece.vertices)) + start
        if piece.mirror is not None:
            mirrors.append(piece.mirror + start)
        elif twin is None:
            mirrors.append(here + len(here))
            twin = here
        else:
            mirrors.append(twin)
            twin = None
    return np.concatenate(mirrors).astype(np.int64)


def _material_index(figures: HeadFigures, skin: HeadSkin, pieces: list[Piece]) -> Ints:
    """Material of every quad, as an index into the figures' materials."""
    order = {material.name: i for i, material in enumerate(figures.materials)}
    shaded = shaded_materials(skin)
    names = [shaded.get(quad, REGION_MATERIALS.get(region, "skin")) for quad, region in enumerate(skin.regions)]
    names += [name for piece in pieces for name in piece.materials]
    return np.array([order[name] for name in names], dtype=np.int64)
