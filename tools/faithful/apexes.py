"""Contact sheets of the apexes: the six emotions and the fourteen words on one head, front and three-quarter."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import risorius.api as api
from risorius.api import Face, Profile

from .requests import words
from .sheet import Cell, write_grid
from .sitter import Sitter, View

EMOTIONS = ("joy", "surprise", "fear", "anger", "sadness", "disgust")


def write_apexes(name: str, face: Face, folder: Path, *, fine: bool = False) -> list[Path]:
    """Write NAME-emotions.png and NAME-words.png of a head into a folder."""
    sitter = Sitter.of_head(name, face, fine=fine)
    sheets = {"emotions": (EMOTIONS, 2), "words": (tuple(words()), 3)}
    written = []
    for sheet, (shown, columns) in sheets.items():
        heading = f"{name}: {sheet} at their apex, natural drive, front and three-quarter"
        cells = _cells(sitter, face, shown)
        written.append(write_grid(cells, folder / f"{name}-{sheet}.png", columns=columns, heading=heading))
    return written


def _cells(sitter: Sitter, face: Face, shown: Sequence[str]) -> list[Cell]:
    """One cell per word: the face posed as its profile asks, from both views."""
    profiles = [api.expression(word) for word in shown]
    poses = [face.pose(profile.frame(), emotion=profile.weights).positions for profile in profiles]
    pictures = zip(*(sitter.shots(poses, view) for view in View), strict=True)
    return [Cell(w, _caption(p), seen) for w, p, seen in zip(shown, profiles, pictures, strict=True)]


def _caption(profile: Profile) -> str:
    """What the word is made of."""
    weights = " + ".join(f"{share:.2f} {name}" for name, share in profile.weights.items() if share > 0.0)
    return f"activation {profile.activation:.1f}; {weights or 'neutral'}"
