"""What bulges between lids that are one surface: an eye, whose lids stand out round it, or a lid shut over one.

Told from the shape of the skin, as points on smooth skin may lie where no lid ends.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.sparse.csgraph import connected_components, dijkstra

from ...arrays import Floats, Ints
from ...physics import mesh
from ...physics.mesh import Sparse
from ...polygons import PolygonTable
from ..figures import Pair, Share, read_figures
from .openings import LIDS, Opening, find_opening, outer_faces
from .sphere import fit_sphere


@dataclass(frozen=True)
class BallFigures:
    """When what lies between lids is a part of a ball (presets/anatomy/parts.toml)."""

    radius: Pair
    roundness: Share
    ahead: Share
    beside: Share
    rim: Share
    flush: Share


BALL = read_figures("parts.sealed_eye", BallFigures)

#: A ball needs this many vertices to be measured.
MEASURABLE = 12


@dataclass(frozen=True, eq=False)
class LidBall:
    """A part of a ball between lids.

    Attributes
    ----------
    on_ball : (k,) vertices between the lids that lie on it. front : the one in the middle of the lids.
    rim : how far the skin beside it stands out of the ball, share of the radius.
    """

    on_ball: Ints
    front: int
    rim: float

    @property
    def is_eye(self) -> bool:
        """Whether the lids stand out round it."""
        return self.rim > BALL.rim

    @property
    def is_lid(self) -> bool:
        """Whether the skin beside it goes on as the ball does: a lid that is shut."""
        return self.rim < BALL.flush


def lid_ball(
    positions: Floats,
    skin: PolygonTable,
    graph: Sparse,
    nearest: Mapping[str, int],
    points: Mapping[str, Floats],
    side: str,
) -> LidBall | None:
    """The ball between the lids of an eye, "l" or "r"; None where nothing is round there, or too little is there.

    Parameters
    ----------
    positions : (V, 3) head space, metres. skin : its polygons. graph : (V, V) lengths of their edges.
    nearest : feature point -> vertex. points : feature point -> (3,) in head space.

    Raises
    ------
    ModelError : where the points of the lids are not on one piece, or the nose is not on the skin.
    """
    inner = _between(positions, skin, find_opening(graph, nearest, *LIDS[side]), nearest["9.3"])
    if len(inner) < MEASURABLE:
        return None
    centre, radius = fit_sphere(positions[inner])
    middle = np.mean([points[name] for name in dict.fromkeys(sum(LIDS[side], ()))], axis=0)
    front = inner[np.linalg.norm(positions[inner, :2] - middle[:2], axis=1).argmin()]
    off = np.abs(np.linalg.norm(positions[inner] - centre, axis=1) - radius)
    if not BALL.radius[0] < radius < BALL.radius[1] or centre[2] > middle[2]:
        return None
    if np.median(off) > BALL.roundness * radius or positions[front, 2] < centre[2] + BALL.ahead * radius:
        return None
    far = dijkstra(graph, directed=False, indices=inner, min_only=True, limit=BALL.beside * radius)
    beside = np.setdiff1d(np.flatnonzero(np.isfinite(far)), inner)
    if not len(beside):
        return None
    out = np.linalg.norm(positions[beside] - centre, axis=1) - radius
    return LidBall(inner[off < BALL.roundness * radius], int(front), float(np.median(out)) / radius)


def _between(positions: Floats, skin: PolygonTable, opening: Opening, nose: int) -> Ints:
    """Vertices inside the margins of an opening that hang together with them, without the margins."""
    inside = skin.kept(~outer_faces(skin, [opening], nose))
    if not len(inside):
        return np.zeros(0, dtype=np.int64)
    _, piece = connected_components(mesh.adjacency(positions, inside, diagonals=False), directed=False)
    own = np.unique(inside.loops)
    held = np.intersect1d(opening.loop, own)
    return np.setdiff1d(own[np.isin(piece[own], piece[held])], opening.loop)
