"""What Blender and Python say when something is used that a later version takes away."""

from __future__ import annotations

import re

#: "DeprecationWarning: ...", "... is deprecated", "... is expected to be removed in Blender 6.0".
SAID = re.compile(r"deprecat|(will|expected to) be removed", re.IGNORECASE)


def deprecations(output: str) -> list[str]:
    """The lines of what a program printed that say so."""
    return [line for line in output.splitlines() if SAID.search(line)]
