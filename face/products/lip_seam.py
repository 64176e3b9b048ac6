"""The seam between sewn lips: where a mouth is to be cut open, and what room there is behind it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from ...arrays import Floats, Ints
from ...errors import ModelError
from ...physics import mesh
from ...physics.elastic import Factor, diagonal_matrix
from ..face import Face
from ..mesh.openings import Opening, find_opening
from ..skin.outer import OuterSkin
from .mouth_room import MouthRoom, mouth_room

#: Outer contours of the lips, from corner to corner and back.
UPPER, LOWER = ("8.3", "8.5", "8.1", "8.6", "8.4"), ("8.4", "8.8", "8.2", "8.7", "8.3")
#: Points of the inner lips that lie across from each other, from left to right.
PAIRS = (("2.4", "2.4"), ("2.6", "2.8"), ("2.2", "2.3"), ("2.7", "2.9"), ("2.5", "2.5"))

#: Places along the seam where it is looked for, and shares at each; how far along it, a share of the mouth's width, and
#: across it, a share, the groove is averaged.
STATIONS, LEVELS, ALONG, ACROSS = 33, 51, 0.05, 0.04
#: What it costs to leave the place that the points tell, and to change from station to station, per square of a share;
#: the deepest groove at a station is worth 1.
PRIOR, STEADY = 10.0, 60.0
#: Skin that hangs together with neither contour has any share: this small tie, of its stiffness, keeps it at 0.
TIE = 1e-9


@dataclass(frozen=True, eq=False)
class LipSeam:
    """The seam of a sewn mouth, in the face's coordinates.

    Attributes
    ----------
    above : (V,) how far along the skin each vertex of the lips lies above the seam, negative below; NaN elsewhere.
    room : behind it.
    doubled : how many vertices of the lips are copies of others, which a cut would have to part, too.
    """

    above: Floats
    room: MouthRoom
    doubled: int


def lip_seam(face: Face) -> LipSeam:
    """The seam of a face with sewn lips.

    Raises
    ------
    ModelError : its lips are not sewn, or it lacks points of the outer lips.
    """
    if "mouth" not in face.sewn:
        raise ModelError("the lips are not sewn together: there is nothing to cut")
    skin, placed = face.anatomy.given_skin, face.anatomy.mesh.head_frame
    missing = [name for name in (*UPPER, *LOWER) if name not in skin.points]
    if missing:
        raise ModelError(f"the face lacks the feature points {', '.join(sorted(set(missing)))}: add them")
    above = np.full(len(face.vertices), np.nan)
    above[skin.index] = _above(skin) * placed.scale
    seams = face.anatomy.mesh.seams
    doubled = int(np.isfinite(above[seams.leads[seams.copies]]).sum())
    ends = placed.to_face(np.array([skin.points["2.4"], skin.points["2.5"]]))
    return LipSeam(above, mouth_room(face, ends), doubled)


def _above(skin: OuterSkin) -> Floats:
    """(n,) how far along the skin its vertices lie above the seam, NaN where it is not near; head space, metres.

    A vertex lies between the lips' outer contours at some share of the way from the upper to the lower one, as smooth
    over the skin as may be. The seam is at the share where the skin is most hollow.
    """
    graph = mesh.adjacency(skin.positions, skin.polygons)
    names = sorted({*UPPER, *LOWER})
    held = _nearest(skin, np.array([skin.points[name] for name in names]))
    contours = find_opening(graph, dict(zip(names, held.tolist(), strict=True)), UPPER, LOWER)
    upper, lower = (
        dijkstra(graph, directed=False, indices=arc, min_only=True) for arc in (contours.upper, contours.lower)
    )
    way = np.maximum(upper + lower, 1e-9)
    share = _share(skin, contours)
    middle = skin.points["8.1"], skin.points["8.2"]
    near = way < 1.5 * float(np.max(way[_nearest(skin, np.array(middle))]))
    seam = _seam_share(skin, np.where(near, share, np.nan))
    return np.where(near, (seam - share) * way, np.nan)


def _share(skin: OuterSkin, contours: Opening) -> Floats:
    """(n,) the harmonic function that is 0 on the upper and 1 on the lower of two contours."""
    fixed = np.zeros(skin.vertex_count, dtype=bool)
    fixed[contours.loop] = True
    value = np.zeros(skin.vertex_count)
    value[contours.lower] = 1.0
    value[np.intersect1d(contours.upper, contours.lower)] = 0.5
    free, held = np.flatnonzero(~fixed), np.flatnonzero(fixed)
    rows = skin.laplacian[free]
    own = rows[:, free] + diagonal_matrix(TIE * np.maximum(rows[:, free].diagonal(), TIE))
    value[free] = Factor(own).solve(np.asarray(-(rows[:, held] @ value[held])))
    return value


def _nearest(skin: OuterSkin, places: Floats) -> Ints:
    """(k,) the vertices nearest to places (k, 3)."""
    return np.asarray(cKDTree(skin.positions).query(places)[1], dtype=np.int64)


def _seam_share(skin: OuterSkin, share: Floats) -> Floats:
    """(n,) the share at which the seam lies, across from each vertex; from the shares (n,) of vertices near it."""
    told = []
    for pair in (pair for pair in PAIRS if all(name in skin.points for name in pair)):
        vertices = _nearest(skin, np.array([skin.points[name] for name in pair]))
        told.append((np.mean([skin.points[name][0] for name in pair]), np.nanmean(share[vertices])))
    places, shares = (np.array(column) for column in zip(*sorted(told), strict=True))
    bent = np.asarray(skin.laplacian @ skin.positions) / np.maximum(skin.areas, 1e-12)[:, None]
    hollow = np.maximum(-(bent * skin.normals).sum(axis=1), 0.0)
    stations = np.linspace(places[0], places[-1], STATIONS)
    prior = np.interp(stations, places, shares)
    levels = np.linspace(0.0, 1.0, LEVELS)
    index = np.flatnonzero(np.isfinite(share) & (hollow > 0.0))
    along = np.exp(-(((stations[:, None] - skin.positions[index, 0]) / (ALONG * np.ptp(places))) ** 2))
    across = np.exp(-(((levels[:, None] - share[index]) / ACROSS) ** 2))
    groove = (along * (hollow[index] ** 2 * skin.areas[index])) @ across.T
    groove /= np.maximum(groove.max(axis=1, keepdims=True), 1e-30)
    found = levels[_smooth_way(groove - PRIOR * (levels - prior[:, None]) ** 2, levels)]
    return np.asarray(np.interp(skin.positions[:, 0], stations, gaussian_filter1d(found, 1.0, mode="nearest")))


def _smooth_way(worth: Floats, levels: Floats) -> Ints:
    """(s,) the level at each station for which worth (s, l) less the cost of changing levels (l,) is largest in all."""
    cost = STEADY * (levels[:, None] - levels) ** 2
    total, before = worth[0], []
    for row in worth[1:]:
        reached = total - cost
        before.append(reached.argmax(axis=1))
        total = row + reached.max(axis=1)
    way = [int(total.argmax())]
    for step in reversed(before):
        way.append(int(step[way[-1]]))
    return np.array(way[::-1], dtype=np.int64)
