"""What comes back from the films: per FAP, correlation and error of what was read against what was shown."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from risorius.arrays import Bools, Floats
from risorius.face.tracked.landmarks import LandmarkReading
from risorius.mpeg4 import FAP_COUNT, FAPS
from risorius.mpeg4.streams.capture import Landmarks
from risorius.track import Smoothing, find_landmarks, open_pictures, track_landmarks

from .known import BEFORE, TRUTH


@dataclass(frozen=True)
class FilmFigures:
    """One film, read.

    Attributes
    ----------
    name : head and side ("ict-20"). frames, lost : pictures, and those in which no face was found.
    correlation, slope, error, span, trembling : (68,) NaN where the film does not move a FAP: correlation of read with
        shown values, slope of read over shown ones, root mean square error, range of shown values, scatter before the
        first expression; all but the first two in FAP units.
    own_neutral : share of the frames taken for neutral without being told that show no expression.
    """

    name: str
    frames: int
    lost: int
    correlation: Floats
    slope: Floats
    error: Floats
    span: Floats
    trembling: Floats
    own_neutral: float


def read_film(folder: Path) -> FilmFigures:
    """Track a film that `films` made, told that it begins neutral, and compare what is read with what was shown."""
    told = np.load(folder / TRUTH)
    shown, fps = told["frames"], float(told["fps"])
    landmarks = find_landmarks(open_pictures([folder], fps=fps))
    reading = _unsmoothed(landmarks, (0.0, (BEFORE - 0.5) / fps))
    read, moved = reading.frames, _moved(shown)
    figures = {name: np.full(FAP_COUNT, np.nan) for name in ("correlation", "slope", "error", "span", "trembling")}
    for column in np.flatnonzero(moved & np.isfinite(read).any(axis=0)):
        both = np.isfinite(read[:, column])
        seen, true = read[both, column], shown[both, column]
        figures["correlation"][column] = np.corrcoef(seen, true)[0, 1]
        figures["slope"][column] = np.polyfit(true, seen, 1)[0]
        figures["error"][column] = np.sqrt(((seen - true) ** 2).mean())
        figures["span"][column] = np.ptp(true)
        figures["trembling"][column] = read[:BEFORE, column].std()
    lost = int(np.isnan(reading.pose.scales).sum())
    chosen = _unsmoothed(landmarks, None).chosen
    resting = (np.abs(shown[chosen][:, moved]) < 0.1 * np.abs(shown[:, moved]).max(axis=0)).all(axis=1)
    return FilmFigures(folder.name, len(read), lost, own_neutral=float(resting.mean()), **figures)


def _unsmoothed(landmarks: Landmarks, neutral: tuple[float, float] | None) -> LandmarkReading:
    """Every value that is read, however unsure."""
    return track_landmarks(landmarks, neutral=neutral, smoothing=Smoothing.NONE, least=0.0).reading


def _moved(shown: Floats) -> Bools:
    """(68,) FAPs that the film moves by more than numerical noise."""
    noise = np.array([100.0 if FAPS[number].angular else 5.0 for number in range(1, FAP_COUNT + 1)])
    return np.asarray(np.ptp(shown, axis=0) > noise)  # NaN, where the head has no such point, is not more
