"""Poses of one head, worked out only where none is known of the same sources, word and activation."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path

import numpy as np
from faithful.heads import heads_folder
from places import ROOT
from risorius.api import Face
from risorius.arrays import Floats

from . import sittings
from .sittings import Sitting, posed

#: What a pose depends on, besides the heads: folders and files of the checkout.
_SOURCES = ("api.py", "face", "mpeg4", "physics", "presets")


class Poses:
    """The poses of a head; what their positions amount to is kept, so that a known one need not be worked out."""

    def __init__(self, face: Face, folder: Path) -> None:
        """`folder`: where what is known is kept, a small file per pose."""
        self._face, self._folder = face, folder
        self._worked_out: dict[tuple[str, str], Floats] = {}

    def positions(self, sitting: Sitting) -> Floats:
        """(V, 3) of a sitting; from whatever side it is seen, it is worked out once."""
        which = (sitting.word, sitting.how)
        if which not in self._worked_out:
            self._worked_out[which] = posed(self._face, sitting)
        return self._worked_out[which]

    def digest(self, sitting: Sitting) -> str:
        """The pose to 0.01 mm, in 24 letters."""
        told = f"{sources_digest()} {sitting.head} {sitting.word} {sitting.how}"
        known = self._folder / hashlib.sha256(told.encode()).hexdigest()[:24]
        if not known.is_file():
            self._folder.mkdir(parents=True, exist_ok=True)
            known.write_text(digest_of(self.positions(sitting)), encoding="ascii")
        return known.read_text(encoding="ascii")


def digest_of(positions: Floats) -> str:
    """Positions (V, 3) in metres to 0.01 mm, in 24 letters."""
    return hashlib.sha256(np.round(positions * 1e5).astype(np.int64).tobytes()).hexdigest()[:24]


@cache
def sources_digest() -> str:
    """All that poses depend on: the product's sources, what is asked here, and the shared heads."""
    known = hashlib.sha256(Path(sittings.__file__).read_bytes())
    for name in _SOURCES:
        top = ROOT / name
        for path in sorted(top.rglob("*")) if top.is_dir() else [top]:
            if path.is_file() and path.suffix != ".pyc":
                known.update(path.read_bytes())
    for path in sorted(heads_folder().glob("*.npz")):
        known.update(f"{path.name} {path.stat().st_size} {path.stat().st_mtime_ns}".encode())
    return known.hexdigest()
