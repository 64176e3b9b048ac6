"""What faces come in: files of trackers become FAP streams."""

from __future__ import annotations

from enum import StrEnum
from functools import lru_cache
from pathlib import Path

import numpy as np

from ...errors import FormatError, ParameterError
from ...mpeg4 import FapStream
from ...mpeg4.streams.capture import (
    CAPTURE_PRESETS,
    JsonFrame,
    Landmarks,
    Samples,
    TableFile,
    arkit_columns,
    holds_faps,
    holds_landmarks,
    landmarks_from_csv,
    landmarks_from_json,
    load_columns,
    read_arkit,
    read_fap_csv,
    read_json_frames,
    read_openface,
    read_scores,
    read_table_file,
)
from ...tables import TomlTable, read_toml
from .landmarks import LandmarkReading, read_points

TOPOLOGIES = CAPTURE_PRESETS.parent / "topologies"


class CaptureFormat(StrEnum):
    """The kinds of files that are read."""

    OPENFACE = "openface"
    ARKIT = "arkit"
    MEDIAPIPE = "mediapipe"
    LANDMARKS = "landmarks"
    FAPS = "faps"


def read_capture(
    path: str | Path,
    *,
    kind: str | CaptureFormat | None = None,
    fps: float | None = None,
    rate: float | None = None,
    aspect: float = 16.0 / 9.0,
    neutral: tuple[float, float] | None = None,
) -> FapStream:
    """A tracker's file as a FAP stream at an even rate; what is not known in it is masked.

    Parameters
    ----------
    path : OpenFace CSV; ARKit, Live Link Face or MediaPipe blend shapes (CSV, JSON); MediaPipe landmarks (CSV, JSON); a
        CSV of FAPs as `write_fap_csv` writes it.
    kind : which of these; None: as the file's columns and entries tell.
    fps : frames per second of the stream; None: those of the recording.
    rate : frames per second of a recording that states no times, or whose timecode counts in others than 60.
    aspect : landmarks only: the picture's width over its height.
    neutral : landmarks only: seconds from and to which the face is neutral; None: its usual shape is.

    Raises
    ------
    FormatError : names the file, line and column or frame, and the remedy.
    ParameterError : an option outside its rule.
    """
    file = Path(path)
    if rate is not None and not (np.isfinite(rate) and rate > 0.0):
        raise ParameterError("rate", "must be a positive number of frames per second", rate)
    recorded = read_json_frames(file) if file.suffix.lower() in (".json", ".jsonl") else None
    table = read_table_file(file) if recorded is None else None
    chosen = _checked_kind(kind) if kind is not None else _kind_of(file, table, recorded)
    if chosen is CaptureFormat.LANDMARKS:
        landmarks = _landmarks(table, recorded, aspect, rate)
        samples = Samples(landmarks.times, read_landmarks(landmarks, neutral=neutral).frames)
    elif recorded is not None:
        samples = read_scores(recorded, rate=rate)
    else:
        assert table is not None
        samples = _samples(table, chosen, rate)
    even, per_second = samples.evenly(fps)
    return FapStream(frames=even, fps=per_second, name=_name(file))


def _landmarks(
    table: TableFile | None, recorded: list[JsonFrame] | None, aspect: float, rate: float | None
) -> Landmarks:
    """The landmarks of a file of either kind."""
    if recorded is not None:
        return landmarks_from_json(recorded, aspect=aspect, rate=rate)
    assert table is not None
    return landmarks_from_csv(table, aspect=aspect, rate=rate)


def _samples(table: TableFile, kind: CaptureFormat, rate: float | None) -> Samples:
    """The samples of a table of scores or FAPs."""
    if kind is CaptureFormat.OPENFACE:
        return read_openface(table)
    if kind is CaptureFormat.FAPS:
        return read_fap_csv(table)
    return read_arkit(table, rate=rate)


def _name(file: Path) -> str:
    """What the stream is called: the file's name, in one printable line."""
    return "".join(letter for letter in file.stem if letter.isprintable()) or "capture"


def _checked_kind(kind: str | CaptureFormat) -> CaptureFormat:
    """The kind of that name."""
    try:
        return CaptureFormat(kind)
    except ValueError:
        raise ParameterError("kind", f"must be one of {', '.join(CaptureFormat)}", str(kind)) from None


def _kind_of(file: Path, table: TableFile | None, recorded: list[JsonFrame] | None) -> CaptureFormat:
    """The kind that a file's columns or entries tell."""
    if recorded is not None:
        if any(frame.entry("blendshapes") is not None for frame in recorded):
            return CaptureFormat.MEDIAPIPE
        if any(frame.entry("landmarks") is not None for frame in recorded):
            return CaptureFormat.LANDMARKS
        raise FormatError(file, "has neither blend shapes nor landmarks in any frame")
    assert table is not None
    if holds_faps(table):
        return CaptureFormat.FAPS
    if holds_landmarks(table):
        return CaptureFormat.LANDMARKS
    if "pose_Rx" in table or any(name in table for name in load_columns().gains):
        return CaptureFormat.OPENFACE
    if any(name in table for name in arkit_columns().gains):
        return CaptureFormat.ARKIT
    known = "OpenFace (AU01_r), ARKit (jawOpen), landmarks (x_0) or FAPs (F03_open_jaw)"
    raise FormatError(file, f"has none of the columns of {known}", line=1)


def read_landmarks(landmarks: Landmarks, *, neutral: tuple[float, float] | None = None) -> LandmarkReading:
    """FAPs of MediaPipe's landmarks.

    Parameters
    ----------
    neutral : seconds from and to which the face is neutral; None: its usual shape is.

    Raises
    ------
    ParameterError, ModelError : see `landmarks.read_points`.
    """
    preset, points = _mediapipe()
    tracked = {name: index for name, index in points.items() if index < landmarks.positions.shape[1]}
    stretch = None
    if neutral is not None:
        inside = np.flatnonzero((landmarks.times >= neutral[0]) & (landmarks.times <= neutral[1]))
        if len(inside) == 0:
            raise ParameterError("neutral", f"must be in 0..{landmarks.times[-1]:.2f} seconds", neutral)
        stretch = (int(inside[0]), int(inside[-1]))
    return read_points(
        landmarks.positions[:, list(tracked.values())],
        list(tracked),
        stable=preset.texts("stable"),
        eye_radius=preset.number("eye_radius"),
        unseen=[int(number) for number in preset.numbers("unseen")],
        neutral=stretch,
    )


@lru_cache(maxsize=1)
def _mediapipe() -> tuple[TomlTable, dict[str, int]]:
    """The preset of MediaPipe's landmarks, and feature point -> landmark."""
    preset = read_toml(CAPTURE_PRESETS / "mediapipe_landmarks.toml")
    tables = read_toml(TOPOLOGIES / preset.text("topology")).table("points"), preset.table("pupils")
    return preset, {name: table.integer(name) for table in tables for name in table}
