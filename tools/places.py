"""Where things lie: the checkout, what its tools make, and the shared test data."""

from __future__ import annotations

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
"""The checkout."""

OUT = ROOT / "out"
"""Reports, pictures and intermediate figures; never under version control."""

DOCS, PRESETS = ROOT / "docs", ROOT / "presets"


def shared_folder() -> Path:
    """The folder of shared heads, samples and programs, there or not: $RISORIUS_SHARED, else `../shared`."""
    return Path(os.environ.get("RISORIUS_SHARED") or ROOT.parent / "shared").resolve()
