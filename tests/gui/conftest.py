"""A real Blender with a real window, the built extension installed in it; skipped with the reason where there is none.

Needs root and the shared tool that keeps a Blender with a virtual screen.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from places import ROOT
from release.sources import BuildError
from release.zips import blender_extension_command
from window.driver import NoSharedBlenderError, call, shared_blender


@pytest.fixture(scope="session")
def blender() -> Path:
    """The tool, with its Blender set up."""
    try:
        return shared_blender()
    except NoSharedBlenderError as reason:
        pytest.skip(str(reason))


@pytest.fixture(scope="session")
def settings(blender: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A settings folder in which the built zip is installed and enabled."""
    try:
        blender_extension_command()
    except BuildError as reason:
        pytest.skip(str(reason))
    folder = tmp_path_factory.mktemp("installed")
    settings = folder / "settings"
    settings.mkdir()
    build = [sys.executable, str(ROOT / "tools" / "build.py"), "--platform", "linux-x64", "--blender", "5.1"]
    built = subprocess.run([*build, "--output", str(folder)], capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stdout + built.stderr
    (path,) = folder.glob("*.zip")
    install = ["--command", "extension", "install-file", "-r", "user_default", "--enable", str(path)]
    installed = call(blender, "background", *install, settings=settings)
    assert installed.returncode == 0, installed.stdout + installed.stderr
    return settings
