"""Build what users install, in dist/: the extension's zips and the Python package.

    .venv/bin/python tools/build.py [--platform linux-x64] [--blender 5.1] [--no-wheels] [--python] [--output dist]

Without options everything is built: one zip per system and Blender range, with SciPy inside, checked by Blender; the
source distribution and the wheel. `--no-wheels` builds one small zip for Blenders whose Python has SciPy already (those
of Linux distributions), `--python` the Python package alone. The same sources give the same bytes of zips and wheel.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

from places import ROOT
from release.python_package import build_python_package
from release.sources import VERSION, BuildError
from release.wheels import PLATFORMS, RANGES, BlenderRange, DownloadError, Platform, fetch
from release.zips import build_zip

WHEELS = ROOT / ".cache" / "wheels"


def targets(arguments: argparse.Namespace) -> Iterator[tuple[str, Platform | None, BlenderRange | None]]:
    """The zips asked for: file name, system, Blender range."""
    if arguments.python:
        return
    if arguments.no_wheels:
        yield f"risorius-{VERSION}-no-wheels.zip", None, None
        return
    for blender in RANGES:
        for platform in PLATFORMS:
            chosen = arguments.platform in (None, platform.name) and arguments.blender in (None, blender.name)
            if chosen and blender.name in platform.ranges:
                yield f"risorius-{VERSION}-blender{blender.name}-{platform.name}.zip", platform, blender


def main(argv: list[str] | None = None) -> int:
    """Build what the options ask for; 0 when all of it was built and every zip passed Blender's check."""
    parser = argparse.ArgumentParser(description="Build what users install.")
    parser.add_argument("--platform", choices=[platform.name for platform in PLATFORMS], help="only this system's zips")
    parser.add_argument("--blender", choices=[blender.name for blender in RANGES], help="only from this Blender on")
    kinds = parser.add_mutually_exclusive_group()
    kinds.add_argument("--no-wheels", action="store_true", help="one zip without SciPy")
    kinds.add_argument("--python", action="store_true", help="the Python package alone")
    parser.add_argument("--output", type=Path, default=ROOT / "dist", help="folder of what is built (default: dist)")
    arguments = parser.parse_args(argv)
    if arguments.platform and arguments.blender and not list(targets(arguments)):
        parser.error(f"there is no SciPy for Blender {arguments.blender} on {arguments.platform}: use another zip")
    zips_alone = arguments.platform or arguments.blender or arguments.no_wheels
    try:
        for name, platform, blender in targets(arguments):
            wheels = fetch(platform, blender, WHEELS) if platform and blender else []
            path = build_zip(arguments.output / name, wheels, platform=platform, blender=blender)
            print(f"{path}  {path.stat().st_size / 1e6:.1f} MB, valid", flush=True)
        if not zips_alone:
            print(*build_python_package(arguments.output), sep="\n", flush=True)
    except (BuildError, DownloadError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
