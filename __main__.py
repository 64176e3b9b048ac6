"""`python -m risorius VERB`: the command line."""

from __future__ import annotations

import os
import sys

from .cli import main


def run() -> None:
    """Run one verb and leave with its exit code.

    Blender as a Python module may wait forever for threads of its own when Python ends in order (after a glTF export,
    for one). By then everything is written and printed, so the process leaves at once.
    """
    code = main()
    if "bpy" in sys.modules:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
    sys.exit(code)


if __name__ == "__main__":
    run()
