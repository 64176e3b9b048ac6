"""Brows and lids of a real scan with landmarks: its eyes have no rims, its brows are hair and paint."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api

#: Feature points by the landmarks (iBUG) whose mean they are; those of the lids' middles lie beside them.
LANDMARKS = {
    "3.7": (45,), "3.11": (42,), "3.8": (39,), "3.12": (36,), "3.1": (43, 44), "3.3": (46, 47), "3.2": (37, 38),
    "3.4": (40, 41), "4.1": (22,), "4.2": (21,), "4.3": (24,), "4.4": (19,), "8.3": (54,), "8.4": (48,), "4.5": (26,),
    "4.6": (17,), "8.1": (51,), "8.2": (57,), "2.1": (8,), "9.3": (30,), "9.15": (33,),
}  # fmt: skip
#: In which order the file has its groups, against iBUG's.
GROUPS = ("chin", "leyebrow", "reyebrow", "nose", "leye", "reye", "mouth")


@pytest.fixture(scope="module")
def scan(shared: Path) -> tuple[api.FoundPoints, dict[str, np.ndarray]]:
    """What is found on the scan, and its landmarks; millimetres."""
    folder = shared / "heads" / "others" / "menpo_james"
    if not folder.is_dir():
        pytest.skip("the heads of others are not there")
    mesh = api.read_mesh(folder / "james.obj")
    table = json.loads((folder / "james.ljson").read_text(encoding="utf-8"))["groups"]["LJSON"]
    masks = {label["label"]: label["mask"] for label in table["labels"]}
    places = np.array(table["landmarks"]["points"], dtype=float)
    places = places[np.concatenate([masks[group] for group in GROUPS])]
    truth = {name: places[list(marks)].mean(axis=0) for name, marks in LANDMARKS.items()}
    return api.find_points(mesh.vertices, mesh.polygons), truth


def heights(scan: tuple[api.FoundPoints, dict[str, np.ndarray]], names: tuple[str, ...]) -> np.ndarray:
    """How much too high some points were found, millimetres."""
    found, truth = scan
    left = truth["3.7"] - truth["3.12"]
    left /= np.linalg.norm(left)
    up = (truth["3.7"] + truth["3.12"] - truth["8.3"] - truth["8.4"]) / 2.0
    up -= left * (up @ left)
    up /= np.linalg.norm(up)
    return np.array([(found.positions[name] - truth[name]) @ up for name in names])


@pytest.mark.slow
def test_brows_of_a_scan_are_not_found_too_high(scan: tuple[api.FoundPoints, dict[str, np.ndarray]]) -> None:
    off = heights(scan, ("4.1", "4.2", "4.3", "4.4"))
    assert abs(off.mean()) < 4.0
    assert abs(off).max() < 6.5


@pytest.mark.slow
def test_lids_of_a_scan_do_not_gape(scan: tuple[api.FoundPoints, dict[str, np.ndarray]]) -> None:
    off = heights(scan, ("3.1", "3.2", "3.3", "3.4"))
    assert abs(off).max() < 2.0


@pytest.mark.slow
def test_the_confidence_tells_good_points_of_a_scan(scan: tuple[api.FoundPoints, dict[str, np.ndarray]]) -> None:
    found, truth = scan
    off = {name: float(np.linalg.norm(found.positions[name] - place)) for name, place in truth.items()}
    good = [found.confidence[name] for name in off if off[name] < 2.5]
    bad = [found.confidence[name] for name in off if off[name] > 5.0]
    assert len(good) > 5
    assert len(bad) > 2
    assert np.mean([[high > low for low in bad] for high in good]) > 0.75
    assert min(found.confidence[name] for name in ("3.7", "3.11", "3.12")) > 0.6
