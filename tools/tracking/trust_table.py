"""The trust in each FAP, measured: presets/capture/camera_faps.csv."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from risorius.track import CameraFap, camera_faps
from risorius.track.trust import TABLE

from .figures import FilmFigures

UNSEEN = "unseen"


def mean_correlation(films: Sequence[FilmFigures], number: int) -> float:
    """Mean correlation of a FAP over the films that move it; NaN where none does."""
    found = [film.correlation[number - 1] for film in films if np.isfinite(film.correlation[number - 1])]
    return float(np.mean(found)) if found else float("nan")


def write_trust(films: Sequence[FilmFigures]) -> list[CameraFap]:
    """Write the trust that the films found; heading and reasons stay as they are."""
    heading = [line for line in TABLE.read_text(encoding="utf-8").splitlines() if line.startswith(("#", "fap,"))]
    rows = [CameraFap(number, _trust(row, films), row.reason) for number, row in camera_faps().items()]
    reasons = [f'"{row.reason}"' if "," in row.reason else row.reason for row in rows]
    lines = [f"{row.number},{row.trust:.2f},{reason}" for row, reason in zip(rows, reasons, strict=True)]
    TABLE.write_text("\n".join([*heading, *lines]) + "\n", encoding="utf-8")
    camera_faps.cache_clear()
    return rows


def _trust(row: CameraFap, films: Sequence[FilmFigures]) -> float:
    """0 where nothing of the FAP reaches the picture, whatever happened to move with it."""
    measured = mean_correlation(films, row.number)
    return 0.0 if row.reason.startswith(UNSEEN) or np.isnan(measured) else float(np.clip(measured, 0.0, 1.0))
