"""For every test: the modules of tools/ by the names that they call each other, and the folder of shared test data."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools"))


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of shared test data (heads, samples): $RISORIUS_SHARED, or `../shared` beside the checkout."""
    from places import shared_folder

    folder = shared_folder()
    if not folder.is_dir():
        pytest.skip(f"no shared test data at {folder}; set RISORIUS_SHARED to its folder")
    return folder
