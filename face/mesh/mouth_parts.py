"""Telling teeth, gums and tongue apart in a mesh's mouth: by size, by the arch of the teeth, by what they touch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from ...arrays import Bools, Floats, Ints
from ...physics import mesh
from ..figures import Length, Pair, Share, read_figures
from .parts import Part


@dataclass(frozen=True)
class MouthFigures:
    """Places and sizes of what lies in a mouth (presets/anatomy/parts.toml)."""

    half_width: Length
    depth: Pair
    half_height: Length
    both_jaws: Length
    gum: Length
    arch_middle: Share
    arch_depth: Pair


@dataclass(frozen=True)
class TongueFigures:
    """The size of a tongue, and where it lies about its points (presets/anatomy/parts.toml)."""

    width: Pair
    shortest: Length
    tip_reach: Length
    above: Length
    beside: float


MOUTH = read_figures("parts.mouth", MouthFigures)
TONGUE = read_figures("parts.tongue", TongueFigures)


def in_mouth(piece: Floats, lips: Floats) -> bool:
    """Whether a piece (k, 3) lies behind the lips, whose middle is (3,); head space, metres."""
    middle = piece.mean(axis=0) - lips
    narrow = np.abs(piece[:, 0] - lips[0]).max() < MOUTH.half_width
    inside = MOUTH.depth[0] < middle[2] < MOUTH.depth[1] and abs(middle[1]) < MOUTH.half_height
    return bool(narrow and inside)


def mouth_part(piece: Floats, lips: Floats) -> Part | None:
    """What a piece (k, 3) in the mouth is; None for gums of both jaws in one, which `split_gums` takes apart.

    Parameters
    ----------
    piece : (k, 3) head space, metres.
    lips : (3,) middle between the lips.
    """
    low, high = piece[:, 1].min() - lips[1], piece[:, 1].max() - lips[1]
    width, _, depth = np.ptp(piece, axis=0)
    teeth = Part.TEETH_UPPER if low + high > 0.0 else Part.TEETH_LOWER
    if width < TONGUE.width[0] or depth < TONGUE.shortest or _is_arch(piece):
        return teeth
    if width > TONGUE.width[1]:
        return None if low < -MOUTH.both_jaws and high > MOUTH.both_jaws else teeth
    return Part.TONGUE if low < 0.0 else Part.TEETH_UPPER


def _is_arch(piece: Floats) -> bool:
    """Whether a piece is a horseshoe, open towards the throat."""
    across = piece[:, 0] - (piece[:, 0].min() + piece[:, 0].max()) / 2.0
    along = (piece[:, 2] - piece[:, 2].min()) / max(float(np.ptp(piece[:, 2])), 1e-9)
    middle = np.abs(across) < MOUTH.arch_middle * np.ptp(piece[:, 0])
    return not (middle & (along > MOUTH.arch_depth[0]) & (along < MOUTH.arch_depth[1])).any()


def split_gums(parts: Ints, gums: Bools, positions: Floats, polygons: Sequence[Ints]) -> None:
    """Give each vertex of `gums` (V,) to the jaw whose teeth are nearer along the surface, in place.

    Without teeth of both jaws nothing is known and `parts` stays as it is.

    Parameters
    ----------
    parts : (V,) numbers of `Part` with the teeth filled in.
    positions : (V, 3) head space, metres.
    """
    index = np.flatnonzero(gums)
    teeth = [np.flatnonzero(parts == part) for part in (Part.TEETH_UPPER, Part.TEETH_LOWER)]
    if any(len(row) == 0 for row in teeth):
        return
    upper, lower = (cKDTree(positions[row]).query(positions[index])[0] for row in teeth)
    seeds = [index[(upper < MOUTH.gum) & (upper < lower)], index[(lower < MOUTH.gum) & (lower < upper)]]
    if any(len(seed) == 0 for seed in seeds):
        return
    own = [polygon for polygon in polygons if gums[polygon].all()]
    graph = mesh.adjacency(positions, own, diagonals=False)
    far = [dijkstra(graph, directed=False, indices=seed, min_only=True)[index] for seed in seeds]
    parts[index] = np.where(far[0] <= far[1], int(Part.TEETH_UPPER), int(Part.TEETH_LOWER))


def split_tongue(
    parts: Ints, labels: Ints, positions: Floats, polygons: Sequence[Ints], points: Mapping[str, Floats]
) -> None:
    """Tell a tongue from the lower gums that it is one surface with, by its feature points 6.1 to 6.4, in place.

    It is what lies between the borders, from the tip to as far behind the body, below the borders off the teeth, and
    hangs together with the tip. A mesh that has a tongue of its own, or a face without these points, stays as it is.

    Parameters
    ----------
    parts : (V,) numbers of `Part` with teeth and gums filled in.
    labels : (V,) number of each vertex's connected piece.
    positions : (V, 3) head space, metres.
    points : feature point -> (3,) in head space.
    """
    if (parts == Part.TONGUE).any() or any(name not in points for name in ("6.1", "6.2", "6.3", "6.4")):
        return
    tip, body, left, right = (points[name] for name in ("6.1", "6.2", "6.3", "6.4"))
    lower = np.flatnonzero(parts == Part.TEETH_LOWER)
    if len(lower) == 0:
        return
    distance, nearest = cKDTree(positions[lower]).query(tip)
    foremost = int(lower[nearest])
    teeth = positions[np.isin(parts, (Part.TEETH_LOWER, Part.TEETH_UPPER)) & (labels != labels[foremost])]
    if distance > TONGUE.tip_reach or len(teeth) == 0:
        return
    across, along = positions[:, 0] - (left[0] + right[0]) / 2.0, positions[:, 2] - body[2]
    length = tip[2] - body[2]
    inside = (labels == labels[foremost]) & (parts == Part.TEETH_LOWER)
    inside &= np.abs(across) <= TONGUE.beside * abs(left[0] - right[0]) / 2.0
    inside &= (along <= length + MOUTH.gum) & (along >= -length - MOUTH.gum)
    inside &= positions[:, 1] <= body[1] + TONGUE.above
    index = np.flatnonzero(inside)
    above_borders = positions[index, 1] >= min(left[1], right[1]) - MOUTH.gum
    off_teeth = cKDTree(teeth).query(positions[index])[0] >= MOUTH.gum
    inside[index] = off_teeth | above_borders
    inside[foremost] = True
    own = [polygon for polygon in polygons if inside[polygon].all()]
    if own:
        graph = mesh.adjacency(positions, own, diagonals=False)
        far = dijkstra(graph, directed=False, indices=np.array([foremost]), min_only=True)
        parts[np.isfinite(far)] = int(Part.TONGUE)
