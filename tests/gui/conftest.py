"""A real Blender with a real window, the built extension installed in it; skipped with the reason where there is none.

Needs root and the shared tool that keeps a Blender with a virtual screen.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from places import ROOT
from window.driver import call

OPENGL = ("libgl1", "libegl1", "libglx-mesa0")


@pytest.fixture(scope="session")
def blender(shared: Path) -> Path:
    """The tool, with its Blender set up."""
    tool = shared / "tools" / "blender-gui"
    if not tool.is_file():
        pytest.skip(f"{tool} is not there")
    if not hasattr(os, "geteuid") or os.geteuid() != 0:
        pytest.skip("a Blender with a virtual screen needs root")
    try:
        done = call(tool, "setup", settings=Path("/tmp"), timeout=900)
    except subprocess.TimeoutExpired:
        pytest.skip("setting up the Blender with a virtual screen took more than 15 minutes")
    if done.returncode:
        said = (done.stderr or done.stdout).strip()[-300:]
        pytest.skip(f"the Blender with a virtual screen cannot be set up: {said}")
    provide_opengl(Path(os.environ.get("BLENDER_GUI_ROOT", "/var/tmp/blender-gui")))
    return tool


def provide_opengl(root: Path) -> None:
    """Install the OpenGL libraries where the tool's Blender was set up without them."""
    if any(root.glob("usr/lib/*/libGL.so.1")):
        return
    install = ["chroot", str(root), "apt-get", "install", "-y", "-q", "--no-install-recommends", *OPENGL]
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    done = subprocess.run(install, env=environment, capture_output=True, text=True, check=False)
    if done.returncode:
        pytest.skip(f"the Blender with a virtual screen has no OpenGL: {(done.stderr or done.stdout).strip()[-300:]}")


@pytest.fixture(scope="session")
def settings(blender: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A settings folder in which the built zip is installed and enabled."""
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
