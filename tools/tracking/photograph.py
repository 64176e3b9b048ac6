"""A real photograph that a library ships: scikit-image's astronaut, a woman who smiles broadly."""

from __future__ import annotations

from pathlib import Path

from risorius.track import Track, find_landmarks, open_pictures, track_landmarks


def read_photograph(out: Path) -> Track:
    """Track the photograph (public domain, NASA), which has no neutral face to go with it."""
    from skimage import data, io

    path = out / "astronaut.png"
    io.imsave(path, data.astronaut(), check_contrast=False)
    return track_landmarks(find_landmarks(open_pictures([path])), name="astronaut")
