"""For every test: the modules of tools/ by the names that they call each other, and the folder of shared test data."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Generator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools"))

#: No test leaves prepared faces with the user.
os.environ["RISORIUS_CACHE"] = "off"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """A test fails in which Blender or a library printed that a later version takes away what is used."""
    from deprecated import deprecations

    report = yield
    if report.passed and (said := deprecations(report.capstdout + report.capstderr)):
        report.outcome, report.longrepr = "failed", "\n".join(["This is taken away by a later version:", *said])
    return report


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of shared test data (heads, samples): $RISORIUS_SHARED, or `../shared` beside the checkout."""
    from places import shared_folder

    folder = shared_folder()
    if not folder.is_dir():
        pytest.skip(f"no shared test data at {folder}; set RISORIUS_SHARED to its folder")
    return folder


#: Points of the nose, the ninth group's only ones on skin.
SKIN = ("9.1", "9.2", "9.3", "9.4", "9.5", "9.12", "9.13", "9.14", "9.15")


@dataclass(frozen=True)
class SewnHead:
    """The default head as a scan would have it: lips, or lids too, are one surface; nothing lies behind them."""

    vertices: np.ndarray
    polygons: list[tuple[int, ...]]
    points: dict[str, np.ndarray]


@pytest.fixture(scope="session")
def sewn_head() -> Callable[..., SewnHead]:
    """A builder of heads whose openings of the names given ("mouth", "l", "r") are welded shut."""
    from risorius import api

    def weld_shut(*names: str) -> SewnHead:
        head, face = api.build_default_head(), api.default_face()
        skin = face.anatomy.given_skin
        blink = np.full(68, np.nan)
        for side, faps in (("l", [19, 21]), ("r", [20, 22])):
            blink[np.array(faps) - 1] = 512.0 if side in names else np.nan
        vertices = face.pose(blink, drive="exact").positions if {"l", "r"} & set(names) else head.vertices.copy()
        polygons = [np.array(polygon) for polygon in head.polygons]
        outside = np.isin(np.arange(len(vertices)), skin.index)
        leads = np.arange(len(vertices))
        for name in names:
            opening = skin.mouth if name == "mouth" else skin.eyes[name]
            upper, lower = skin.index[opening.upper], skin.index[opening.lower[::-1]]
            nearest = np.abs(vertices[lower, None, 0] - vertices[upper, 0]).argmin(axis=1)
            leads[lower] = upper if len(upper) == len(lower) else upper[nearest]
            vertices[upper] = (vertices[upper] + vertices[lower]) / 2.0 if len(upper) == len(lower) else vertices[upper]
        kept = [leads[polygon] for polygon in polygons if outside[polygon].all()]
        kept = [polygon[polygon != np.roll(polygon, 1)] for polygon in kept]
        kept = [polygon for polygon in kept if len(np.unique(polygon)) >= 3]
        used, of = np.unique(np.concatenate(kept), return_inverse=True)
        rows = np.split(of, np.cumsum([len(polygon) for polygon in kept])[:-1])
        places = {name: vertices[leads[p]] if isinstance(p, int) else p for name, p in head.points.items()}
        points = {name: place for name, place in places.items() if name.split(".")[0] not in ("6", "9") or name in SKIN}
        for lid, side, lift in (("3.1", "l", 1e-3), ("3.3", "l", -1e-3), ("3.2", "r", 1e-3), ("3.4", "r", -1e-3)):
            points[lid] = points[lid] + np.array([0.0, 0.0, lift if side in names else 0.0])
        return SewnHead(vertices[used], [tuple(row.tolist()) for row in rows], points)

    return weld_shut
