"""The wheels that go into the extension: which ones each Blender on each system needs, and their download."""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Platform:
    """One system: Blender's name for it, the wheel tags that run on it, the preferred one first, and its ranges."""

    name: str
    tags: tuple[str, ...]
    ranges: tuple[str, ...] = ("4.2", "5.1")


@dataclass(frozen=True)
class BlenderRange:
    """Blender versions that share their Pythons.

    `first` is the first version of the range, `end` the first one past it (None: open), `pythons` the Python
    versions found in them and `scipy` the requirement that fits their NumPy.
    """

    name: str
    first: str
    end: str | None
    pythons: tuple[str, ...]
    scipy: str


# Blender itself needs glibc 2.28; wheels tagged for older systems run there too. Blender for Macs with Intel ends with
# 4.5, and SciPy for Windows on Arm begins with Python 3.13.
PLATFORMS = (
    Platform("linux-x64", ("manylinux2014_x86_64", "manylinux_2_17_x86_64", "manylinux_2_27_x86_64",
                           "manylinux_2_28_x86_64")),
    Platform("windows-x64", ("win_amd64",)),
    Platform("windows-arm64", ("win_arm64",), ranges=("5.1",)),
    Platform("macos-arm64", ("macosx_11_0_arm64", "macosx_12_0_arm64")),
    Platform("macos-x64", ("macosx_10_9_x86_64", "macosx_10_12_x86_64", "macosx_10_13_x86_64"), ranges=("4.2",)),
)  # fmt: skip

# Blender 4.2 brings NumPy 1.24.3: SciPy 1.15 is the last that runs on it. From 5.1 the official builds have
# Python 3.13, and those of some distributions 3.14.
RANGES = (
    BlenderRange("4.2", "4.2.0", "5.1.0", ("3.11",), "scipy>=1.15,<1.16"),
    BlenderRange("5.1", "5.1.0", None, ("3.13", "3.14"), "scipy>=1.16.1,<1.18"),
)


class DownloadError(Exception):
    """A wheel that could not be had; the message names it."""


# The same for every Python. praatio reads TextGrids, and needs typing_extensions; espeakng-loader is eSpeak NG with its
# voices, for one system.
PLAIN = ("praatio>=6.2,<7", "typing_extensions>=4.10,<5")
VOICES = "espeakng_loader>=0.2,<0.3"


def fetch(platform: Platform, blender: BlenderRange, folder: Path) -> list[Path]:
    """The wheels of one zip, downloaded into `folder` unless they lie there already.

    Raises
    ------
    DownloadError
        when pip finds no such wheel or no network.
    """
    tags = [option for tag in platform.tags for option in ("--platform", tag)]
    compiled = [
        _fetch(
            folder / f"{platform.name}-cp{python.replace('.', '')}",
            blender.scipy,
            f"Python {python} on {platform.name}",
            ["--python-version", python, *tags],
        )
        for python in blender.pythons
    ]
    plain = [_fetch(folder / "any", requirement, "any system", []) for requirement in PLAIN]
    return [*compiled, _fetch(folder / platform.name, VOICES, platform.name, tags), *plain]


def _fetch(place: Path, requirement: str, where: str, options: list[str]) -> Path:
    """One wheel, in a folder where it is found again without asking the network."""
    name = re.split("[<>=~]", requirement)[0]
    present = sorted(place.glob(f"{name}-*.whl"))
    if present:
        return present[-1]
    place.mkdir(parents=True, exist_ok=True)
    print(f"Downloading {requirement} for {where} ...", flush=True)
    command = [sys.executable, "-m", "pip", "download", "--disable-pip-version-check", "--no-deps"]
    command += ["--only-binary=:all:", *options]
    command += [] if sys.stdout.isatty() else ["--progress-bar=off"]
    # Another run may fetch the same one: what is found here has been fetched to its end.
    with tempfile.TemporaryDirectory(dir=place) as scratch:
        if subprocess.run([*command, "--dest", scratch, requirement], check=False).returncode:
            raise DownloadError(f"no wheel of {requirement} for {where} (pip's message is above)")
        (wheel,) = Path(scratch).glob(f"{name}-*.whl")
        return wheel.replace(place / wheel.name)
