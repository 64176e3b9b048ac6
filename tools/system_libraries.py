"""The shared libraries of the system that Blender needs on Linux without a desktop: find, install or name them."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import sys
from pathlib import Path

# Shared object -> the Debian package that brings it: what `import bpy` itself loads, and EGL, which the Workbench
# and EEVEE engines draw with where there is no screen.
LIBRARIES = {
    "libX11.so.6": "libx11-6",
    "libXrender.so.1": "libxrender1",
    "libxkbcommon.so.0": "libxkbcommon0",
    "libSM.so.6": "libsm6",
    "libICE.so.6": "libice6",
    "libXi.so.6": "libxi6",
    "libXxf86vm.so.1": "libxxf86vm1",
    "libXfixes.so.3": "libxfixes3",
    "libGL.so.1": "libgl1",
    "libEGL.so.1": "libegl1",
}
# EGL hands the drawing to a vendor's library, which registers itself in one of these folders.
VENDORS = ("/usr/share/glvnd/egl_vendor.d", "/etc/glvnd/egl_vendor.d")
VENDOR_PACKAGES = ("libegl-mesa0", "libgl1-mesa-dri")


class MissingLibraries(Exception):
    """Libraries that are missing and could not be installed; the message names them and the command."""


def missing_packages() -> list[str]:
    """The Debian packages of the libraries that this machine lacks; empty on other systems than Linux."""
    if not sys.platform.startswith("linux"):
        return []
    missing = [package for library, package in LIBRARIES.items() if not _loads(library)]
    if not any(any(Path(folder).glob("*.json")) for folder in VENDORS):
        missing += VENDOR_PACKAGES
    return missing


def ensure_system_libraries() -> None:
    """Install the missing libraries where this user may (root on Debian or Ubuntu).

    Raises
    ------
    MissingLibraries
        where they cannot be installed from here; the message says what to install.
    """
    packages = missing_packages()
    if not packages:
        return
    install = ["apt-get", "install", "-y", "--no-install-recommends"]
    if shutil.which("apt-get") and hasattr(os, "geteuid") and os.geteuid() == 0:
        print(f"Blender needs system libraries that are missing here; installing {' '.join(packages)} ...", flush=True)
        environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
        subprocess.run(["apt-get", "update", "-q"], env=environment, stdout=subprocess.DEVNULL, check=False)
        subprocess.run([*install, *packages], env=environment, stdout=subprocess.DEVNULL, check=False)
        packages = missing_packages()
    if packages:
        raise MissingLibraries(
            "Blender needs system libraries that are missing here. On Debian and Ubuntu install them with\n"
            f"    sudo {' '.join([*install, *packages])}\n"
            "and elsewhere install the packages that bring the same libraries."
        )


def _loads(library: str) -> bool:
    """Whether the system's loader finds this shared object."""
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


if __name__ == "__main__":
    try:
        ensure_system_libraries()
    except MissingLibraries as error:
        sys.exit(str(error))
