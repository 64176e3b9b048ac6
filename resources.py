"""Where the tables that come with Risorius lie."""

from __future__ import annotations

from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
"""The package itself: a file that is missing below it is a damaged installation."""

PRESETS = PACKAGE / "presets"
"""Tables that a user may copy and edit: emotions, anatomy, tissue, heads, timing."""

STANDARD = PACKAGE / "mpeg4" / "data"
"""Tables of the standard and of the first paper, as printed: nobody's to edit."""
