"""What 68 landmarks (iBUG's), which other detectors find, tell of a face: heights and widths in the picture."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import numpy as np
from environments import ENVIRONMENTS
from places import ROOT
from risorius.arrays import Floats
from strangers.judges import FACE_API, NoJudgeError, answer, commands

from .figures import Follows, follows
from .stills import REST, Still

DLIB = "dlib"
FINDERS = (FACE_API, DLIB)

#: Still -> (68, 2) pixels, x to the right and y down; None where no face was found.
Points: TypeAlias = Mapping[Still, Floats | None]

#: Corners of both eyes.
EYES = (36, 39, 42, 45)


@dataclass(frozen=True)
class Measure:
    """How far some landmarks lie above others, or apart, and the FAPs that move them so: number -> share.

    Numbers of landmarks are those of iBUG from 0.
    """

    name: str
    above: tuple[int, ...]
    below: tuple[int, ...]
    faps: Mapping[int, float]
    across: bool = False

    def of(self, points: Floats) -> float:
        """In pixels."""
        first, second = points[list(self.above)].mean(axis=0), points[list(self.below)].mean(axis=0)
        return float(np.linalg.norm(second - first)) if self.across else float(second[1] - first[1])

    def true(self, faps: Floats) -> float:
        """The FAPs (68,) that move it so, FAP units."""
        return float(sum(share * faps[number - 1] for number, share in self.faps.items()))


MEASURES = (
    Measure("inner brows over the eyes", (21, 22), EYES, {31: 0.5, 32: 0.5}),
    Measure("middles of the brows", (19, 24), EYES, {33: 0.5, 34: 0.5}),
    Measure("outer brows", (17, 26), EYES, {35: 0.5, 36: 0.5}),
    Measure("gap of the lids", (37, 38, 43, 44), (40, 41, 46, 47), {19: -0.5, 20: -0.5, 21: -0.5, 22: -0.5}),
    Measure("upper lip under the nose's root", (50, 51, 52), (27,), {51: -0.4, 55: -0.3, 56: -0.3}),
    Measure("mouth corners", (48, 54), (27,), {12: 0.5, 13: 0.5}),
    Measure("width of the mouth", (48,), (54,), {6: 0.5, 7: 0.5}, across=True),
    Measure("gap of the lips", (62,), (66,), {4: -1.0, 5: -1.0}),
    Measure("chin", (27,), (8,), {3: 1.0}),
)


def eye_distance(points: Floats) -> float:
    """Between the middles of both eyes, pixels."""
    return float(np.linalg.norm(points[36:42].mean(axis=0) - points[42:48].mean(axis=0)))


def measure_follows(measure: Measure, found: Points, true: Mapping[Still, Floats], stills: Iterable[Still]) -> Follows:
    """How a measure follows its FAPs: its change from rest, as a share of the eyes' distance, against theirs."""
    seen, shown = list[float](), list[float]()
    for still in stills:
        now, rest = found.get(still), found.get(still.at_rest)
        if still.shows == REST or now is None or rest is None:
            continue
        seen.append((measure.of(now) - measure.of(rest)) / eye_distance(rest))
        shown.append(measure.true(true[still]))
    return follows(np.array(seen), np.array(shown))


def ask_points(stills: Sequence[Still], folder: Path, kept: Path) -> dict[str, Points]:
    """Finder -> its landmarks in pictures of a folder; asks only about what is not in the file `kept`, and adds to it.

    Raises
    ------
    NoJudgeError : there are new pictures, and a finder cannot be asked or fails.
    """
    known: dict[str, dict[str, list[list[float]] | None]] = {finder: {} for finder in FINDERS}
    if kept.is_file():
        known |= json.loads(kept.read_text(encoding="utf-8"))
    for finder in FINDERS:
        new = [str((folder / still.file).resolve()) for still in stills if still.file not in known[finder]]
        if new:
            heard = answer(finder, _command(finder), new)
            known[finder] |= {Path(path).name: points for path, points in heard.items()}
            kept.write_text(json.dumps(known), encoding="utf-8")
    return {
        finder: {still: None if (found := known[finder][still.file]) is None else np.array(found) for still in stills}
        for finder in FINDERS
    }


def _command(finder: str) -> list[str]:
    """What finds landmarks in a list of files."""
    if finder == FACE_API:
        return [*commands()[FACE_API], "--points"]
    environment = ENVIRONMENTS["strangers"]
    if not environment.stamp.is_file() or shutil.which(str(environment.python)) is None:
        raise NoJudgeError("dlib is not installed: run `python tools/environments.py strangers`")
    return [str(environment.python), str(ROOT / "tools" / "detectors" / "dlib_points.py")]
