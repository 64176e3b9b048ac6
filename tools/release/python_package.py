"""The package for plain Python: a source distribution, and the wheel that comes of it."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from .sources import BuildError, copy_sources

#: Seconds since 1970 of every file in the wheel, so that building twice gives the same bytes: 1 January 1980.
DATE = "315532800"

#: A call of setuptools as any installer makes it; it prints the name of the file that it made.
BACKEND = "import sys; from setuptools import build_meta; getattr(build_meta, sys.argv[1])(sys.argv[2])"


def build_python_package(folder: Path) -> tuple[Path, Path]:
    """The source distribution and the wheel, in `folder`. The wheel is built from the source distribution alone.

    Raises
    ------
    BuildError
        setuptools refuses; the message holds what it said.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        checkout, unpacked = Path(scratch) / "checkout", Path(scratch) / "unpacked"
        copy_sources(checkout)
        archive = _call("build_sdist", checkout, folder, "*.tar.gz")
        shutil.unpack_archive(archive, unpacked)
        (sources,) = unpacked.iterdir()
        return archive, _call("build_wheel", sources, folder, "*.whl")


def _call(hook: str, sources: Path, folder: Path, made: str) -> Path:
    """Run one hook of the build backend on `sources`; the file that it made in `folder`."""
    with tempfile.TemporaryDirectory() as scratch:
        command = [sys.executable, "-c", BACKEND, hook, scratch]
        environment = {**os.environ, "SOURCE_DATE_EPOCH": DATE}
        done = subprocess.run(command, cwd=sources, env=environment, capture_output=True, text=True, check=False)
        if done.returncode:
            raise BuildError(f"setuptools cannot build the Python package ({hook}):\n{done.stdout}{done.stderr}")
        (path,) = Path(scratch).glob(made)
        return Path(shutil.move(path, folder / path.name))
