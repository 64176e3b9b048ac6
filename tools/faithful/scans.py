"""Expressions to hold a face against: scanned ones of the ICT topology, hand-drawn ones of MakeHuman's.

A shape's FAPs are measured on it, a face is posed from these alone, and its explained variance is
1 - sum |posed - shape|^2 / sum |shape|^2 over the skin's displacements.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from risorius.api import Drive, Face
from risorius.arrays import Floats, Ints
from risorius.face.mesh.template import MM

from .heads import ICT_SKIN, heads_folder, inner_displacements

#: Scanned shapes that no FAP speaks of: eyeballs and pupils, correctives, rolled lips.
UNSEEN = ("eyeLook", "PupilDilate", "mouthClose", "mouthRoll")

#: A shape whose feature points all move less than this cannot be told by FAPs.
LEAST_SEEN = 0.1 * MM

#: MakeHuman's skin label.
_SKIN = 0


@dataclass(frozen=True)
class Shape:
    """An expression of one face.

    Attributes
    ----------
    name : such as "mouthSmile_L".
    frame : (68,) its FAPs, NaN for eyeballs, tongue and head.
    skin : (n,) the vertices it is judged on.
    moved : (n, 3) their displacement in head space, metres.
    positions : (V, 3) the whole face in its own coordinates.
    """

    name: str
    frame: Floats
    skin: Ints
    moved: Floats
    positions: Floats

    def explained_by(self, moved: Floats) -> float:
        """Share of the shape's variance that a displacement (n, 3) of its skin in head space explains."""
        return 1.0 - float(((moved - self.moved) ** 2).sum() / (self.moved**2).sum())


Explained: TypeAlias = Mapping[str, float]


def scanned_shapes(face: Face) -> list[Shape]:
    """The scanned shapes that FAPs speak of, one of each mirrored pair, on a face of the ICT topology."""
    folder = heads_folder()
    data = np.load(folder / "ict_expressions.npz")
    inner = inner_displacements(folder / "ict_expressions_inner.npz")
    shapes = []
    for name, skin, rest in zip(data["names"].tolist(), data["displacement"].astype(np.float64), inner, strict=True):
        if not name.startswith(UNSEEN) and not name.endswith("_R"):
            shapes.append(_shape(face, name, np.concatenate([skin, rest]), np.arange(ICT_SKIN)))
    return shapes


def drawn_shapes(face: Face) -> list[Shape]:
    """MakeHuman's face units that move a feature point, one of each mirrored pair, on its own head."""
    folder = heads_folder()
    data = np.load(folder / "makehuman_expressions.npz")
    skin = np.flatnonzero(np.load(folder / "makehuman.npz")["labels"] == _SKIN)
    shapes = []
    for name, displacement in zip(data["names"].tolist(), data["displacement"].astype(np.float64), strict=True):
        if "-right-" in name:
            continue
        shape = _shape(face, name, displacement, skin)
        if np.nanmax(np.abs(face.anatomy.skin_rows.select(shape.frame))) > LEAST_SEEN:
            shapes.append(shape)
    return shapes


def _shape(face: Face, name: str, displacement: Floats, skin: Ints) -> Shape:
    """The shape of a displacement (V, 3) in the face's coordinates."""
    positions = face.vertices + displacement
    frame = face.measure(positions)
    frame[23 - 1 : 30] = frame[43 - 1 : 50] = np.nan
    return Shape(name, frame, skin, head_displacement(face, positions)[skin], positions)


def head_displacement(face: Face, positions: Floats) -> Floats:
    """(V, 3) displacement in head space of a face's positions (V, 3)."""
    moved: Floats = face.anatomy.mesh.head_frame.to_head(positions) - face.anatomy.mesh.positions
    return moved


def explained(shapes: Sequence[Shape], model: Callable[[Shape], Floats]) -> dict[str, float]:
    """Shape -> explained variance of a model that gives its skin's displacement (n, 3) in head space."""
    return {shape.name: shape.explained_by(model(shape)) for shape in shapes}


def posed(face: Face, drive: Drive = Drive.EXACT) -> Callable[[Shape], Floats]:
    """The model that poses a face from a shape's FAPs alone."""
    return lambda shape: head_displacement(face, face.pose(shape.frame, drive=drive).positions)[shape.skin]
