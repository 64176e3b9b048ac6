"""The version of Risorius, read from the Blender manifest: its only place. The packaging (pyproject.toml) asks here."""

from __future__ import annotations

import tomllib
from pathlib import Path

MANIFEST = Path(__file__).resolve().parent.parent / "blender_manifest.toml"
VERSION: str = tomllib.loads(MANIFEST.read_text(encoding="utf-8"))["version"]

if __name__ == "__main__":
    print(VERSION)
