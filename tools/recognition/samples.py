"""The sample .fap files that show an emotion: what is believed of each frame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import risorius.api as api
from risorius.arrays import Floats
from risorius.mpeg4 import FAPS, Rule, Unit

from .verdicts import EMOTIONS

#: File -> the emotion it is named after; the other samples show none.
SAMPLES = {
    "xface_anger.fap": "anger",
    "xface_fear.fap": "fear",
    "xface_joy.fap": "joy",
    "vreng_anger.fap": "anger",
    "vreng_sad.fap": "sadness",
}

#: FAPs that are lengths: turned heads and eyes, and the two that are no lengths at all, say nothing of strength.
LENGTHS = [number - 1 for number, fap in FAPS.items() if number > 2 and fap.unit is not Unit.AU]


@dataclass(frozen=True)
class Sample:
    """One file.

    Attributes
    ----------
    name, emotion : the file's name, and what it is named after.
    stated : how many FAPs it states at all.
    fps : frames per second.
    strongest : index of the frame of the largest sum of FAPs.
    believed : rule -> (T, 6) beliefs, masked-off FAPs unknown.
    at_rest : the same, masked-off FAPs at rest.
    """

    name: str
    emotion: str
    stated: int
    fps: float
    strongest: int
    believed: Mapping[Rule, Floats]
    at_rest: Mapping[Rule, Floats]


def read_samples(folder: Path) -> list[Sample]:
    """All sample files of emotions."""
    return [_read(folder / name, emotion) for name, emotion in SAMPLES.items()]


def _read(path: Path, emotion: str) -> Sample:
    """One file."""
    stream = api.read_fap(path)
    return Sample(
        name=path.name,
        emotion=emotion,
        stated=int((~np.isnan(stream.frames)).any(axis=0).sum()),
        fps=stream.fps,
        strongest=int(np.nansum(np.abs(stream.frames[:, LENGTHS]), axis=1).argmax()),
        believed={rule: _beliefs(stream.frames, rule) for rule in Rule},
        at_rest={rule: _beliefs(np.nan_to_num(stream.frames), rule) for rule in Rule},
    )


def _beliefs(frames: Floats, rule: Rule) -> Floats:
    """(T, 6) beliefs in the archetypes."""
    found = [list(api.recognise(frame, rule=rule).values()) for frame in frames]
    return np.array(found).reshape(-1, len(EMOTIONS))
