"""Where the tables that come with Risorius lie, and which version it is."""

from __future__ import annotations

import tomllib
from functools import lru_cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
"""The package itself: a file that is missing below it is a damaged installation."""

PRESETS = PACKAGE / "presets"
"""Tables that a user may copy and edit: emotions, anatomy, tissue, heads, timing."""

STANDARD = PACKAGE / "mpeg4" / "data"
"""Tables of the standard and of the first paper, as printed: nobody's to edit."""


@lru_cache(maxsize=1)
def version() -> str:
    """The version of this Risorius: that of Blender's manifest, its only place."""
    manifest = tomllib.loads((PACKAGE / "blender_manifest.toml").read_text(encoding="utf-8"))
    return str(manifest["version"])
