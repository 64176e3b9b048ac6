"""The pictures of the manual, taken in a real Blender window so that they show the panels as they are.

    make docs-pictures                       ARGS="--only wheel timeline" for some of them

Builds and installs the extension into a settings folder of its own, goes through the steps that the pages describe,
and writes docs/pictures/. Needs Linux, root and the shared tool that keeps a Blender with a virtual screen
(`blender-gui` in RISORIUS_SHARED, default ../shared).
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path

from manual.heads import body, character, clicking, own_head
from manual.panels import baked, first, muscles, reading, timeline, wheel
from manual.rig import rig
from manual.session import Session, installed
from window.driver import NoSharedBlenderError, Window, WindowError, shared_blender

PICTURED: Mapping[str, Callable[[Session], None]] = {
    "first": first,
    "wheel": wheel,
    "timeline": timeline,
    "baked": baked,
    "body": body,
    "clicking": clicking,
    "muscles": muscles,  # this one and those after it take the other panels away
    "own_head": own_head,
    "reading": reading,
    "character": character,
    "rig": rig,
}


def main() -> int:
    """Take the pictures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="*", choices=PICTURED, default=list(PICTURED), help="which pictures")
    arguments = parser.parse_args()
    try:
        tool = shared_blender()
    except NoSharedBlenderError as reason:
        print(f"The pictures need a Blender with a virtual screen: {reason}.", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory(prefix="risorius-") as name:
        folder = Path(name)
        try:
            settings = installed(tool, folder)
            with Window(tool, settings, folder / "asked") as window:
                session = Session(window, folder)
                for key in arguments.only:
                    PICTURED[key](session)
        except WindowError as problem:
            print(problem, file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
