"""The report on how well feature points are found: jitter stays on the skin, the page says what was measured."""

from __future__ import annotations

from typing import Any

import numpy as np
import risorius.api as api
from fit.effect import Walk
from fit.page import page as page_of


def head_row(name: str, error: float) -> dict[str, Any]:
    """A head whose points are all equally far off."""
    points = ("9.3", "2.2", "8.1", "3.7", "4.1", "2.1", "10.1", "11.4")
    return {
        "name": name,
        "score": 0.5,
        "errors": dict.fromkeys(points, error),
        "confidence": dict.fromkeys(points, 0.9),
        "units": {"es0": 0.07},
        "vertices": 25959,
        "seconds": error,
    }


def figures() -> dict[str, list[dict[str, Any]]]:
    """What a run of the report leaves, made up."""
    return {
        "known": [head_row("ict", 1.0), head_row("makehuman", 2.0)],
        "second": [head_row("ict 1", 3.0)],
        "reserved": [head_row("ict 2", 4.0), {"name": "default head, bent (9)", "refused": "no face"}],
        "hard": [head_row("ict, hair", 5.0), {"name": "ict, sack", "refused": "no face"}],
        "poses": [{"name": "ict", "right": True}, {"name": "makehuman", "right": False}],
        "shapes": [{"name": "cube", "score": 4.0, "relief": 0.1, "seconds": 1.0}],
        "clicks": [{"name": "ict 2", "before": {"9.3": 9.0}, "errors": {"9.3": 1.5}}],
        "effect": [
            {"name": "exact", "points": [0.0], "ev": [0.9, 0.8], "fap": [0.0]},
            {"name": "4.0 mm", "points": [3.0], "ev": [0.7, 0.5], "fap": [0.1, 0.3]},
            {"name": "4.0 mm", "points": [5.0], "refused": "no face"},
        ],
    }


def cells(page: str, first: str) -> list[str]:
    """The cells of the table's row that begins so."""
    line = next(line for line in page.splitlines() if line.startswith(f"| {first} |"))
    return [cell.strip(" *") for cell in line.strip("|").split("|")]


def test_the_page_says_what_was_measured() -> None:
    page = page_of(figures())
    tuned, mh, second, reserved, none, bent, everything, target = cells(page, "nose")[1:]
    assert (tuned[:3], mh[:3], second[:3], reserved[:3]) == ("1.0", "2.0", "3.0", "4.0")
    assert (none, bent, everything, target) == ("–", "–", "4.0 / 4.0 / 4.0", "1.5")
    assert "Refused, and not in the table: default head, bent (9)." in page
    assert "right in 1. Wrong: makehuman." in page
    assert cells(page, "ict, hair") == ["ict, hair", "0.50", "5.0 / 5.0 / 5.0", "3.7"]
    assert cells(page, "ict, sack")[1] == "refused"
    assert cells(page, "jittered by 4.0 mm, 1 times")[1:] == ["3.0", "20 / 29", "0.60", "0.50"]
    assert cells(page, "25,959")[1:] == ["5", "3.0"]
    assert cells(page, "cube")[1] == "4.00"
    assert cells(page, "ict 2")[1:3] == ["9.0 / 9.0 / 9.0", "1.5 / 1.5 / 1.5"]


def test_jittered_points_stay_on_their_own_lip() -> None:
    face = api.default_face()
    walk = Walk(face)
    random = np.random.default_rng(3)
    upper, lower = (face.points[name].position for name in ("2.2", "2.3"))
    steps = []
    for _ in range(60):
        from_upper, from_lower = walk.from_(upper, 3e-3, random), walk.from_(lower, 3e-3, random)
        steps.append(np.linalg.norm(from_upper - upper))
        assert from_upper[2] > lower[2] - 1e-3
        assert from_lower[2] < upper[2] + 1e-3
    assert 1.5e-3 < np.sqrt(np.mean(np.square(steps))) < 4e-3
