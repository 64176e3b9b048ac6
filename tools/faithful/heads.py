"""The heads that faces are measured and pictured on: the default one, and those of the shared folder."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path

import numpy as np
import risorius.api as api
from places import shared_folder
from risorius.api import Face, Part
from risorius.arrays import Bools, Floats, Ints
from risorius.errors import FormatError, ParameterError
from risorius.face.mesh.points import PointSource
from risorius.face.mesh.segmentation import pieces
from risorius.face.mesh.template import MM

#: Vertices of the ICT skin, which other identities have too; the rest is sockets, teeth, eyeballs.
ICT_SKIN = 11248
IDENTITIES = tuple(f"identity-{number}" for number in range(6))
HEADS = ("default", "ict", "makehuman", *IDENTITIES)

_TEETH, _LASHES = 3, 6
_PARTS = {0: Part.SKIN, 5: Part.SKIN, 7: Part.SKIN, 1: Part.EYEBALL_L, 2: Part.EYEBALL_R, 4: Part.TONGUE}


def heads_folder() -> Path:
    """The folder of the shared heads.

    Raises
    ------
    FormatError : it is not there.
    """
    folder = shared_folder() / "heads"
    if not folder.is_dir():
        raise FormatError(folder, "there are no heads: set RISORIUS_SHARED to the folder that has heads/ict.npz")
    return folder


@lru_cache(maxsize=2)
def load_face(name: str) -> Face:
    """The face of a head of `HEADS`; the last two are kept.

    Raises
    ------
    FormatError : the shared heads are not there. ParameterError : there is no head of that name.
    """
    if name not in HEADS:
        raise ParameterError("head", f"must be one of {', '.join(HEADS)}", name)
    return api.default_face() if name == "default" else _labelled_face(name)


def _labelled_face(name: str) -> Face:
    """The face of a shared head, parts by its labels."""
    folder = heads_folder()
    identity = IDENTITIES.index(name) if name in IDENTITIES else None
    mesh = _mesh(name)
    data = np.load(folder / f"{mesh}.npz")
    facts = json.loads((folder / f"{mesh}.fp.json").read_text(encoding="utf-8"))
    vertices, labels = data["vertices"].astype(np.float64), data["labels"].astype(np.int64)
    points: dict[str, PointSource] = {n: v for n, v in facts["points"].items() if n != "7.1"}
    if identity is None:
        points |= {n: np.array(facts["xyz"][n]) for n in facts["no_vertex"] if n != "7.1"}
    else:
        vertices[:ICT_SKIN] = np.load(folder / "ict_identities.npz")["vertices"][identity]
        vertices[ICT_SKIN:] += inner_displacements(folder / "ict_identities_inner.npz")[identity]
    polygons = np.split(data["loops"].astype(np.int64), np.cumsum(data["face_sizes"])[:-1])
    between_teeth = float(vertices[facts["points"]["2.3"], 2]) - 3 * MM
    return Face.from_arrays(vertices, polygons, points, _parts(vertices, polygons, labels, between_teeth))


def _mesh(name: str) -> str:
    """The file of a shared head: identities are other shapes of the ICT mesh."""
    return "ict" if name in IDENTITIES else name


def lash_vertices(name: str) -> Bools:
    """(V,) which vertices of a shared head are lashes: strips that need a texture to look like hair."""
    lashes: Bools = np.load(heads_folder() / f"{_mesh(name)}.npz")["labels"] == _LASHES
    return lashes


def _parts(vertices: Floats, polygons: list[Ints], labels: Ints, between_teeth: float) -> Ints:
    """(V,) parts by the labels (V,); teeth are told into rows by the height of each piece."""
    parts = np.array([int(_PARTS.get(label, Part.OTHER)) for label in labels.tolist()], dtype=np.int64)
    piece = pieces(polygons, len(vertices))
    for tooth in np.unique(piece[labels == _TEETH]):
        member = piece == tooth
        above = vertices[member, 2].mean() > between_teeth
        parts[member] = int(Part.TEETH_UPPER if above else Part.TEETH_LOWER)
    return parts


def inner_displacements(path: Path) -> Floats:
    """(N, V - ICT_SKIN, 3) metres: the array of a file about what lies inside the head."""
    data = np.load(path)
    name = next(key for key in data.files if data[key].ndim == 3)
    inner: Floats = data[name].astype(np.float64)
    return inner
