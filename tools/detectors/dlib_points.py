"""One detector: the 68 landmarks of dlib, with the weights of the package `face_recognition_models`.

    .venv-strangers/bin/python tools/detectors/dlib_points.py < pictures.json

reads a list of picture files and writes {file: [[x, y], ...] in pixels, or null where no face was found}. Only this
module wants dlib, which is in no other environment; it therefore imports nothing of the project.

Kazemi and Sullivan, "One millisecond face alignment with an ensemble of regression trees" (2014), trained on the
photographs of iBUG 300-W.
"""

from __future__ import annotations

import json
import sys
import sysconfig
from pathlib import Path
from typing import Any

WEIGHTS = Path("face_recognition_models") / "models" / "shape_predictor_68_face_landmarks.dat"


def main() -> None:
    """Find landmarks in the pictures named on standard input."""
    import cv2
    import dlib

    weights = (
        Path(sysconfig.get_paths()["purelib"]) / WEIGHTS
    )  # the package itself is not imported: it wants setuptools
    if not weights.is_file():
        raise SystemExit(
            "the package face_recognition_models is not there: run `python tools/environments.py strangers`"
        )
    finder, predictor = dlib.get_frontal_face_detector(), dlib.shape_predictor(str(weights))
    found: dict[str, list[list[float]] | None] = {}
    for file in json.load(sys.stdin):
        grey: Any = cv2.cvtColor(cv2.imread(file), cv2.COLOR_BGR2GRAY)
        faces = finder(grey, 1)
        if not faces:
            found[file] = None
            continue
        shape = predictor(grey, max(faces, key=lambda face: face.area()))
        found[file] = [[shape.part(i).x, shape.part(i).y] for i in range(68)]
    json.dump(found, sys.stdout)


if __name__ == "__main__":
    main()
