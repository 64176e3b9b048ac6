"""The faces that the evidence for recognition is gathered on: the default head, two shared heads and six people."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

import risorius.api as api
from fit_heads import SharedHeads, TrueHead
from risorius.api import Face

ROOT = Path(__file__).resolve().parent.parent

IDENTITIES = tuple(f"ict identity {number}" for number in range(6))

#: Every face of the evidence.
FACES = ("default", "ict", "makehuman", *IDENTITIES)


def shared_folder() -> Path:
    """The folder of shared heads and samples: $RISORIUS_SHARED, or `../shared` beside the checkout."""
    return Path(os.environ.get("RISORIUS_SHARED") or ROOT.parent / "shared").resolve()


def faces(folder: Path) -> Mapping[str, Callable[[], Face]]:
    """What builds each face, by its name; the shared ones from the heads in `folder`."""
    heads = SharedHeads(folder)
    known = {head.name: head for head in heads.known() if head.name in FACES}
    return {name: api.default_face if name == "default" else partial(_face, known[name]) for name in FACES}


def _face(head: TrueHead) -> Face:
    """The face of a head with its known points."""
    return Face.from_arrays(head.vertices, head.polygons, head.points)
