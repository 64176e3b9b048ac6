"""Eyes that are one surface with their lids: what is round between the lids is told from the skin.

Such an eye would be drawn along by its lids. As a part of its own it stays where it is, and the lids slide over it.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.sparse.csgraph import connected_components

from ...arrays import Floats, Ints
from ...errors import ModelError
from ...physics import mesh
from ...polygons import PolygonTable
from .eye_parts import EYES, between, covers
from .lid_ball import LidBall, lid_ball
from .parts import Part
from .sewn import sewn_openings


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
    shut = sewn_openings(positions, skin, nearest, points)
    for side, part in wanted.items():
        if side in shut:
            continue
        try:
            ball = lid_ball(positions, skin, graph, nearest, points, side)
        except ModelError:
            continue  # said where the face's skin is built
        if ball is not None and ball.is_eye:
            eye = _filled(positions, skin, ball, np.array([points[name] for name in EYES[part]]))
            parts[eye] = int(part)


def _filled(positions: Floats, skin: PolygonTable, ball: LidBall, lids: Floats) -> Ints:
    """Those vertices of a ball between lids (4, 3) that are one piece with its front; none where this is no eye."""
    chosen = np.zeros(len(positions), dtype=bool)
    chosen[ball.on_ball] = True
    own = skin.kept(skin.within(chosen))
    if not len(own) or ball.front not in own.loops:
        return np.zeros(0, dtype=np.int64)
    if not covers(positions, own, between(lids)[:1]).all():
        return np.zeros(0, dtype=np.int64)  # the lining of lids round a hole
    _, piece = connected_components(mesh.adjacency(positions, own, diagonals=False), directed=False)
    eye = np.unique(own.loops)
    return np.asarray(eye[piece[eye] == piece[ball.front]], dtype=np.int64)
