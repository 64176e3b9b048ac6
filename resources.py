"""Where the tables that come with Risorius lie."""

from __future__ import annotations

from pathlib import Path

PRESETS = Path(__file__).resolve().parent / "presets"
"""Tables that a user may copy and edit: emotions, anatomy, tissue, heads, timing."""
