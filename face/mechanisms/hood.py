"""The hood of the eye: skin between the brow and the upper lid goes with the brow, and folds over the lid.

Anatomy. Between brow and lid lies no bone but the orbit's septum. On it glides a pad of fat (retro-orbicularis) that
hangs on the brow, with the orbital part of the orbicularis oculi and its skin. So what moves the brow moves all of it
as one, down to the crease, where the skin folds over a lid whose plate stays: lowered brows lie over the eye like a
shelf. An elastic sheet that is tied evenly to bone spreads that way over the whole hood instead and folds nowhere.

Here the hood shows a share of the motion of the brow above it, wherever the pull comes from: u = v + m (s B v - v),
where B reads the brow's line, s is the share and m where it holds.

Source: scans of lowered and of raised inner brows, which agree (docs/muscles.md).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.spatial.distance import cdist

from ...arrays import Floats, Ints
from ...physics.mesh import Sparse, applied
from ..figures import Length, Pair, read_figures
from ..mechanism import Mechanism
from ..skin.outer import OuterSkin, nearer_side, smoothstep
from .separation import SEPARATION

#: Feature points of the brow from its head to its tail, and the corners of the eye from the nose outwards.
BROWS = {"l": ("4.1", "4.3", "4.5"), "r": ("4.2", "4.4", "4.6")}
CORNERS = {"l": ("3.11", "3.7"), "r": ("3.8", "3.12")}

#: Places along a brow; skin that counts for less than a share of the nearest's part is not read.
STATIONS, FAINT = 25, 1e-3

#: What is no distance, metres.
NO_DISTANCE = 1e-6


@dataclass(frozen=True)
class HoodFigures:
    """Of the hood (presets/anatomy/lids.toml)."""

    carried: Pair
    lid: Pair
    brow: Pair
    inner: Pair
    outer: Pair
    above: Pair
    read: Length
    midline: Length


HOOD = read_figures("lids.hood", HoodFigures)


class Hood:
    """The hoods of one face's eyes as a linear map of displacements, and its transpose."""

    def __init__(self, skin: OuterSkin) -> None:
        self._map = _carried(skin)

    def carry(self, fields: Floats) -> Floats:
        """(k, n, 3) displacements (k, n, 3) with hoods that go with the brows."""
        return fields if self._map is None else applied(self._map, fields)

    def carry_transposed(self, loads: Floats) -> Floats:
        """(k, n, 3) the loads on displacements that stand for loads (k, n, 3) on what `carry` makes of them."""
        return loads if self._map is None else applied(self._map.T.tocsr(), loads)


def _carried(skin: OuterSkin) -> Sparse | None:
    """(n, n) what the hoods make of a displacement; None: the face has none, or lids that are shut for good."""
    sides = [s for s in "lr" if s not in skin.sewn and {*BROWS[s], *CORNERS[s]} <= skin.points.keys()]
    if not skin.has(Mechanism.HOOD) or not sides:
        return None
    n = skin.vertex_count
    change = sparse.csr_array((n, n))
    for side in sides:
        change = change + _of_one_eye(skin, side)
    carried: Sparse = (sparse.eye_array(n) + change).tocsr()
    return carried


def _of_one_eye(skin: OuterSkin, side: str) -> Sparse:
    """(n, n) what one hood adds to a displacement: m (s B - 1)."""
    brow = _Brow(skin, side)
    upper, lower = skin.lid_distances(side)
    way = upper / np.maximum(brow.of(upper), NO_DISTANCE)
    inner, outer = (skin.points[name] for name in CORNERS[side])
    axis = outer - inner
    along = (skin.positions - inner) @ axis / (axis @ axis)
    above_corners = skin.positions[:, 1] - (inner + along[:, None] * axis)[:, 1]
    holds = (
        smoothstep((way - HOOD.lid[0]) / HOOD.lid[1])
        * smoothstep((HOOD.brow[0] - way) / HOOD.brow[1])
        * smoothstep((along - HOOD.inner[0]) / HOOD.inner[1])
        * smoothstep((HOOD.outer[0] - along) / HOOD.outer[1])
        * smoothstep((above_corners - HOOD.above[0]) / HOOD.above[1])
        * nearer_side(lower - upper, SEPARATION.lids)
        * smoothstep(skin.positions[:, 0] * brow.outwards / HOOD.midline)
    )
    share = smoothstep((way - HOOD.carried[0]) / HOOD.carried[1])
    change: Sparse = (sparse.diags_array(holds * share) @ brow.reader - sparse.diags_array(holds)).tocsr()
    return change


class _Brow:
    """The line of one brow on the skin, and the place of every vertex above or below it.

    Attributes
    ----------
    outwards : +1 on the left, -1 on the right.
    reader : (n, n) the displacement of the brow above or below each vertex.
    """

    def __init__(self, skin: OuterSkin, side: str) -> None:
        head, middle, tail = (skin.points[name] for name in BROWS[side])
        self.outwards = 1.0 if side == "l" else -1.0
        share = np.linspace(0.0, 2.0, STATIONS)[:, None]
        line = np.where(share < 1.0, head + share * (middle - head), middle + (share - 1.0) * (tail - middle))
        near = np.exp(-((cdist(line, skin.positions) / HOOD.read) ** 2))
        near = np.maximum(near - FAINT * near.max(axis=1, keepdims=True), 0.0) * skin.areas  # nothing begins abruptly
        on_line = sparse.csr_array(near / near.sum(axis=1, keepdims=True))
        self.reader: Sparse = (_between(line[:, 0], skin.positions[:, 0], self.outwards) @ on_line).tocsr()

    def of(self, values: Floats) -> Floats:
        """(n,) values (n,) of the skin at the brow above or below each vertex."""
        return np.asarray(self.reader @ values)


def _between(stations: Floats, places: Floats, outwards: float) -> Sparse:
    """(n, k) shares of the two stations (k,), seen from the front, between which each place (n,) lies; ends go on."""
    at = np.interp(outwards * places, outwards * stations, np.arange(len(stations)))
    first: Ints = np.minimum(at.astype(np.int64), len(stations) - 2)
    share = at - first
    every = np.arange(len(places))
    between: Sparse = sparse.csr_array(
        (np.concatenate([1.0 - share, share]), (np.tile(every, 2), np.concatenate([first, first + 1]))),
        shape=(len(places), len(stations)),
    )
    return between
