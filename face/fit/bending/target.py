"""What the template is bent onto: the outside of a head as points, with its open edges known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ....arrays import Bools, Floats, Ints
from ....progress import Progress, Work, part_of
from ..locating.boxes import HEAD_BOX, box_cloud, in_box
from ..locating.head_pose import HeadPose
from ..surface.cloud import Cloud, Surface, first_hits
from ..surface.pieces import skin_pieces_steps

#: Points spread over the head.
COUNT = 60_000
#: Template coordinates as a pose.
AT_HOME = HeadPose(np.eye(3), np.zeros(3), np.ones(3))
#: Visibility from each side, metres.
PIXEL, TOLERANCE = 3e-3, 3e-3
#: Length that a whole turn of the normal counts as when points are matched, metres.
TURN = 10e-3
#: Points nearer than this to an open edge are not matched: inside openings, and at the mesh's outer rim; metres.
EDGE, RIM = 5e-3, 12e-3
#: Where mouth, eyes and nostrils are: least and greatest x, y, z round the template's origin, metres.
OPENINGS = ((-52e-3, -np.inf, -55e-3), (52e-3, -40e-3, 55e-3))
#: Skin that turns away from the front by more than this (y of its normal) is not seen from there.
TURNED_AWAY = 0.3


@dataclass(frozen=True, eq=False)
class Target:
    """The outside of a head, in template coordinates.

    Attributes
    ----------
    surface : the head's skin, in template coordinates.
    outside : points seen from the front, the sides, above or behind.
    front : which of them are seen from the front.
    edge : (N,) which of them lie too near to an open edge to be matched.
    rim : (R, 3) points on the open edges that bound the mesh rather than its mouth or eyes.
    """

    surface: Surface
    outside: Cloud
    front: Bools
    edge: Bools
    rim: Floats


def head_target(surface: Surface, pose: HeadPose) -> Work[Target]:
    """The outside of the head that lies at a pose in a mesh."""
    local = Surface(pose.to_template(surface.vertices), surface.triangles, pose.normals_to_template(surface.normals))
    boxed = local.part(in_box(surface, pose, HEAD_BOX))
    yield Progress(0.2, "Fitting the face")
    skin = yield from part_of(skin_pieces_steps(boxed), 0.2, 0.7)
    cloud = box_cloud(skin, AT_HOME, HEAD_BOX, COUNT)
    x, y, z = cloud.positions.T
    normal = cloud.normals
    front = first_hits(y, x, z, pixel=PIXEL, tolerance=TOLERANCE) & (normal[:, 1] < TURNED_AWAY)
    seen = front.copy()
    for depth, across, up, facing in (
        (-x, y, z, normal[:, 0]), (x, y, z, -normal[:, 0]), (-z, x, y, normal[:, 2]), (-y, x, z, normal[:, 1]),
    ):  # fmt: skip
        seen |= first_hits(depth, across, up, pixel=PIXEL, tolerance=TOLERANCE) & (facing > 0.0)
    outside, front = cloud.take(seen), front[seen]
    yield Progress(0.8, "Fitting the face")
    openings, rim = _open_edges(skin)
    return Target(skin, outside, front, _near(outside, openings, EDGE) | _near(outside, rim, RIM), rim)


def feature(positions: Floats, normals: Floats) -> Floats:
    """(..., 6) what points are matched by: place and direction."""
    return np.concatenate([positions, TURN * normals], axis=-1)


def _near(cloud: Cloud, places: Floats, reach: float) -> Bools:
    """Which points lie within reach of some places."""
    if len(places) == 0:
        return np.zeros(len(cloud), dtype=bool)
    distance, _ = cKDTree(places).query(cloud.positions, distance_upper_bound=reach)
    return np.isfinite(distance)


def _open_edges(surface: Surface) -> tuple[Floats, Floats]:
    """Points on the edges that bound one triangle only: round mouth, eyes and nostrils, and elsewhere."""
    ends = open_edges(surface.triangles)
    a, b = surface.vertices[ends[:, 0]], surface.vertices[ends[:, 1]]
    places = np.concatenate([a + share * (b - a) for share in (0.0, 0.25, 0.5, 0.75)])
    low, high = np.array(HEAD_BOX)
    places_inside = ((places >= low) & (places <= high)).all(axis=1)
    inner = ((places > OPENINGS[0]) & (places < OPENINGS[1])).all(axis=1)
    return places[places_inside & inner], places[places_inside & ~inner]


def open_edges(triangles: Ints) -> Ints:
    """(E, 2) sides that belong to one triangle only, in that triangle's direction."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    ordered = np.sort(sides, axis=1)
    keys = ordered[:, 0] * (int(triangles.max()) + 1) + ordered[:, 1]
    _, first, count = np.unique(keys, return_index=True, return_counts=True)
    found: Ints = sides[first[count == 1]]
    return found
