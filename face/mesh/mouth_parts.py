"""Telling teeth, gums and tongue apart in a mesh's mouth: by size, by the arch of the teeth, by what they touch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from ...arrays import Bools, Floats, Ints
from ...physics import mesh
from ...polygons import PolygonTable
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
    row_apart: Share
    row_tilt: float


@dataclass(frozen=True)
class TongueFigures:
    """The size of a tongue, and where it lies about its points (presets/anatomy/parts.toml)."""

    width: Pair
    shortest: Length
    in_arch: Share
    tip_reach: Length
    above: Length
    beside: float


#: Pieces of fewer vertices have no surface that could be told.
SURFACE = 4

#: So many pieces are single teeth, whose places tell how a row tilts; fewer are whole rows and their gums.
SINGLE = 9

#: Tilts of rows of teeth that are tried; an even step to either side of none. Spreads nearer than the other are equal.
TILTS, TIE = 9, 1e-12

MOUTH = read_figures("parts.mouth", MouthFigures)
TONGUE = read_figures("parts.tongue", TongueFigures)


def add_mouth_parts(parts: Ints, labels: Ints, positions: Floats, lips: Floats) -> Bools:
    """Give pieces of `Part.OTHER` that lie in the mouth to teeth or tongue, in place; returns (V,) gums of both jaws.

    Parameters
    ----------
    parts : (V,) numbers of `Part`. labels : (V,) number of each vertex's connected piece.
    positions : (V, 3) head space, metres.
    lips : (3,) middle between the lips.
    """
    members = [member for member in loose_pieces(parts, labels) if in_mouth(positions[member], lips)]
    pieces = [positions[member] for member in members]
    found = [mouth_part(piece, lips) for piece in pieces]
    arch = max((float(np.ptp(piece[:, 0])) for piece in pieces if _is_arch(piece)), default=np.inf)
    for number, piece in enumerate(pieces):
        if found[number] is Part.TONGUE and np.ptp(piece[:, 0]) > TONGUE.in_arch * arch:
            found[number] = _jaw_of(piece, lips)
    teeth = [number for number, part in enumerate(found) if part in (Part.TEETH_UPPER, Part.TEETH_LOWER)]
    for number, is_upper in zip(teeth, _upper_rows([pieces[number] for number in teeth], lips), strict=True):
        found[number] = Part.TEETH_UPPER if is_upper else Part.TEETH_LOWER
    gums = np.zeros(len(parts), dtype=bool)
    for member, part in zip(members, found, strict=True):
        parts[member] = int(Part.OTHER if part is None else part)
        gums[member] = part is None
    return gums


def loose_pieces(parts: Ints, labels: Ints) -> list[Ints]:
    """Vertices of each connected piece of `Part.OTHER` that has a surface; parts and pieces' numbers (V,)."""
    loose = np.flatnonzero(parts == Part.OTHER)
    order = loose[np.argsort(labels[loose], kind="stable")]
    starts = np.flatnonzero(np.diff(labels[order])) + 1
    return [member for member in np.split(order, starts) if len(member) >= SURFACE]


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
    teeth = _jaw_of(piece, lips)
    if width < TONGUE.width[0] or depth < TONGUE.shortest:
        return teeth
    if width > TONGUE.width[1] or _is_arch(piece):
        return None if low < -MOUTH.both_jaws and high > MOUTH.both_jaws else teeth
    return Part.TONGUE if low < 0.0 else Part.TEETH_UPPER


def _jaw_of(piece: Floats, lips: Floats) -> Part:
    """The jaw on whose side of the lips' line a piece (k, 3) of teeth has its middle height."""
    return Part.TEETH_UPPER if piece[:, 1].min() + piece[:, 1].max() > 2.0 * lips[1] else Part.TEETH_LOWER


def _upper_rows(teeth: Sequence[Floats], lips: Floats) -> Bools:
    """(p,) which pieces of teeth, each (k, 3), belong to the upper jaw.

    Where teeth lie one above the other there are two rows, each on a line that may rise or fall towards the throat,
    wherever the lips are: molars stand higher than the lips, and so do both rows of some drawn heads. Else the lips'
    line tells.
    """
    by_lips = np.array([_jaw_of(piece, lips) is Part.TEETH_UPPER for piece in teeth], dtype=bool)
    if len(teeth) < 2:
        return by_lips
    middles = np.array([(piece.min(axis=0) + piece.max(axis=0)) / 2.0 for piece in teeth])
    sizes = np.array([np.ptp(piece[:, [0, 2]], axis=0).max() for piece in teeth])
    apart = np.linalg.norm(middles[:, None, [0, 2]] - middles[:, [0, 2]], axis=2)
    near = apart < MOUTH.row_apart * np.minimum(sizes[:, None], sizes)
    if not near[~np.eye(len(teeth), dtype=bool)].any():
        return by_lips
    depths = middles[:, 2] if len(teeth) >= SINGLE else np.zeros(len(teeth))
    return _two_rows(middles[:, 1], depths)


def _two_rows(heights: Floats, depths: Floats) -> Bools:
    """(p,) which of some things lie in the upper of two rows that tilt alike; heights and depths (p,), metres.

    The tilt and the border for which the rows are thinnest, least squares.
    """
    best, upper = np.inf, np.ones(len(heights), dtype=bool)
    for tilt in np.linspace(-MOUTH.row_tilt, MOUTH.row_tilt, TILTS):
        level = heights - tilt * depths
        order = np.argsort(level, kind="stable")
        for border in range(1, len(level)):
            rows = level[order[:border]], level[order[border:]]
            spread = sum(float(((row - row.mean()) ** 2).sum()) for row in rows)
            if spread < best - TIE:
                best = spread
                upper = np.zeros(len(level), dtype=bool)
                upper[order[border:]] = True
    return upper


def _is_arch(piece: Floats) -> bool:
    """Whether a piece is a horseshoe, open towards the throat."""
    across = piece[:, 0] - (piece[:, 0].min() + piece[:, 0].max()) / 2.0
    along = (piece[:, 2] - piece[:, 2].min()) / max(float(np.ptp(piece[:, 2])), 1e-9)
    middle = np.abs(across) < MOUTH.arch_middle * np.ptp(piece[:, 0])
    return not (middle & (along > MOUTH.arch_depth[0]) & (along < MOUTH.arch_depth[1])).any()


def split_gums(parts: Ints, gums: Bools, positions: Floats, polygons: PolygonTable) -> None:
    """Give each vertex of `gums` (V,) to the jaw whose teeth are nearer along the surface, in place.

    Without any teeth they are two rows themselves. With teeth of one jaw nothing is known and `parts` stays as it is.

    Parameters
    ----------
    parts : (V,) numbers of `Part` with the teeth filled in.
    positions : (V, 3) head space, metres.
    """
    index = np.flatnonzero(gums)
    teeth = [np.flatnonzero(parts == part) for part in (Part.TEETH_UPPER, Part.TEETH_LOWER)]
    if all(len(row) == 0 for row in teeth) and len(index) > 1:
        seeds = _outer_halves(positions, index)
    elif all(len(row) > 0 for row in teeth):
        upper, lower = (cKDTree(positions[row]).query(positions[index])[0] for row in teeth)
        seeds = [index[(upper < MOUTH.gum) & (upper < lower)], index[(lower < MOUTH.gum) & (lower < upper)]]
    else:
        return
    if any(len(seed) == 0 for seed in seeds):
        return
    own = polygons.kept(polygons.within(gums))
    graph = mesh.adjacency(positions, own, diagonals=False)
    far = [dijkstra(graph, directed=False, indices=seed, min_only=True)[index] for seed in seeds]
    parts[index] = np.where(far[0] <= far[1], int(Part.TEETH_UPPER), int(Part.TEETH_LOWER))


def _outer_halves(positions: Floats, index: Ints) -> list[Ints]:
    """Of vertices `index` in two rows, those above the upper row's mean height and those below the lower row's."""
    height = positions[index, 1]
    upper = _two_rows(height, positions[index, 2])
    return [index[upper & (height >= height[upper].mean())], index[~upper & (height <= height[~upper].mean())]]


def split_tongue(
    parts: Ints, labels: Ints, positions: Floats, polygons: PolygonTable, points: Mapping[str, Floats]
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
    own = polygons.kept(polygons.within(inside))
    if len(own):
        graph = mesh.adjacency(positions, own, diagonals=False)
        far = dijkstra(graph, directed=False, indices=np.array([foremost]), min_only=True)
        parts[np.isfinite(far)] = int(Part.TONGUE)
