"""Whether an emotion that is shown is the one recognised, measured on the mesh and read off the pictures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import risorius.api as api
from risorius.track import find_landmarks, open_pictures, track_landmarks

from .known import BEFORE, EMOTIONS, READ, TRUTH

RULES = ("paper", "robust")


@dataclass(frozen=True)
class Recognised:
    """One film. `name`: head and side; `mesh`, `camera`: rule -> shown emotion -> the emotion of the largest belief."""

    name: str
    mesh: Mapping[str, Mapping[str, str]]
    camera: Mapping[str, Mapping[str, str]]


def read_emotions(folder: Path) -> Recognised:
    """Recognise each emotion of a film at its apex, told that it begins neutral; the stream is left beside the film."""
    told = np.load(folder / TRUTH)
    fps, shown = float(told["fps"]), told["shown"].tolist()
    landmarks = find_landmarks(open_pictures([folder], fps=fps))
    track = track_landmarks(landmarks, neutral=(0.0, (BEFORE - 0.5) / fps))
    api.write_fap(folder / READ, track.stream)
    found = [
        {
            rule: {word: str(api.recognise(frames[shown.index(word) + 1], rule=rule).best) for word in EMOTIONS}
            for rule in RULES
        }
        for frames in (told["frames"], track.stream.frames)
    ]
    return Recognised(folder.name, *found)
