"""The generic face: the mean of neutral heads as MediaPipe sees them, written as presets/capture/generic_face.csv."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from risorius.arrays import Floats
from risorius.face.mesh.template import MM
from risorius.face.tracked.landmarks import LandmarkReading
from risorius.face.tracked.mediapipe_landmarks import landmark_numbers, read_landmarks
from risorius.track import find_landmarks, open_pictures
from risorius.track.generic_face import TABLE

HEADING = """\
# The generic neutral face as MediaPipe's face mesh sees it: mm to the subject's left, up, forward; origin feature point
# 9.15; sizes by the template's points that expression does not move. Written by tools/track_evidence.py: the mean over
# Workbench pictures of neutral heads from the front, and its mirror image:
# {heads}.
# spread_mm: how far the heads differ from it (root mean square).
point,landmark,left_mm,up_mm,forward_mm,spread_mm
"""


def write_generic_face(neutral: Path) -> dict[str, float]:
    """Write the table from the pictures in a folder; the spread of each point in mm."""
    heads = sorted(folder for folder in neutral.iterdir() if folder.is_dir())
    faces = [_seen_face(folder) for folder in heads]
    numbers = landmark_numbers()
    names = sorted(faces[0], key=lambda name: tuple(map(int, name.split("."))))
    stack = np.array([[face[name] for name in names] for face in faces]) / MM
    stack -= stack[:, [names.index("9.15")]]
    mean = _symmetric(stack.mean(axis=0), names)
    spread = np.sqrt(((stack - mean) ** 2).sum(axis=2).mean(axis=0))
    lines = [
        f"{name},{numbers[name]}," + ",".join(f"{value:.2f}" for value in (*place, far))
        for name, place, far in zip(names, mean, spread, strict=True)
    ]
    text = HEADING.format(heads=", ".join(folder.name for folder in heads)) + "\n".join(lines) + "\n"
    TABLE.write_text(text, encoding="utf-8")
    return dict(zip(names, spread.tolist(), strict=True))


def _seen_face(folder: Path) -> dict[str, Floats]:
    """Feature points of one neutral head as it is seen, in head space."""
    reading: LandmarkReading = read_landmarks(find_landmarks(open_pictures([folder])))
    return dict(reading.neutral)


def _symmetric(face: Floats, names: list[str]) -> Floats:
    """The mean of a face (P, 3) and its mirror image; a point's twin is the one nearest to where the mirror puts it."""
    mirrored = face * [-1.0, 1.0, 1.0]
    twins = [int(np.linalg.norm(mirrored[i] - face, axis=1).argmin()) for i in range(len(names))]
    symmetric: Floats = (face + mirrored[twins]) / 2.0
    return symmetric
