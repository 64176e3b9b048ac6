"""Landmarks of the face in each picture, by MediaPipe; on a CPU, without a network.

Without a model of the user's, the face mesh with irises that MediaPipe 0.10.21 has in its wheel, the last that has it.
With one (face_landmarker.task), any MediaPipe from then on, 1.x too, which also scores blend shapes.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from ..arrays import Floats
from ..errors import FormatError, ModelError, RisoriusError
from ..mpeg4.streams.capture import Landmarks
from ..progress import Progress, Report
from .pictures import Picture, Pictures, needed

#: Landmarks of the refined model: the face's 468 and five for each iris.
LANDMARKS = 478

#: MediaPipe's face mesh, in wheels up to 0.10.21; the face landmarker, in all since.
MESH, LANDMARKER = "mediapipe.python.solutions.face_mesh", "mediapipe.tasks.python.vision"

NO_MODEL = (
    "this MediaPipe has no face model in its package: give the file with --model face_landmarker.task (from the page "
    '"Face landmark detection guide" of MediaPipe\'s documentation), or install mediapipe==0.10.21, which has one, on '
    "Python 3.11 or 3.12"
)
BAD_MODEL = "is not a face_landmarker.task that MediaPipe can read: download it again"

#: A picture and its time in seconds -> landmarks (478, 3) of a face, shares of the picture, and blend shapes; or None.
Seen: TypeAlias = tuple[Floats, Mapping[str, float]] | None
Finder: TypeAlias = Callable[[Picture, float], Seen]


def find_landmarks(pictures: Pictures, *, model: str | Path | None = None, progress: Report | None = None) -> Landmarks:
    """Landmarks in every picture; NaN where it shows no face. Of several faces, one is taken.

    A keyboard interrupt ends a camera's pictures; those so far are kept.

    Parameters
    ----------
    model : a face_landmarker.task; None: the model in MediaPipe's own package, which 0.10.21 was the last to have.

    Raises
    ------
    RisoriusError : MediaPipe or its model is missing. ModelError : no picture shows a face. FormatError : a damaged
        picture or model.
    """
    return find_faces(pictures, model=model, progress=progress)[0]


def find_faces(
    pictures: Pictures, *, model: str | Path | None = None, progress: Report | None = None
) -> tuple[Landmarks, list[Mapping[str, float]]]:
    """Landmarks as `find_landmarks`, and the blend shapes of each picture: none without a model or a face."""
    times: list[float] = []
    positions: list[Floats] = []
    shapes: list[Mapping[str, float]] = []
    still = pictures.count == 1
    with _face_mesh(still=still) if model is None else _landmarker(Path(model), still=still) as find:
        try:
            for when, picture in pictures.frames:
                times.append(when)
                with _quiet():
                    seen = find(picture, when)
                positions.append(np.full((LANDMARKS, 3), np.nan) if seen is None else _upright(seen[0], picture))
                shapes.append({} if seen is None else seen[1])
                if progress is not None:
                    progress(Progress.counted(len(times), pictures.count, "images"))
        except KeyboardInterrupt:
            if not pictures.live:
                raise
            del times[len(positions) :]
    if not times or all(np.isnan(face).all() for face in positions):
        raise ModelError(f"{pictures.name}: no image shows a face: it must be large, well lit and seen from the front")
    return Landmarks(np.array(times), np.array(positions)), shapes


@contextmanager
def _face_mesh(*, still: bool) -> Iterator[Finder]:
    """The face mesh of MediaPipe's own package; `still` where pictures do not follow one another."""
    with _quiet():
        needed("mediapipe")
        try:
            module: Any = import_module(MESH)
        except ImportError as missing:
            raise RisoriusError(NO_MODEL) from missing
        mesh = module.FaceMesh(static_image_mode=still, max_num_faces=1, refine_landmarks=True)
        mesh.process(np.zeros((64, 64, 3), dtype=np.uint8))  # its threads have said what they say by now

    def find(picture: Picture, _when: float) -> Seen:
        faces = mesh.process(picture).multi_face_landmarks
        return (_places(faces[0].landmark), {}) if faces else None

    with mesh:
        yield find


@contextmanager
def _landmarker(model: Path, *, still: bool) -> Iterator[Finder]:
    """The face landmarker of a file."""
    if not model.is_file():
        raise FormatError(model, "does not exist: give the path of your face_landmarker.task")
    with _quiet():
        package: Any = needed("mediapipe")
        vision: Any = needed(LANDMARKER)
        base: Any = needed("mediapipe.tasks.python").BaseOptions
        mode = vision.RunningMode.IMAGE if still else vision.RunningMode.VIDEO
        try:
            # As bytes: some versions read no path that is not ASCII.
            options = vision.FaceLandmarkerOptions(
                base_options=base(model_asset_buffer=model.read_bytes()),
                running_mode=mode,
                num_faces=1,
                output_face_blendshapes=True,
            )
            landmarker = vision.FaceLandmarker.create_from_options(options)
        except (RuntimeError, ValueError) as refusal:
            raise FormatError(model, BAD_MODEL) from refusal
    last = -1

    def find(picture: Picture, when: float) -> Seen:
        nonlocal last
        image = package.Image(image_format=package.ImageFormat.SRGB, data=picture)
        last = max(last + 1, round(1000.0 * when))  # each time must be later than the last
        found = landmarker.detect(image) if still else landmarker.detect_for_video(image, last)
        if not found.face_landmarks:
            return None
        scores = found.face_blendshapes[0] if found.face_blendshapes else ()
        return _places(found.face_landmarks[0]), {score.category_name: float(score.score) for score in scores}

    with landmarker:
        yield find


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


def _places(marks: Any) -> Floats:
    """(478, 3) landmarks as MediaPipe gives them: x and z are shares of the width, y of the height."""
    return np.array([(mark.x, mark.y, mark.z) for mark in marks], dtype=np.float64)


def _upright(places: Floats, picture: Picture) -> Floats:
    """(478, 3) landmarks to the picture's right, up and towards the camera, in picture heights."""
    width = picture.shape[1] / picture.shape[0]
    upright: Floats = places * np.array([width, -1.0, -width])
    return upright
