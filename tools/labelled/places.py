"""MediaPipe's landmarks in pictures of neutral heads, carried onto the template face and averaged."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from risorius.arrays import Floats, Ints
from risorius.face.mesh.template import MM, TemplateWarp
from risorius.mpeg4.streams.capture import CAPTURE_PRESETS
from risorius.track import find_landmarks, open_pictures
from scipy.optimize import linear_sum_assignment
from scipy.spatial import cKDTree

TABLE = CAPTURE_PRESETS / "mediapipe_places.csv"

#: The landmarks of the face; those after them are of the irises.
FACE = 468
#: A landmark beside the head belongs to the nearest place of it within so many pixels.
BESIDE = 6
#: Places are averaged so often with less weight on those that lie far from the others, as a share of the median.
ROUNDS, FAR = 10, 2.0
#: Landmarks in the middle of the face, each its own mirror image.
MIDDLE = (*(0, 1, 2, 4, 5, 6), *range(8, 20), 94, 151, 152, 164, 168, 175, 195, 197, 199, 200)

HEADER = """\
# Where MediaPipe's face mesh sees its landmarks on a neutral face: mm on the template face to the subject's left, up,
# forward; origin feature point 9.15; left and right made alike. off_mm: how far the heads differ (median).
# Written by tools/label_evidence.py from Workbench pictures of neutral heads, each from the front, 20 degrees from
# either side and nodding by 12 degrees up and down:
# {heads}.
# Own measurement: no mesh is copied. Heads: default (this project); ict, identity-* of ICT-FaceKit (MIT);
# makehuman* (CC0).
landmark,left_mm,up_mm,forward_mm,off_mm
"""


def write_places(folder: Path) -> None:
    """Write the table from the pictures of heads in a folder."""
    heads = sorted(each for each in folder.iterdir() if (each / "head.npz").is_file())
    seen, weights = zip(*(_on_template(head) for head in heads), strict=True)
    places, off = averaged(np.concatenate(seen), np.concatenate(weights))
    twins = twins_of(places)
    assert (twins[twins] == np.arange(len(twins))).all()
    places = (places + places[twins] * [-1.0, 1.0, 1.0]) / 2.0
    lines = [
        f"{number}," + ",".join(f"{value / MM:.2f}" for value in place) + f",{far / MM:.2f}"
        for number, (place, far) in enumerate(zip(places, off, strict=True))
    ]
    TABLE.write_text(HEADER.format(heads=", ".join(head.name for head in heads)) + "\n".join(lines) + "\n", "utf-8")
    print(f"{len(heads)} heads; off by {np.median(off) / MM:.2f} mm, at most {off.max() / MM:.2f}")


def _on_template(head: Path) -> tuple[Floats, Floats]:
    """(sides, 468, 3) places on the template of the landmarks seen on one head, and how well each was seen."""
    data = np.load(head / "head.npz")
    back = _back_to_template(data["names"].tolist(), data["places"])
    places, weights = [], []
    for picture in sorted(head.glob("side-*.png")):
        shown = np.load(picture.with_suffix(".npz"))
        size = shown["facing"].shape[0]
        marks = find_landmarks(open_pictures([picture])).positions[0, :FACE]
        pixels = np.stack([marks[:, 0], -marks[:, 1]], axis=1) * size
        there = np.argwhere(np.isfinite(shown["places"][..., 0]))
        apart, nearest = cKDTree(there[:, ::-1] + 0.5).query(pixels)
        rows, columns = there[nearest].T
        places.append(back(shown["places"][rows, columns].astype(np.float64)))
        seen = np.clip(shown["facing"][rows, columns], 0.02, 1.0).astype(np.float64)
        weights.append(np.where(apart <= BESIDE, seen, 0.001))
    return np.array(places), np.array(weights)


def _back_to_template(names: Sequence[str], places: Floats) -> TemplateWarp:
    """The way from a face's head space onto the template."""
    warp = TemplateWarp(dict(zip(names, places, strict=True)))
    warp._source, warp._target = warp._target, warp._source
    return warp


def averaged(places: Floats, weights: Floats) -> tuple[Floats, Floats]:
    """(P, 3) where most of n sets of places (n, P, 3) agree, by weights (n, P); and how far they are from it (P,)."""
    share = weights[..., None]
    mean = (share * places).sum(axis=0) / share.sum(axis=0)
    for _ in range(ROUNDS):
        off = np.linalg.norm(places - mean, axis=2)
        trusted = (weights / (1.0 + (off / (FAR * np.median(off, axis=0))) ** 4))[..., None]
        mean = (trusted * places).sum(axis=0) / trusted.sum(axis=0)
    return mean, np.median(np.linalg.norm(places - mean, axis=2), axis=0)


def twins_of(places: Floats) -> Ints:
    """(P,) which landmark each is the mirror image of: as near as all together can be; in the middle, itself."""
    flipped = places * [-1.0, 1.0, 1.0]
    own = np.isin(np.arange(len(places)), MIDDLE)
    twins = np.arange(len(places))
    apart = np.linalg.norm(flipped[~own][:, None] - places[~own], axis=2)
    np.fill_diagonal(apart, apart.max())
    twins[~own] = twins[~own][linear_sum_assignment(apart**2)[1]]
    return twins
