"""A real photograph that a library ships: scikit-image's astronaut, a woman who smiles broadly."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from risorius.track import Track, find_landmarks, open_pictures, track_landmarks


def read_photograph(out: Path) -> Track:
    """Track the photograph (public domain, NASA), which has no neutral face to go with it."""
    path = out / "astronaut.png"
    picture = import_module("skimage.data").astronaut()
    import_module("skimage.io").imsave(path, picture, check_contrast=False)
    return track_landmarks(find_landmarks(open_pictures([path])), name="astronaut")
