"""Fixtures for every test: the folder of shared test data."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of shared test data (heads, samples): $RISORIUS_SHARED, or `../shared` beside the checkout."""
    folder = Path(os.environ.get("RISORIUS_SHARED") or ROOT.parent / "shared").resolve()
    if not folder.is_dir():
        pytest.skip(f"no shared test data at {folder}; set RISORIUS_SHARED to its folder")
    return folder
