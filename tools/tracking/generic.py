"""People's proportions as MediaPipe sees them: the generic face and how neutral faces differ from it.

Written as presets/capture/generic_face.csv (mean, spread) and people.csv (the principal ways in which people differ).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from risorius.arrays import Bools, Floats
from risorius.face.mesh.template import MM, TEMPLATE_POINTS
from risorius.face.tracked.landmarks import fit_poses
from risorius.face.tracked.mediapipe_landmarks import landmark_numbers, stable_points
from risorius.mpeg4 import FEATURE_POINTS
from risorius.track import find_landmarks, open_pictures
from risorius.track.generic_face import AXES, TABLE
from risorius.track.people import PEOPLE

from .sides import SIDES

SOURCE = """\
# Written by tools/track_evidence.py from Workbench pictures of neutral heads, each from the front, 20 degrees from
# either side and nodding by 12 degrees up and down, and their mirror images:
# {heads}.
# Statistics of our own; no mesh is copied. Heads: default (this project); ict, identity-* of ICT-FaceKit (MIT);
# makehuman* (CC0); jeeliz_human of jeelizWeboji (Apache-2.0); mhr of Momentum Human Rig (Apache-2.0).
"""

GENERIC = """\
# The generic neutral face as MediaPipe's face mesh sees it: mm to the subject's left, up, forward; origin feature point
# 9.15; sizes by the template's points that expression does not move.
# spread_mm: how far the heads differ from it, from the front and from 9.15 (root mean square).
"""

MODES = """\
# How neutral faces differ from generic_face.csv, as MediaPipe sees them: principal components of where feature points
# lie once the points that expression does not move are laid on each other. In mm; each mode by one standard deviation.
# own_mm: standard deviation that the modes leave.
"""

#: So many ways are kept.
COUNT = 16

#: Rounds in which faces are laid on their mean.
ROUNDS = 3


def write_people(neutral: Path) -> None:
    """Write both tables from the pictures in a folder: a folder for each head."""
    heads = sorted(folder for folder in neutral.iterdir() if folder.is_dir())
    names = sorted(landmark_numbers(), key=lambda name: tuple(map(int, name.split("."))))
    seen = [face for folder in heads for face in _seen_faces(folder, names)]
    faces = laid_on_each_other(np.array(seen), names)
    mean, modes, own = proportions(faces, people=len(heads))
    origin = [names.index("9.15")]
    fronts = np.concatenate([half[:: len(SIDES)] for half in np.split(faces, 2)])
    away = (fronts - fronts[:, origin]) - (mean - mean[origin])
    spread = np.sqrt((away**2).sum(axis=2).mean(axis=0)) / MM
    places = (mean - mean[origin]) / MM
    source = SOURCE.format(heads=", ".join(folder.name for folder in heads))
    numbers = landmark_numbers()
    lines = [
        f"{name},{numbers[name]}," + ",".join(f"{value:.2f}" for value in (*place, far))
        for name, place, far in zip(names, places, spread, strict=True)
    ]
    columns = f"point,landmark,{','.join(AXES)},spread_mm"
    TABLE.write_text("\n".join([GENERIC + source + columns, *lines]) + "\n", encoding="utf-8")
    rows = [
        f"{name},{axis.removesuffix('_mm')},{own[p, a] / MM:.2f}," + ",".join(f"{v / MM:.2f}" for v in modes[:, p, a])
        for p, name in enumerate(names)
        for a, axis in enumerate(AXES)
    ]
    columns = "point,axis,own_mm," + ",".join(f"mode_{number}" for number in range(1, COUNT + 1))
    PEOPLE.write_text("\n".join([MODES + source + columns, *rows]) + "\n", encoding="utf-8")


def _seen_faces(folder: Path, names: Sequence[str]) -> list[Floats]:
    """(P, 3) feature points of one neutral head in each picture of a folder."""
    numbers = [landmark_numbers()[name] for name in names]
    return [find_landmarks(open_pictures([path])).positions[0, numbers] for path in sorted(folder.iterdir())]


def laid_on_each_other(seen: Floats, names: Sequence[str]) -> Floats:
    """(2n, P, 3) faces (n, P, 3) and their mirror images in metres, their steady points on those of the mean."""
    steady = [names.index(name) for name in stable_points()]
    twins = [names.index(FEATURE_POINTS[name].mirror or name) for name in names]
    there: Bools = np.ones(len(seen), dtype=np.bool_)
    mean = np.array([TEMPLATE_POINTS.get(name, np.full(3, np.nan)) for name in names])
    for _ in range(ROUNDS):
        laid = fit_poses(mean[steady], seen[:, steady], there).undone(seen)
        faces = np.concatenate([laid, (laid * [-1.0, 1.0, 1.0])[:, twins]])
        mean = faces.mean(axis=0)
    return faces


def proportions(faces: Floats, *, people: int) -> tuple[Floats, Floats, Floats]:
    """Mean (P, 3), modes (COUNT, P, 3) of one standard deviation each, and what they leave (P, 3).

    `people`: how many different heads the faces (n, P, 3) are of, for an estimate without bias.
    """
    mean = faces.mean(axis=0)
    away = (faces - mean).reshape(len(faces), -1) * np.sqrt(people / (people - 1.0) / len(faces))
    _, sizes, ways = np.linalg.svd(away, full_matrices=False)
    modes = sizes[:COUNT, None] * ways[:COUNT]
    own = np.sqrt(np.maximum((away**2).sum(axis=0) - (modes**2).sum(axis=0), 0.0))
    return mean, modes.reshape(COUNT, *mean.shape), own.reshape(mean.shape)
