"""The template laid onto what is seen from the front: turned, moved and scaled until it fits (ICP)."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ....arrays import Floats, Ints
from ..surface.cloud import Cloud, first_hits, nearest
from ..template.template import FitTemplate
from .head_pose import HeadPose

#: Template points used.
PROBES = 600
#: Rounds with one scale, then with a scale for each axis; the axes' scales stay within this ratio of each other.
ROUNDS_ALIKE, ROUNDS_AXES, AXIS_RATIO = 8, 14, 1.3
#: How firmly the axes keep one scale: square metres per squared logarithm of a scale over their mean.
AXIS_PRIOR = 0.01
#: A step's turns and stretches count as ways of a point so far from the middle, metres; damping relative to the mean.
ARM, DAMPING = 0.1, 1e-3
#: Largest step: logarithm of a scale, angle in radians.
MOST_STRETCH, MOST_TURN = 0.1, 0.3
#: Farthest match, metres, from the first round to the last; distance at which a match counts half.
GATES, HALF = (25e-3, 9e-3), 4e-3
#: Matches whose normals differ more (cosine) are no matches.
FACING = 0.4
#: Visibility from the front, metres.
PIXEL, TOLERANCE = 4e-3, 3.5e-3
#: What may be visible of a head, and before it: least and greatest x, y, z round the template's origin, metres.
BEFORE_HEAD = ((-0.11, -0.25, -0.16), (0.11, 0.06, 0.13))
#: The picture of what is visible is taken anew in these rounds.
LOOKS = (0, 8)


def align(cloud: Cloud, pose: HeadPose, template: FitTemplate) -> HeadPose:
    """The pose near a first guess in which the template fits the cloud best.

    Parameters
    ----------
    cloud : points spread over the mesh round the head, in mesh coordinates, normals outward.
    pose : the first guess.
    template : what is laid onto it.

    Returns
    -------
    HeadPose
        with a scale for each axis.
    """
    chosen = np.flatnonzero(template.front)
    chosen = chosen[:: max(1, len(chosen) // PROBES)]
    model, normals = template.surface.vertices[chosen], template.surface.normals[chosen]
    alike = pose.with_one_scale()
    near = HeadPose(np.eye(3), np.zeros(3), pose.scale / alike.size)
    positions, directions = alike.to_template(cloud.positions), alike.normals_to_template(cloud.normals)
    tree = cKDTree(positions)
    rounds = ROUNDS_ALIKE + ROUNDS_AXES
    for number in range(rounds):
        if number in LOOKS:
            seen = _seen_from_front(positions, near)
            shown, facing = positions[seen], directions[seen]
            tree = cKDTree(shown)
        gate = GATES[0] * (GATES[1] / GATES[0]) ** (number / (rounds - 1))
        here = near.to_mesh(model)
        distance, match = nearest(tree, here, within=gate)
        found = np.isfinite(distance)
        found[found] = ((normals[found] @ near.axes) * facing[match[found]]).sum(axis=1) > FACING
        if found.sum() < 60:
            break
        near = _improved(
            near,
            model[found],
            shown[match[found]] - here[found],
            facing[match[found]],
            by_axis=number >= ROUNDS_ALIKE,
        )
    return near.within(alike)


def _seen_from_front(positions: Floats, pose: HeadPose) -> Ints:
    """Indices of the points that the face's viewer sees."""
    local = pose.to_template(positions)
    inside: Ints = np.flatnonzero(((local > BEFORE_HEAD[0]) & (local < BEFORE_HEAD[1])).all(axis=1))
    if len(inside) == 0:
        return inside
    view = local[inside]
    seen: Ints = inside[first_hits(view[:, 1], view[:, 0], view[:, 2], pixel=PIXEL, tolerance=TOLERANCE)]
    return seen


def _improved(pose: HeadPose, model: Floats, away: Floats, facing: Floats, *, by_axis: bool) -> HeadPose:
    """One Gauss-Newton step on the distances from matched planes.

    Parameters
    ----------
    model : (N, 3) template points.
    away : (N, 3) from each one's present place to its match.
    facing : (N, 3) the normals of the matches.
    """
    scaled = model * pose.scale
    turned = scaled @ pose.axes
    rest = (away * facing).sum(axis=1)
    weight = 1.0 / (1.0 + (rest / HALF) ** 2)
    stretch = (facing @ pose.axes.T) * scaled
    rows = np.column_stack(
        [np.cross(turned, facing), facing, stretch if by_axis else stretch.sum(axis=1, keepdims=True)]
    )
    unit = np.array([1.0 / ARM] * 3 + [1.0] * 3 + [1.0 / ARM] * (rows.shape[1] - 6))  # metres each
    rows = rows * unit
    normal = rows.T @ (rows * weight[:, None])
    normal += np.eye(len(normal)) * DAMPING * np.trace(normal) / len(normal)
    wanted = rows.T @ (weight * rest)
    if by_axis:
        own = np.log(pose.scale / np.cbrt(np.prod(pose.scale)))
        normal[6:, 6:] += AXIS_PRIOR * np.diag(unit[6:] ** 2)
        wanted[6:] -= AXIS_PRIOR * unit[6:] * own
    step = unit * np.linalg.solve(normal, wanted)
    scale = pose.scale * np.exp(np.clip(step[6:], -MOST_STRETCH, MOST_STRETCH))
    middle = np.cbrt(np.prod(scale))
    scale = np.clip(scale, middle / np.sqrt(AXIS_RATIO), middle * np.sqrt(AXIS_RATIO))
    return HeadPose(pose.axes @ _rotation(step[:3]).T, pose.origin + step[3:6], scale)


def _rotation(turn: Floats) -> Floats:
    """(3, 3) rotation by a vector, radians (Rodrigues)."""
    angle = min(float(np.linalg.norm(turn)), MOST_TURN)
    if angle < 1e-12:
        return np.eye(3)
    x, y, z = turn / np.linalg.norm(turn)
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * (k @ k))
