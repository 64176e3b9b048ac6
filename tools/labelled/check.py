"""How far MediaPipe sees its landmarks from where labels have them, in pictures with labels."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from risorius.arrays import Bools, Floats
from risorius.errors import ModelError
from risorius.track import find_landmarks, open_pictures

SET = "mediapipe478"
#: Pupils, by MediaPipe's numbers.
PUPILS = (468, 473)
#: Landmarks along the border of the face, which is where a picture shows its outline.
OUTLINE = (
    10, 338, 297, 332, 284, 251, 389, 356, 454, 323, 361, 288, 397, 365, 379, 378, 400, 377, 152, 148, 176, 149, 150,
    136, 172, 58, 132, 93, 234, 127, 162, 21, 54, 103, 67, 109,
)  # fmt: skip


def labelled_marks(labels: Path, frame: str) -> tuple[Floats, Bools]:
    """(478, 2) pixels of MediaPipe's landmarks by labels, and which are visible (478,)."""
    with (labels / "landmarks.csv").open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["set"] == SET and row["frame"] == frame]
    pixels = np.array([[float(row[axis] or "nan") for axis in "xy"] for row in rows])
    return pixels, np.array([row["visible"] == "true" for row in rows])


def distances(picture: Path, labels: Path) -> tuple[Floats, Bools] | None:
    """(478,) distances in per cent of the distance of the pupils, and which are visible; None where no face is seen."""
    pixels, visible = labelled_marks(labels, str(int(picture.stem)))
    try:
        seen = find_landmarks(open_pictures([picture])).positions[0]
    except ModelError:
        return None
    height = _height(labels)
    told = np.stack([seen[:, 0], -seen[:, 1]], axis=1) * height
    unit = float(np.linalg.norm(pixels[PUPILS[0]] - pixels[PUPILS[1]]))
    return 100.0 * np.linalg.norm(told - pixels, axis=1) / unit, visible


def _height(labels: Path) -> float:
    with (labels / "camera.csv").open(encoding="utf-8", newline="") as file:
        return float(next(csv.DictReader(file))["height"])


def print_table(folder: Path) -> None:
    """A line for each picture with labels below a folder."""
    inner = np.setdiff1d(np.arange(478), OUTLINE)
    print("| picture | mean of visible, inside | all 478 | visible |\n|---|---|---|---|")
    for picture in sorted(folder.glob("*/*.png")):
        found = distances(picture, picture.parent / "labels")
        if found is None:
            print(f"| {picture.parent.name} | no face seen | | |")
            continue
        off, visible = found
        chosen = inner[visible[inner]]
        print(f"| {picture.parent.name} | {np.nanmean(off[chosen]):.1f} | {np.nanmean(off):.1f} | {visible.sum()} |")
