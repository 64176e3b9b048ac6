"""Turns of bones that are kept as quaternions, or as an axis and an angle: from three numbers to four that are keyed.

A turn is a rotation vector, in radians about the three axes of the bone, after the turn that it has at rest. Small
turns add up as vectors do, which neither the parts of a quaternion nor an axis and an angle do.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...arrays import Floats
from .channels import Channel, Form, Place

#: Names of the four numbers that are keyed, and what each is where nothing is turned.
PARTS = {Form.QUATERNION: "WXYZ", Form.AXIS_ANGLE: "WXYZ"}
NEUTRAL = {Form.QUATERNION: (1.0, 0.0, 0.0, 0.0), Form.AXIS_ANGLE: (0.0, 0.0, 1.0, 0.0)}
#: Turns by less than this have no axis, radians.
NO_TURN = 1e-9


def keyed_values(values: Mapping[Channel, Floats]) -> dict[Channel, Floats]:
    """Channel -> (N,) from rest, of the numbers that Blender keeps, from those in which turns are vectors."""
    keyed = {channel: moved for channel, moved in values.items() if channel.form is Form.PLAIN}
    for group in _turning(values):
        keyed |= _whole(group, values)
    return keyed


def _turning(values: Mapping[Channel, Floats]) -> list[list[Channel]]:
    """The channels that are parts of one turn, turn by turn."""
    groups: dict[Place, list[Channel]] = {}
    for channel in values:
        if channel.form is not Form.PLAIN:
            whole = Place(channel.place.owner, channel.place.path)
            groups.setdefault(whole, []).append(channel)
    return list(groups.values())


def _whole(group: list[Channel], values: Mapping[Channel, Floats]) -> dict[Channel, Floats]:
    """The four numbers of one turn."""
    first = group[0]
    vectors = np.zeros((len(values[first]), 3))
    for channel in group:
        vectors[:, channel.place.index] = values[channel]
    quaternions = multiplied(np.array(first.turn), quaternions_of(vectors))
    resting = np.array(first.turn)
    numbers = quaternions
    if first.form is Form.AXIS_ANGLE:
        numbers, resting = axis_angles(quaternions), axis_angles(resting[None])[0]
    bone = first.name.rpartition(" ")[0]
    return {
        Channel(
            f"{bone} {PARTS[first.form][part]}",
            Place(first.place.owner, first.place.path, part),
            -np.inf,
            np.inf,
            float(resting[part]),
            neutral=NEUTRAL[first.form][part],
        ): numbers[:, part] - resting[part]
        for part in range(4)
    }


def quaternions_of(vectors: Floats) -> Floats:
    """(N, 4) quaternions (w, x, y, z) of rotation vectors (N, 3), radians."""
    angle = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.hstack([np.cos(angle / 2.0), vectors * 0.5 * np.sinc(angle / (2.0 * np.pi))])


def multiplied(first: Floats, then: Floats) -> Floats:
    """(N, 4) the quaternion `first` (4,) times each of others (N, 4)."""
    w, v, scalars, vectors = first[0], first[1:], then[:, :1], then[:, 1:]
    return np.hstack([w * scalars - vectors @ v[:, None], w * vectors + scalars * v + np.cross(v, vectors)])


def axis_angles(quaternions: Floats) -> Floats:
    """(N, 4) angle and axis of quaternions (N, 4), from one to the next without a jump of the axis."""
    vectors = quaternions[:, 1:]
    length = np.linalg.norm(vectors, axis=1)
    angles = 2.0 * np.arctan2(length, quaternions[:, 0])
    turned = np.flatnonzero(length > NO_TURN)
    axes = np.tile(NEUTRAL[Form.AXIS_ANGLE][1:], (len(vectors), 1))
    if len(turned):
        axes[turned] = vectors[turned] / length[turned, None]
        steps = np.sign((axes[turned[1:]] * axes[turned[:-1]]).sum(axis=1))
        signs = np.cumprod(np.concatenate([[1.0], np.where(steps == 0.0, 1.0, steps)]))
        axes[turned] *= signs[:, None]
        angles[turned] *= signs
        nearest = turned[np.abs(np.arange(len(axes))[:, None] - turned).argmin(axis=1)]
        axes = axes[nearest]
    return np.hstack([angles[:, None], axes])
