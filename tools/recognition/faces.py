"""The faces that the evidence for recognition is gathered on: the default head, two shared heads and six people."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

import risorius.api as api
from fit.heads import SharedHeads, TrueHead
from risorius.api import Face

IDENTITIES = tuple(f"ict identity {number}" for number in range(6))

#: Every face of the evidence.
FACES = ("default", "ict", "makehuman", *IDENTITIES)


def faces(folder: Path) -> Mapping[str, Callable[[], Face]]:
    """What builds each face, by its name; the shared ones from the heads in `folder`."""
    heads = SharedHeads(folder)
    known = {head.name: head for head in heads.known() if head.name in FACES}
    return {name: api.default_face if name == "default" else partial(_face, known[name]) for name in FACES}


def _face(head: TrueHead) -> Face:
    """The face of a head with its known points."""
    return Face.from_arrays(head.vertices, head.polygons, head.points)
