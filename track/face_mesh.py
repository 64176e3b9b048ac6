"""Landmarks of the face in each picture, by MediaPipe's face mesh with irises; on a CPU, without a network."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from ..arrays import Floats
from ..errors import ModelError
from ..mpeg4.streams.capture import Landmarks
from ..progress import Progress, Report
from .pictures import Picture, Pictures, needed

#: Landmarks of the refined model: the face's 468 and five for each iris.
LANDMARKS = 478


def find_landmarks(pictures: Pictures, *, progress: Report | None = None) -> Landmarks:
    """Landmarks in every picture; NaN where it shows no face. Of several faces, one is taken.

    A keyboard interrupt ends a camera's pictures; those so far are kept.

    Raises
    ------
    RisoriusError : MediaPipe is missing. ModelError : no picture shows a face. FormatError : a damaged picture.
    """
    times: list[float] = []
    positions: list[Floats] = []
    with _face_mesh(still=pictures.count == 1) as mesh:
        try:
            for when, picture in pictures.frames:
                times.append(when)
                positions.append(_landmarks(mesh, picture))
                if progress is not None:
                    progress(Progress.counted(len(times), pictures.count, "images"))
        except KeyboardInterrupt:
            if not pictures.live:
                raise
    if not times or all(np.isnan(face).all() for face in positions):
        raise ModelError(f"{pictures.name}: no image shows a face: it must be large, well lit and seen from the front")
    return Landmarks(np.array(times), np.array(positions))


@contextmanager
def _face_mesh(*, still: bool) -> Iterator[Any]:
    """MediaPipe's face mesh; `still` where pictures do not follow one another."""
    with _quiet():
        module = needed("mediapipe.python.solutions.face_mesh")
        mesh = module.FaceMesh(static_image_mode=still, max_num_faces=1, refine_landmarks=True)
        mesh.process(np.zeros((64, 64, 3), dtype=np.uint8))  # its threads have said what they say by now
    with mesh:
        yield mesh


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep MediaPipe's remarks about itself off standard error, at the level where it writes; exceptions pass."""
    sys.stderr.flush()
    kept = os.dup(2)
    try:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)


def _landmarks(mesh: Any, picture: Picture) -> Floats:
    """(478, 3) landmarks to the picture's right, up and towards the camera, in picture heights; NaN without a face."""
    with _quiet():
        faces = mesh.process(picture).multi_face_landmarks
    if not faces:
        return np.full((LANDMARKS, 3), np.nan)
    width = picture.shape[1] / picture.shape[0]  # x and z are shares of the width, y of the height
    found = np.array([(mark.x, mark.y, mark.z) for mark in faces[0].landmark], dtype=np.float64)
    upright: Floats = found * np.array([width, -1.0, -width])
    return upright
