"""OpenFace 2: CSV of action unit intensities, head pose and gaze.

Its axes are the camera's: x to the right of the image (the subject's left), y down, z away from the camera; angles in
rad, rotations Rx Ry Rz, right-handed in these axes. Source: OpenFace's page "Output Format" and the code that makes
its rotations (RotationHelpers.h).
"""

from __future__ import annotations

import numpy as np

from ....arrays import Floats
from ....errors import FormatError
from ...standard import ANGLE_UNIT, FAP_COUNT
from .columns import load_columns
from .rotation import euler_matrix, head_faps, in_head_axes
from .samples import Samples
from .stamps import table_times
from .table_file import TableFile

#: Frames of which the tracker is less sure than this state nothing; OpenFace's own `success` asks for about as much.
SURE = 0.7

CAMERA_AXES: Floats = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]])
"""The subject's left, up and forward in the camera's axes."""

POSE = ("pose_Rx", "pose_Ry", "pose_Rz")
GAZE = ("gaze_angle_x", "gaze_angle_y")
#: FAPs 23 to 26 by column: the right eye is gaze_0, which lies to the left of the image.
EYES = ((24, 26, "gaze_0"), (23, 25, "gaze_1"))


def holds_openface(table: TableFile) -> bool:
    """Whether a CSV has columns of OpenFace."""
    return "pose_Rx" in table or any(name in table for name in load_columns().gains)


def read_openface(
    table: TableFile, *, rate: float | None = None, start: float | str | None = None, sure: float = SURE
) -> Samples:
    """The samples of an OpenFace CSV.

    Parameters
    ----------
    rate, start : see `times.placed` and `times.Times.since_first`.
    sure : frames below this confidence, and those without success, are unknown.

    Raises
    ------
    FormatError : no action units and no pose; several faces; times that do not rise.
    """
    columns = load_columns()
    scores = table.several(name for name in table.columns if name.lower() in columns.gains)
    if not scores and not all(name in table for name in POSE):
        raise FormatError(table.path, "has neither AUxx_r columns nor pose_Rx: run FeatureExtraction with -aus", line=1)
    if "face_id" in table and len(set(table.texts("face_id"))) > 1:
        raise FormatError(table.path, "contains several faces (face_id): keep the rows of one face")
    frames = np.full((len(table.rows), FAP_COUNT), np.nan)
    if scores:
        frames = columns.frames(scores)
    pose = in_head_axes(_rotations(table), CAMERA_AXES)
    frames[:, 47:50] = head_faps(pose)
    frames[:, 22:26] = _gaze(table, pose)
    if "confidence" in table:
        frames[~(table.numbers("confidence") >= sure)] = np.nan
    if "success" in table:
        frames[~(table.numbers("success") > 0.0)] = np.nan
    times = table_times(table, rate)
    return Samples.at_times(times, frames[times.rows], start=start)


def _rotations(table: TableFile) -> Floats:
    """(T, 3, 3) head rotations in the camera's axes; NaN without pose columns."""
    if not all(name in table for name in POSE):
        return np.full((len(table.rows), 3, 3), np.nan)
    return euler_matrix(*(table.numbers(name) for name in POSE))


def _gaze(table: TableFile, pose: Floats) -> Floats:
    """(T, 4) FAPs 23 to 26: where the eyes look in the head, which itself is turned by `pose` (T, 3, 3)."""
    faps = np.full((len(table.rows), 4), np.nan)
    for yaw, pitch, prefix in EYES:
        names = [f"{prefix}_{axis}" for axis in "xyz"]
        if all(name in table for name in names):
            look = np.stack([table.numbers(name) for name in names], axis=1)
        elif all(name in table for name in GAZE):
            aside, down = (np.tan(table.numbers(name)) for name in GAZE)
            look = np.stack([aside, down, -np.ones(len(aside))], axis=1)
        else:
            continue
        inside = np.einsum("tji,tj->ti", pose, look @ CAMERA_AXES.T)
        inside /= np.maximum(np.linalg.norm(inside, axis=1, keepdims=True), 1e-12)
        faps[:, yaw - 23] = np.arctan2(inside[:, 0], inside[:, 2]) / ANGLE_UNIT
        faps[:, pitch - 23] = -np.arcsin(np.clip(inside[:, 1], -1.0, 1.0)) / ANGLE_UNIT
    return faps
