"""Heads with shape keys that other people made, and the default head with those that Risorius makes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import risorius.api as api
from faithful.heads import ICT_SKIN, heads_folder, load_face
from risorius.api import Controls, Face
from risorius.arrays import Floats


@dataclass(frozen=True, eq=False)
class KeyedHead:
    """A face and its shape keys, all from 0 to 1."""

    name: str
    face: Face
    keys: Controls

    @property
    def count(self) -> int:
        """How many keys there are."""
        return len(self.keys)


def keyed_head(name: str) -> KeyedHead:
    """A head of `KEYED_HEADS`.

    Raises
    ------
    FormatError : the shared heads are not there.
    """
    face, changes = KEYED_HEADS[name]()
    zeros = np.zeros(len(changes))
    return KeyedHead(name, face, Controls(tuple(changes), np.array(list(changes.values())), zeros, zeros + 1.0))


#: A face, and key -> (V, 3) what it adds, metres.
Made = tuple[Face, Mapping[str, Floats]]


def _makehuman(*, visemes: bool) -> Made:
    """The MakeHuman head with shapes drawn by hand: the 52 of ARKit, and 15 of speech."""
    data = np.load(heads_folder() / "others" / "makehuman_arkit" / "makehuman_arkit_visemes.npz")
    every = {str(n): d.astype(np.float64) for n, d in zip(data["names"], data["deltas"], strict=True)}
    return load_face("makehuman"), {n: d for n, d in every.items() if visemes or not n.startswith("viseme")}


def _ict() -> Made:
    """The mean head of scanned people, with scanned shapes; what lies inside the head follows where it is known."""
    folder, face = heads_folder(), load_face("ict")
    inner_data = np.load(folder / "ict_expressions_inner.npz")
    inner = dict(zip(inner_data["names"].tolist(), inner_data["displacement"], strict=True))
    changes = {}
    for file in ("ict_expressions", "ict_expressions_2"):
        data = np.load(folder / f"{file}.npz")
        for name, skin in zip(data["names"].tolist(), data["displacement"], strict=True):
            changes[name] = np.zeros_like(face.vertices)
            changes[name][:ICT_SKIN] = skin
            if name in inner:
                changes[name][ICT_SKIN:] = inner[name]
    return face, changes


def _jeeliz() -> Made:
    """A head of eleven morphs, its points found."""
    data = np.load(heads_folder() / "others" / "jeeliz_human" / "shapes.npz")
    vertices, polygons = data["positions"].astype(np.float64), data["triangles"].astype(np.int64)
    found = api.find_points(vertices, polygons)
    face = Face.from_arrays(vertices, polygons, found.positions)
    changes = data["targets"].astype(np.float64)
    return face, dict(zip(data["names"].tolist(), changes, strict=True))


def _default() -> Made:
    """The default head with the 52 shapes of ARKit that Risorius makes."""
    face = load_face("default")
    return face, {name: shape - face.vertices for name, shape in api.arkit_shapes(face).items()}


KEYED_HEADS: Mapping[str, Callable[[], Made]] = {
    "makehuman, 52 drawn": lambda: _makehuman(visemes=False),
    "makehuman, 52 + 15 drawn": lambda: _makehuman(visemes=True),
    "ict, 45 scanned": _ict,
    "jeeliz_human, 11 drawn": _jeeliz,
    "default, 52 made": _default,
}
