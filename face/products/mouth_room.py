"""The room behind the lips: how large a mouth bag is, and mouths that end in an open border and have none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats, Ints
from ...physics.mesh import pair_keys
from ...polygons import PolygonTable
from ..face import Face
from ..figures import Length, Pair, Share, read_figures
from ..mesh.parts import Part


@dataclass(frozen=True)
class BagFigures:
    """Of the mouth bag behind lips that are cut open or have none (presets/anatomy/mouth_bag.toml)."""

    lining: Length
    depth: Length
    height: Length
    narrowing: Share


@dataclass(frozen=True)
class BorderFigures:
    """Which open border of the skin is that of a mouth."""

    width: Pair
    height: Share
    away: Share


BAG = read_figures("mouth_bag.bag", BagFigures)
BORDER = read_figures("mouth_bag.border", BorderFigures)


@dataclass(frozen=True, eq=False)
class MouthRoom:
    """The room behind a mouth, in the face's coordinates.

    Attributes
    ----------
    ends : (2, 3) where it begins at the left and at the right.
    up, inwards : (3,) unit vectors. lining, depth, height : how far the lips' inner skin reaches, how deep it is, and
        how high to either side.
    narrowing : how much narrower it is at its end, a share.
    """

    ends: Floats
    up: Floats
    inwards: Floats
    lining: float
    depth: float
    height: float
    narrowing: float


def mouth_room(face: Face, ends: Floats) -> MouthRoom:
    """The room between two `ends` (2, 3), left and right, of the face's coordinates."""
    frame = face.anatomy.mesh.head_frame
    return MouthRoom(
        ends=ends,
        up=frame.axes[1],
        inwards=-frame.axes[2],
        lining=frame.scale * BAG.lining,
        depth=frame.scale * BAG.depth,
        height=frame.scale * BAG.height,
        narrowing=BAG.narrowing,
    )


@dataclass(frozen=True, eq=False)
class MouthBorder:
    """The open border that a mouth ends in.

    Attributes
    ----------
    upper, lower : vertices in order from the right end to the left one; the ends belong to both.
    doubled : how many of them have copies in their place.
    """

    upper: Ints
    lower: Ints
    doubled: int


def mouth_border(face: Face) -> MouthBorder | None:
    """The open border behind the lips of a face, through which what lies behind it shows; None where there is none."""
    own, points = face.anatomy.mesh, face.anatomy.mesh.landmarks
    if any(name not in points for name in ("2.2", "2.3", "2.4", "2.5")):
        return None
    width = float(np.linalg.norm(points["2.4"] - points["2.5"]))
    middle = np.mean([points[name] for name in ("2.2", "2.3", "2.4", "2.5")], axis=0)
    found: list[tuple[float, Ints]] = []
    for loop in _borders(own.polygons.kept(own.polygons.within(own.parts == Part.SKIN))):
        places = own.positions[loop]
        size, away = np.ptp(places, axis=0) / width, np.linalg.norm(places.mean(axis=0) - middle) / width
        if BORDER.width[0] < size[0] < BORDER.width[1] and size[1] < BORDER.height and away < BORDER.away:
            found.append((float(size[0]), loop))
    if not found:
        return None
    loop = max(found, key=lambda each: each[0])[1]
    across = own.positions[loop, 0]
    ahead = np.roll(loop, -int(across.argmin()))
    end = int(own.positions[ahead, 0].argmax())
    arcs = [ahead[: end + 1], np.append(ahead[end:], ahead[0])[::-1]]
    upper, lower = sorted(arcs, key=lambda arc: -float(own.positions[arc, 1].mean()))
    return MouthBorder(upper, lower, int(np.isin(own.seams.leads[own.seams.copies], loop).sum()))


def _borders(polygons: PolygonTable) -> list[Ints]:
    """The closed lines of open edges, without those that touch themselves."""
    start, end = polygons.loops, polygons.after
    _, first, count = np.unique(
        pair_keys(np.sort(np.stack([start, end], axis=1), axis=1)), return_index=True, return_counts=True
    )
    is_open = first[count == 1]
    following = dict(zip(start[is_open].tolist(), end[is_open].tolist(), strict=True))
    loops = []
    while following:
        line = [next(iter(following))]
        while (after := following.pop(line[-1], None)) is not None:
            line.append(after)
        if len(line) > 3 and line[0] == line[-1]:
            loops.append(np.array(line[:-1], dtype=np.int64))
    return loops
