"""What is pictured: a head with a word at some activation, or with scanned actions as control; and its pose."""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import risorius.api as api
from faithful.heads import HEADS, ICT_SKIN, heads_folder, inner_displacements, load_face
from places import shared_folder
from risorius.api import Face
from risorius.arrays import Bools, Floats
from risorius.face.mesh.template import MM
from scipy.optimize import nnls
from scipy.spatial import cKDTree

EMOTIONS = ("joy", "surprise", "fear", "anger", "sadness", "disgust")

#: What a sitting does instead of a word at an activation.
OWN, SCAN, REST = "own", "scan", "rest"

#: Degrees to the side from which the six are seen, too; heads that show all words.
ASIDE, WORD_HEADS = 20, ("default", "ict")

#: The head that scanned actions belong to.
SCANNED_HEAD = "ict"

#: Sockets behind the lids and lips follow a scanned skin, of which no inner displacement is known, over this length.
FOLLOWING = 8.0 * MM

#: Labels of the shared heads: the mouth's and the eyes' sockets.
_SOCKETS = (5, 7)

#: FAPs that no skin shows: eyeballs, tongue, head.
_UNSEEN = (*range(1, 3), *range(23, 31), *range(43, 51))


@dataclass(frozen=True)
class Sitting:
    """One picture to make.

    Attributes
    ----------
    head : of `faithful.heads.HEADS`.
    word : an emotion word.
    how : "own" for the word's own activation, a number from 1 to 7, "scan" for scanned actions, or "rest".
    turned : degrees that the camera stands to the subject's left.
    """

    head: str
    word: str
    how: str = OWN
    turned: int = 0


def sittings(
    heads: Sequence[str], words: Sequence[str], activations: Sequence[str], turned: Sequence[int], *, control: bool
) -> list[Sitting]:
    """Every head with every word, and each at rest; the control, where the scans are there."""
    asked = [Sitting(head, word, how, yaw) for head in heads for yaw in turned for how in activations for word in words]
    asked += [Sitting(head, REST, REST, yaw) for head in heads for yaw in turned]
    if control:
        asked += [Sitting(SCANNED_HEAD, emotion, SCAN, yaw) for yaw in turned for emotion in EMOTIONS]
    return asked


def whole_evening() -> list[Sitting]:
    """All that docs/strangers.md tells: the six on all heads from two sides, their growth, all words on some heads."""
    six = sittings(HEADS, EMOTIONS, [OWN], [0, ASIDE], control=scans_are_there())
    grown = sittings(HEADS, EMOTIONS, [str(how) for how in range(1, 8)], [0], control=False)
    words = sittings(WORD_HEADS, list(api.WORDS), [OWN], [0], control=False)
    return list(dict.fromkeys([*six, *grown, *words]))


def by_head(asked: Iterable[Sitting]) -> dict[str, list[Sitting]]:
    """Head -> its sittings."""
    found: dict[str, list[Sitting]] = {}
    for sitting in asked:
        found.setdefault(sitting.head, []).append(sitting)
    return found


def posed(face: Face, sitting: Sitting) -> Floats:
    """(V, 3) the face as the sitting wants it; as a user gets it, in the natural drive."""
    if sitting.how == REST:
        return face.vertices
    if sitting.how == SCAN:
        return scanned_sum(sitting.word)
    profile = api.expression(sitting.word, activation=None if sitting.how == OWN else float(sitting.how))
    positions: Floats = face.pose(profile.frame(), emotion=profile.weights).positions
    return positions


# ---- the control ------------------------------------------------------------------------------------------------


def scans_are_there() -> bool:
    """Whether the control can be made; says on standard error what is missing."""
    missing = [path for path in (_sums_file(), heads_folder() / "ict_expressions_2.npz") if not path.is_file()]
    for path in missing:
        print(f"no control: {path} is not there", file=sys.stderr)
    return not missing


def scanned_sum(emotion: str) -> Floats:
    """(V, 3) the sum of scanned shapes whose FAPs come nearest to those of the emotion's best sum of action units.

    Not every scan is at hand: what is missing (the outer brow's raiser) is replaced as well as the others can.
    """
    face, shapes = load_face(SCANNED_HEAD), _scanned()
    with _sums_file().open(encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        row = next(row for row in rows if row["emotion"] == emotion)
    wanted = np.array([float(row.get(f"F{number}") or 0.0) for number in range(1, 69)])
    shown = np.setdiff1d(np.arange(1, 69), _UNSEEN) - 1
    units = np.stack([np.nan_to_num(face.measure(face.vertices + shape)) for shape in shapes], axis=1)
    amounts, _ = nnls(units[shown], wanted[shown])
    summed: Floats = face.vertices + np.tensordot(amounts, np.stack(shapes), axes=1)
    return summed


def _sums_file() -> Path:
    """FAPs of the sums that outside judges name best."""
    return shared_folder() / "design" / "strangers" / "scanned_sums.csv"


@cache
def _scanned() -> list[Floats]:
    """(V, 3) displacements of the scanned shapes on the whole head, left and right as one."""
    folder = heads_folder()
    pairs: dict[str, Floats] = {}
    for file, inner_file in (("ict_expressions", "ict_expressions_inner"), ("ict_expressions_2", None)):
        data = np.load(folder / f"{file}.npz")
        skins = data["displacement"].astype(np.float64)
        inners = inner_displacements(folder / f"{inner_file}.npz") if inner_file else [_followed(s) for s in skins]
        for name, skin, inner in zip(data["names"].tolist(), skins, inners, strict=True):
            if not name.startswith(("eyeLook", "Pupil")):
                both = name.removesuffix("_L").removesuffix("_R")
                pairs[both] = pairs.get(both, 0.0) + np.concatenate([skin, inner])
    return list(pairs.values())


def _followed(skin: Floats) -> Floats:
    """(V - ICT_SKIN, 3) displacement of what lies inside the head: sockets hang on the nearest skin (ICT_SKIN, 3)."""
    data = np.load(heads_folder() / "ict.npz")
    vertices = data["vertices"].astype(np.float64)
    sockets: Bools = np.isin(data["labels"][ICT_SKIN:], _SOCKETS)
    away, nearest = cKDTree(vertices[:ICT_SKIN]).query(vertices[ICT_SKIN:])
    share = np.where(sockets, np.exp(-((away / FOLLOWING) ** 2)), 0.0)
    followed: Floats = share[:, None] * skin[nearest]
    return followed
