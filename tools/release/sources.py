"""The files that belong to the project, and its version."""

from __future__ import annotations

import shutil
import subprocess
import tomllib
from pathlib import Path

from places import ROOT

GENERATED = {"build", "dist", "out"}

VERSION: str = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))["version"]
"""Read from the Blender manifest, its only place."""


class BuildError(Exception):
    """Why something could not be built."""


def source_files() -> list[Path]:
    """The files of the checkout, relative to it: what git tracks or would, or all but hidden ones without git."""
    listing = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
    done = subprocess.run(listing, cwd=ROOT, capture_output=True, check=False)
    if done.returncode == 0:
        names = [Path(name) for name in done.stdout.decode().split("\0") if name]
    else:
        names = [path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file()]
        names = [name for name in names if name.parts[0] not in GENERATED and "__pycache__" not in name.parts]
    visible = (name for name in names if not any(part.startswith(".") for part in name.parts))
    return sorted(name for name in visible if (ROOT / name).is_file())


def copy_sources(folder: Path) -> None:
    """Copy the project into `folder`, so that building leaves nothing behind in the checkout."""
    for name in source_files():
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, target)
