"""The cage of the default head: names, quads and regions, half by half. Topology only, no positions.

The half cage is a grid of rows (crown to neck) and columns (front midline to back midline) with four rectangular
holes, each filled by rings of equal count; a small cap grid closes the crown instead of a pole. So everything is
quads, and the only irregular vertices are the hole corners, the cap corners and the floors of ear, nostril and mouth.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import lru_cache
from itertools import pairwise

import numpy as np

from ...arrays import Ints
from ...errors import ModelError

ROWS = 23
COLUMNS = 15
CAP_ROWS = 9

# First and one-past-last row and column of the cells left out of the grid.
EYE_HOLE = (3, 7, 3, 7)
MOUTH_HOLE = (13, 15, 0, 4)
NOSTRIL_HOLE = (10, 12, 1, 2)
EAR_HOLE = (5, 10, 9, 11)
HOLES = (EYE_HOLE, MOUTH_HOLE, NOSTRIL_HOLE, EAR_HOLE)

# Grid nodes round each hole, in ring order; the rings inside have the same count.
EYE_RIM = (
    (5, 3), (4, 3), (3, 3), (3, 4), (3, 5), (3, 6), (3, 7), (4, 7),
    (5, 7), (6, 7), (7, 7), (7, 6), (7, 5), (7, 4), (7, 3), (6, 3),
)  # fmt: skip
MOUTH_RIM = ((13, 0), (13, 1), (13, 2), (13, 3), (13, 4), (14, 4), (15, 4), (15, 3), (15, 2), (15, 1), (15, 0))
NOSTRIL_RIM = ((10, 1), (11, 1), (12, 1), (12, 2), (11, 2), (10, 2))
EAR_RIM = (
    (5, 9), (5, 10), (5, 11), (6, 11), (7, 11), (8, 11), (9, 11),
    (10, 11), (10, 10), (10, 9), (9, 9), (8, 9), (7, 9), (6, 9),
)  # fmt: skip

EYE_RINGS = ("E4", "E3", "E2", "E1", "E0")
MOUTH_RINGS = ("M4", "M3", "M2", "M1", "M0", "B1", "B2")
NOSTRIL_RINGS = ("N1", "N2")
EAR_RINGS = ("A1", "A2", "A3", "A4")

RIGHT_SUFFIX = ".R"


class Region(Enum):
    """What a cage quad covers; its four children on the finished mesh inherit it."""

    FACE = "face"
    EYELID = "eyelid"
    LID_RIM = "lid_rim"
    UNDER_LID = "under_lid"
    MOUTH_ROLL = "mouth_roll"
    LIPS = "lips"
    MOUTH_BAG = "mouth_bag"
    NOSTRIL = "nostril"
    NOSTRIL_DEPTH = "nostril_depth"
    EAR = "ear"


@dataclass(frozen=True, eq=False)
class Cage:
    """The whole cage: the left half followed by the right half's own nodes.

    Attributes
    ----------
    names : (V,) node names; those of the right half end in ".R".
    quads : (F, 4) int64, outward winding; face `f` of the left half and `f + F / 2` mirror each other.
    regions : (F,) the region of every quad.
    mirror : (V,) int64, the node on the other side; a midline node is its own mirror.
    """

    names: tuple[str, ...]
    quads: Ints
    regions: tuple[Region, ...]
    mirror: Ints

    def __post_init__(self) -> None:
        if len(self.regions) != len(self.quads) or len(self.mirror) != len(self.names):
            raise ModelError("the default head's cage needs a region per quad and a mirror per node")
        if not np.array_equal(self.mirror[self.mirror], np.arange(len(self.names))):
            raise ModelError("the default head's cage must give every node back when it is mirrored twice")


def grid_name(row: int, column: int) -> str:
    """Name of a grid node, such as "r03c07"."""
    return f"r{row:02d}c{column:02d}"


def ring_name(ring: str, index: int) -> str:
    """Name of a ring node, such as "eyeE2_04"; `ring` carries the family prefix ("eyeE2")."""
    return f"{ring}_{index:02d}"


def cap_name(i: int, j: int) -> str:
    """Name of a crown node: `i` lateral (0 on the midline), `j` front to back; its rim belongs to grid row 0."""
    if j == 0:
        return grid_name(0, i)
    if j == CAP_ROWS - 1:
        return grid_name(0, COLUMNS - 1 - i)
    return grid_name(0, 3 + j) if i == 3 else f"cap{i}_{j}"


def grid_nodes(row: int) -> tuple[int, ...]:
    """Columns of a row that carry a node: those not strictly inside a hole (the midline bounds the mouth hole)."""
    return tuple(
        column
        for column in range(COLUMNS)
        if not any(r0 < row < r1 and (c0 < column or c0 == 0) and column < c1 for r0, r1, c0, c1 in HOLES)
    )


def on_midline(name: str) -> bool:
    """Whether a node of the left half lies in the plane of symmetry (by its name)."""
    if name.startswith("mou"):
        return name.endswith(("_00", "_10")) if "BC" not in name else name.endswith("_00")
    return name.endswith(("c00", "c14")) if name.startswith("r") else name.startswith("cap0_")


@lru_cache(maxsize=1)
def build_cage() -> Cage:
    """The whole cage: 1097 nodes, 1068 quads; open at the neck and behind the two pairs of eyelids."""
    faces = _grid_faces() + _cap_faces() + _eye_faces() + _mouth_faces() + _nostril_faces() + _ear_faces()
    left = list(dict.fromkeys(name for face, _ in faces for name in face))
    off_midline = [name for name in left if not on_midline(name)]
    names = left + [name + RIGHT_SUFFIX for name in off_midline]
    index = {name: i for i, name in enumerate(names)}
    mirror = np.arange(len(names))
    for name in off_midline:
        mirror[index[name]], mirror[index[name + RIGHT_SUFFIX]] = index[name + RIGHT_SUFFIX], index[name]
    quads = np.array([[index[name] for name in face] for face, _ in faces], dtype=np.int64)
    regions = tuple(region for _, region in faces)
    return Cage(tuple(names), np.concatenate([quads, mirror[quads[:, ::-1]]]), regions * 2, mirror.astype(np.int64))


_Face = tuple[tuple[str, str, str, str], Region]


def _grid_faces() -> list[_Face]:
    """Every grid cell that is not in a hole."""
    return [
        ((grid_name(r, c), grid_name(r + 1, c), grid_name(r + 1, c + 1), grid_name(r, c + 1)), Region.FACE)
        for r in range(ROWS - 1)
        for c in range(COLUMNS - 1)
        if not any(r0 <= r < r1 and c0 <= c < c1 for r0, r1, c0, c1 in HOLES)
    ]


def _cap_faces() -> list[_Face]:
    """The crown."""
    return [
        ((cap_name(i, j), cap_name(i + 1, j), cap_name(i + 1, j + 1), cap_name(i, j + 1)), Region.FACE)
        for i in range(3)
        for j in range(CAP_ROWS - 1)
    ]


def _ring_faces(
    outer: tuple[str, ...], inner: tuple[str, ...], region: Region, *, closed: bool = True, reverse: bool = True
) -> list[_Face]:
    """Quads between two rings; `reverse` where the ring runs clockwise seen from outside."""
    faces: list[_Face] = []
    for k in range(len(outer) if closed else len(outer) - 1):
        n = (k + 1) % len(outer)
        face = (outer[k], outer[n], inner[n], inner[k])
        faces.append(((face[3], face[2], face[1], face[0]) if reverse else face, region))
    return faces


def _rings(rim: tuple[tuple[int, int], ...], prefix: str, rings: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Node names of the rim and of every ring inside it."""
    names = [tuple(grid_name(r, c) for r, c in rim)]
    names += [tuple(ring_name(prefix + ring, k) for k in range(len(rim))) for ring in rings]
    return names


def _eye_faces() -> list[_Face]:
    """Orbit to lid margin, then back behind the lid."""
    rings = _rings(EYE_RIM, "eye", EYE_RINGS)
    regions = (Region.EYELID, Region.EYELID, Region.EYELID, Region.LID_RIM, Region.UNDER_LID)
    pairs = zip(rings, rings[1:], regions, strict=False)
    return [face for outer, inner, region in pairs for face in _ring_faces(outer, inner, region)]


def _mouth_faces() -> list[_Face]:
    """Lips, then the bag with its end wall."""
    rings = _rings(MOUTH_RIM, "mou", MOUTH_RINGS)
    regions = (Region.MOUTH_ROLL,) * 2 + (Region.LIPS,) * 3 + (Region.MOUTH_BAG,) * 2
    faces: list[_Face] = []
    for outer, inner, region in zip(rings, rings[1:], regions, strict=False):
        faces += _ring_faces(outer, inner, region, closed=False)
    end = rings[-1]
    centre = (*(ring_name("mouBC", k) for k in range(4)), end[5])
    for k in range(4):
        faces.append(((end[k], centre[k], centre[k + 1], end[k + 1]), Region.MOUTH_BAG))
        faces.append(((end[10 - k], end[9 - k], centre[k + 1], centre[k]), Region.MOUTH_BAG))
    return faces


def _nostril_faces() -> list[_Face]:
    """A dent with a floor of two quads."""
    rings = _rings(NOSTRIL_RIM, "nos", NOSTRIL_RINGS)
    faces = _ring_faces(rings[0], rings[1], Region.NOSTRIL, reverse=False)
    faces += _ring_faces(rings[1], rings[2], Region.NOSTRIL_DEPTH, reverse=False)
    p = rings[-1]
    return [*faces, ((p[0], p[1], p[4], p[5]), Region.NOSTRIL_DEPTH), ((p[1], p[2], p[3], p[4]), Region.NOSTRIL_DEPTH)]


def _ear_faces() -> list[_Face]:
    """Rings from the skull outward, then the floor of the concha: two columns of five quads."""
    rings = _rings(EAR_RIM, "ear", EAR_RINGS)
    faces = [f for a, b in pairwise(rings) for f in _ring_faces(a, b, Region.EAR)]
    p = rings[-1]
    middle = (p[1], *(ring_name("earCTR", k) for k in range(4)), p[8])
    back, front = (p[0], *p[:8:-1]), p[2:8]
    for j in range(5):
        faces.append(((back[j], back[j + 1], middle[j + 1], middle[j]), Region.EAR))
        faces.append(((middle[j], middle[j + 1], front[j + 1], front[j]), Region.EAR))
    return faces
