"""Eyes that are one surface with their lids: what is round between the lids is told from the skin.

Such an eye would be drawn along by its lids. As a part of its own it stays where it is, and the lids slide over it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.sparse.csgraph import connected_components, dijkstra

from ...arrays import Floats, Ints
from ...errors import ModelError
from ...physics import mesh
from ...physics.mesh import Sparse
from ...polygons import PolygonTable
from ..figures import Pair, Share, read_figures
from .eye_parts import EYES, between, covers
from .openings import LIDS, Opening, find_opening, outer_faces
from .parts import Part
from .sewn import sewn_openings
from .sphere import fit_sphere


@dataclass(frozen=True)
class SealedFigures:
    """When what lies between lids is an eye (presets/anatomy/parts.toml)."""

    radius: Pair
    roundness: Share
    ahead: Share
    beside: Share
    rim: Share


SEALED = read_figures("parts.sealed_eye", SealedFigures)

#: An eye needs this many vertices to be measured.
MEASURABLE = 12


def add_sealed_eyes(
    parts: Ints, positions: Floats, polygons: PolygonTable, nearest: Mapping[str, int], points: Mapping[str, Floats]
) -> None:
    """Give round skin between lids to its eye, in place, on sides that have no eyeball and whose lids are not shut.

    Parameters
    ----------
    parts : (V,) numbers of `Part`. positions : (V, 3) head space, metres.
    nearest : feature point -> vertex. points : feature point -> (3,) in head space.
    """
    sides = {"l": Part.EYEBALL_L, "r": Part.EYEBALL_R}
    wanted = {side: part for side, part in sides.items() if not (parts == part).any()}
    skin = polygons.kept(polygons.within(parts == Part.SKIN))
    if not wanted or not len(skin):
        return
    graph = mesh.adjacency(positions, skin, diagonals=False)
    shut = sewn_openings(mesh.adjacency(positions, skin), nearest, points)
    for side, part in wanted.items():
        if side in shut:
            continue
        try:
            opening = find_opening(graph, nearest, *LIDS[side])
            inner = _between(positions, skin, opening, nearest["9.3"])
        except ModelError:
            continue  # said where the face's skin is built
        eye = _round(positions, skin, graph, inner, np.array([points[name] for name in EYES[part]]))
        parts[eye] = int(part)


def _between(positions: Floats, skin: PolygonTable, opening: Opening, nose: int) -> Ints:
    """Vertices inside the margins of an opening that hang together with them, without the margins."""
    inside = skin.kept(~outer_faces(skin, [opening], nose))
    if not len(inside):
        return np.zeros(0, dtype=np.int64)
    _, piece = connected_components(mesh.adjacency(positions, inside, diagonals=False), directed=False)
    own = np.unique(inside.loops)
    held = np.intersect1d(opening.loop, own)
    return np.setdiff1d(own[np.isin(piece[own], piece[held])], opening.loop)


def _round(positions: Floats, skin: PolygonTable, graph: Sparse, inner: Ints, lids: Floats) -> Ints:
    """Those of some vertices that are one round eye between lids (4, 3); none where there is none.

    `graph` (V, V) has the lengths of the skin's edges.
    """
    none = np.zeros(0, dtype=np.int64)
    if len(inner) < MEASURABLE:
        return none
    centre, radius = fit_sphere(positions[inner])
    middle = lids.mean(axis=0)
    front = inner[np.linalg.norm(positions[inner, :2] - middle[:2], axis=1).argmin()]
    off = np.abs(np.linalg.norm(positions[inner] - centre, axis=1) - radius)
    if not SEALED.radius[0] < radius < SEALED.radius[1] or centre[2] > middle[2]:
        return none
    if np.median(off) > SEALED.roundness * radius or positions[front, 2] < centre[2] + SEALED.ahead * radius:
        return none
    if not _has_rims(positions, graph, inner, centre, radius):
        return none  # a shut lid
    ball = np.zeros(len(positions), dtype=bool)
    ball[inner[off < SEALED.roundness * radius]] = True
    own = skin.kept(skin.within(ball))
    if not len(own) or front not in own.loops:
        return none
    _, piece = connected_components(mesh.adjacency(positions, own, diagonals=False), directed=False)
    eye = np.unique(own.loops)
    if not covers(positions, own, between(lids)[:1]).all():
        return none  # the lining of lids round a hole
    return np.asarray(eye[piece[eye] == piece[front]], dtype=np.int64)


def _has_rims(positions: Floats, graph: Sparse, inner: Ints, centre: Floats, radius: float) -> bool:
    """Whether the skin beside an eye stands out of its ball, as lids do; a shut lid goes on as the ball does."""
    far = dijkstra(graph, directed=False, indices=inner, min_only=True, limit=SEALED.beside * radius)
    beside = np.setdiff1d(np.flatnonzero(np.isfinite(far)), inner)
    out = np.linalg.norm(positions[beside] - centre, axis=1) - radius
    return len(beside) > 0 and bool(np.median(out) > SEALED.rim * radius)
