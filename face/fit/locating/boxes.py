"""What of a mesh lies in a box round a head."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from ....arrays import Bools, Floats
from ..surface.cloud import Cloud, Surface, sample, sample_shelves
from ..surface.shelves import MANY
from .head_pose import HeadPose

#: Least and greatest x, y, z round the template's origin, metres.
Box: TypeAlias = tuple[tuple[float, float, float], tuple[float, float, float]]
HEAD_BOX: Box = ((-0.12, -0.185, -0.175), (0.12, 0.135, 0.175))
FACE_BOX: Box = ((-0.068, -0.185, -0.09), (0.068, 0.0, 0.076))
#: So many points drawn near a box of a dense mesh tell what share of them lies inside; where that is less than the
#: least one, the triangles that touch the box are looked for one by one.
FIRST, LEAST = 2_000, 0.2


def in_box(surface: Surface, pose: HeadPose, box: Box) -> Bools:
    """(T,) which triangles touch a box round the head; of many, none is so large that it has no corner inside."""
    if len(surface.triangles) > MANY:
        a, b, c = surface.triangles.T
        inside = lies_in_box(surface.vertices, pose, box)
        return np.asarray(inside[a] | inside[b] | inside[c], dtype=np.bool_)
    return _touch(surface.vertices[surface.triangles], pose, box)


def box_cloud(surface: Surface, pose: HeadPose, box: Box, count: int) -> Cloud:
    """Points spread over what lies in a box round the head."""
    if len(surface.triangles) > MANY:
        near = _shelves_near(surface, pose, box)
        share = len(_drawn_inside(surface, near, pose, box, FIRST)) / FIRST
        if share > LEAST:
            return _drawn_inside(surface, near, pose, box, int(count / share))
    chosen = in_box(surface, pose, box)
    cloud = sample(surface.part(chosen), count)
    whole = Cloud(cloud.positions, cloud.normals, np.flatnonzero(chosen)[cloud.triangles])
    return whole.take(lies_in_box(cloud.positions, pose, box))


def lies_in_box(positions: Floats, pose: HeadPose, box: Box) -> Bools:
    """Which positions (N, 3) of the mesh lie in a box round the head."""
    local = pose.with_one_scale().to_template(positions)
    x, y, z = ((local >= np.array(box[0])) & (local <= np.array(box[1]))).T
    return np.asarray(x & y & z, dtype=np.bool_)


def _shelves_near(surface: Surface, pose: HeadPose, box: Box) -> Bools:
    """(S,) which shelves of a dense surface may hold what lies in a box."""
    cells = surface.cells
    reach = cells.reach / pose.size
    (x, y, z), (left, back, up) = box
    larger = ((x - reach, y - reach, z - reach), (left + reach, back + reach, up + reach))
    wide = _touch(surface.vertices[surface.triangles[cells.wide]], pose, box)
    return np.concatenate([lies_in_box(cells.middles, pose, larger), wide])


def _drawn_inside(surface: Surface, near: Bools, pose: HeadPose, box: Box, count: int) -> Cloud:
    """Those of so many points drawn from shelves (S,) that lie in a box."""
    cloud = sample_shelves(surface, surface.cells.shelves, near, count)
    return cloud.take(lies_in_box(cloud.positions, pose, box))


def _touch(corners: Floats, pose: HeadPose, box: Box) -> Bools:
    """(T,) which triangles (T, 3, 3) touch a box."""
    local = pose.with_one_scale().to_template(corners)
    touches: Bools = ((local.max(axis=1) >= box[0]) & (local.min(axis=1) <= box[1])).all(axis=1)
    return touches
