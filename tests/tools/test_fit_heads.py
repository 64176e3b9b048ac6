"""The heads that the finding of feature points is measured on."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def fit_heads() -> Iterator[ModuleType]:
    """The module of the heads."""
    sys.path.insert(0, str(ROOT / "tools"))
    try:
        yield importlib.import_module("fit_heads")
    finally:
        sys.path.remove(str(ROOT / "tools"))


def test_the_reserved_heads_are_no_heads_of_the_other_sets(fit_heads: ModuleType, shared: Path) -> None:
    heads = fit_heads.SharedHeads(shared / "heads")
    reserved = list(heads.reserved())
    assert len(reserved) == 15
    for other in [*heads.known(), *heads.held_out()]:
        for head in reserved:
            if len(head.vertices) == len(other.vertices):
                apart = np.linalg.norm(head.vertices - other.vertices, axis=1)
                assert np.quantile(apart, 0.9) > 2e-3, (head.name, other.name)


def test_their_points_lie_on_their_skin(fit_heads: ModuleType, shared: Path) -> None:
    for head in fit_heads.SharedHeads(shared / "heads").reserved():
        for name in ("3.7", "8.3", "9.3"):
            nearest = np.linalg.norm(head.vertices - head.points[name], axis=1).min()
            assert nearest < 4e-3, (head.name, name)
