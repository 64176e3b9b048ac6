"""OpenFace 2 and Py-Feat: CSV of action unit intensities; of OpenFace head pose and gaze, too.

OpenFace's axes are the camera's: x to the right of the image (the subject's left), y down, z away from the camera;
angles in rad, rotations Rx Ry Rz, right-handed in these axes. Source: OpenFace's page "Output Format" and the code that
makes its rotations (RotationHelpers.h).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from ....arrays import Floats
from ....errors import FormatError
from ....tables import read_toml
from ...standard import ANGLE_UNIT, FAP_COUNT
from .columns import load_columns
from .faces import one_face
from .py_feat_turns import Turns, py_feat_turns
from .rotation import euler_matrix, head_faps, in_head_axes, in_radians
from .row_names import tells_of_a_row
from .samples import Samples
from .scores import unread_words
from .shapes import CAPTURE_PRESETS
from .stamps import table_times
from .table_file import TableFile

#: Frames of which the tracker is less sure than this state nothing; OpenFace's own `success` asks for about as much.
SURE = 0.7

CAMERA_AXES: Floats = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]])
"""The subject's left, up and forward in the camera's axes."""

POSE = ("pose_Rx", "pose_Ry", "pose_Rz")
GAZE = ("gaze_angle_x", "gaze_angle_y")
CONFIDENCES = ("confidence", "FaceScore")
OPENFACE, PY_FEAT = CAPTURE_PRESETS / "openface.toml", CAPTURE_PRESETS / "py_feat.toml"
#: FAPs 23 to 26 by column: the right eye is gaze_0, which lies to the left of the image.
EYES = ((24, 26, "gaze_0"), (23, 25, "gaze_1"))


def holds_openface(table: TableFile) -> bool:
    """Whether a CSV has columns of OpenFace."""
    return "pose_Rx" in table or any(name in table for name in load_columns().gains)


def holds_py_feat(table: TableFile) -> bool:
    """Whether a CSV has columns of Py-Feat."""
    return any(name in table for name in load_columns(PY_FEAT).gains)


def read_openface(
    table: TableFile,
    *,
    rate: float | None = None,
    start: float | str | None = None,
    face: int | None = None,
    sure: float = SURE,
    preset: Path = OPENFACE,
) -> Samples:
    """The samples of a CSV of OpenFace, or of Py-Feat.

    Parameters
    ----------
    rate, start : see `times.placed` and `times.Times.since_first`. face : see `faces.one_face`.
    sure : frames below this confidence, and those without success, are unknown.
    preset : the table of columns.

    Raises
    ------
    FormatError : no action units and no pose; an intensity that is none; several faces; times that do not rise.
    """
    table, columns = one_face(table, face), load_columns(preset)
    scores = table.several(name for name in table.columns if name.lower() in columns.gains)
    if not scores and not all(name in table for name in POSE):
        raise FormatError(table.path, "has neither AUxx_r columns nor pose_Rx: run FeatureExtraction with -aus", line=1)
    _check_range(table, scores, read_toml(preset).number("most", above=0.0))
    frames = columns.frames(scores) if scores else np.full((len(table.rows), FAP_COUNT), np.nan)
    turns = py_feat_turns(table) if preset == PY_FEAT else _turns(table)
    pose = in_head_axes(turns.rotations, CAMERA_AXES)
    frames[:, 47:50] = head_faps(pose)
    frames[:, 22:26] = _gaze(table, pose)
    for name in CONFIDENCES:
        if name in table:
            frames[~(table.numbers(name) >= sure)] = np.nan
    if "success" in table:
        frames[~(table.numbers("success") > 0.0)] = np.nan
    times = table_times(table, rate)
    unread = [name for name in _unread(table, scores, preset) if name not in turns.columns]
    said = (*times.assumed, *turns.said, *unread_words(unread))
    return Samples.at_times(replace(times, assumed=said), frames[times.rows], start=start)


def _check_range(table: TableFile, scores: Mapping[str, Floats], most: float) -> None:
    """Refuse intensities that no tracker writes."""
    for name, values in scores.items():
        with np.errstate(invalid="ignore"):
            beyond = np.flatnonzero((values > most) | (values < -most))
        if len(beyond):
            problem = f"must be an intensity of at most {most:g}, but it is {values[beyond[0]]:g}: correct or remove it"
            raise table.refusal(int(beyond[0]), name, problem)


def _unread(table: TableFile, scores: Mapping[str, Floats], preset: Path) -> list[str]:
    """Columns that the format does not have, or that state something which is not read."""
    silent = [re.compile(pattern, re.IGNORECASE) for pattern in read_toml(preset).texts("silent")]
    others = (name for name in table.columns if name not in scores and not tells_of_a_row(name))
    return [name for name in others if not any(pattern.fullmatch(name) for pattern in silent)]


def _turns(table: TableFile) -> Turns:
    """The head's turn as OpenFace writes it; unknown without all three angles."""
    angles, said = in_radians(table.several(POSE), table.refusal)
    if not all(name in angles for name in POSE):
        return Turns(np.full((len(table.rows), 3, 3), np.nan), said=said)
    return Turns(euler_matrix(*(angles[name] for name in POSE)), POSE, said)


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
