"""A recording on a head, frame by frame, and what is read back from the vertices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import risorius.api as api
from faithful.heads import load_face
from risorius.api import Face
from risorius.arrays import Bools, Floats
from risorius.mpeg4 import FAP_COUNT
from risorius.progress import run

from .takes import Take

#: A FAP that moves less than this, from its 1st to its 99th percentile, says nothing: FAP units, and those of angles.
MOVED, TURNED = 10.0, 500.0
ANGLES = (*range(23, 27), *range(48, 51))
#: A face is still in this share of the frames of a recording, over so many frames.
STILL, OVER = 0.2, 15
#: A blink of this score or more is to shut the lids.
SHUT = 0.9
#: Motion is looked for up to so many seconds late or early, and found where it correlates so much.
LATE, ALIKE = 0.3, 0.9
#: FAPs of the left eye's lids, whose sum is 1024 where they meet.
LIDS, MET = (19, 21), 1024.0


@dataclass(frozen=True, eq=False)
class Played:
    """What was read back.

    Attributes
    ----------
    correlation, slope : (68,) of shown with recorded values; NaN where the recording does not move a FAP, or the head
        does not show it.
    open_lids : (2,) median and largest share of the left eye's opening that is left where the recording says shut; NaN.
    trembling : second differences of the shown values over those of the recorded ones, where the face is still.
    jump : the largest step over a frame that the file does not have, as a share of the FAP's range.
    off : (2,) median and largest distance of frames between posed ones from their own pose, metres.
    late : (68,) seconds by which shown values follow the recorded ones, by cross-correlation; NaN as for these, and
        where they are too unlike to tell.
    """

    head: str
    correlation: Floats
    slope: Floats
    open_lids: Floats
    trembling: float
    jump: float
    off: Floats
    late: Floats


def play(take: Take, head: str) -> Played:
    """A recording on a head of `faithful.heads`."""
    face, asked = load_face(head), take.frames
    motion = run(face.long_motion(asked))
    shown = np.array([face.measure(positions) for positions in motion])
    moved = _moved(asked) & np.isfinite(shown).all(axis=0)
    correlation, slope = np.full(FAP_COUNT, np.nan), np.full(FAP_COUNT, np.nan)
    for column in np.flatnonzero(moved):
        correlation[column] = np.corrcoef(asked[:, column], shown[:, column])[0, 1]
        slope[column] = np.polyfit(asked[:, column], shown[:, column], 1)[0]
    off = np.array([np.median(motion.off), motion.off.max()])
    trembling, jump = _trembling(asked[:, moved], shown[:, moved]), _jump(shown[:, moved], take.unknown)
    late = _late(asked, shown, moved, take.recording.stream.fps)
    return Played(head, correlation, slope, _open_lids(take, shown), trembling, jump, off, late)


def lateness(take: Take, head: str, *, inertia: bool) -> Floats:
    """(68,) seconds by which a head follows a recording whose frames are shown one by one; NaN as in `Played`."""
    face: Face = load_face(head)
    shown = np.array([face.measure(positions) for positions in api.play(face, take.recording, inertia=inertia)])
    moved = _moved(take.frames) & np.isfinite(shown).all(axis=0)
    return _late(take.frames, shown, moved, take.recording.stream.fps)


def _moved(asked: Floats) -> Bools:
    """(68,) which FAPs a recording moves."""
    low, high = np.percentile(np.nan_to_num(asked), (1, 99), axis=0)
    least = np.full(FAP_COUNT, MOVED)
    least[np.array(ANGLES) - 1] = TURNED
    return np.asarray(high - low >= least)


def _late(asked: Floats, shown: Floats, moved: Bools, fps: float) -> Floats:
    """(68,) seconds by which shown values follow those asked: where they correlate best, by a parabola between."""
    reach, late = round(LATE * fps), np.full(FAP_COUNT, np.nan)
    shifts, inside = np.arange(-reach, reach + 1), slice(reach, len(asked) - reach)
    for column in np.flatnonzero(moved):
        told = asked[inside, column]
        fits = np.array([np.corrcoef(told, np.roll(shown[:, column], -shift)[inside])[0, 1] for shift in shifts])
        best = int(np.clip(fits.argmax(), 1, len(fits) - 2))
        before, at, after = fits[best - 1 : best + 2]
        if at < ALIKE:
            continue
        late[column] = (shifts[best] + 0.5 * (before - after) / (before - 2.0 * at + after)) / fps
    return late


def _open_lids(take: Take, shown: Floats) -> Floats:
    """Median and largest opening of the left eye where the recording says that it is shut."""
    with np.errstate(invalid="ignore"):
        shut = take.blinks >= SHUT
    if not shut.any():
        return np.full(2, np.nan)
    left = 1.0 - shown[shut][:, np.array(LIDS) - 1].sum(axis=1) / MET
    return np.array([np.median(left), left.max()])


def _trembling(asked: Floats, shown: Floats) -> float:
    """How much a face trembles where the recorded one is still, against that one; the median over the FAPs."""
    ratios = []
    for told, seen in zip(asked.T, shown.T, strict=True):
        pace = np.convolve(np.abs(np.diff(told, prepend=told[0])), np.ones(OVER) / OVER, mode="same")
        still = np.flatnonzero(pace <= np.quantile(pace, STILL))
        still = still[(still > 0) & (still < len(told) - 1)]
        before, after = (np.sqrt(np.mean(np.diff(values, n=2)[still - 1] ** 2)) for values in (told, seen))
        if before > 0.0:
            ratios.append(after / before)
    return float(np.median(ratios))


def _jump(shown: Floats, unknown: Bools) -> float:
    """The largest step into or out of frames that the file does not have, as a share of what the FAP moves in all."""
    places = np.flatnonzero(unknown)
    if not len(places):
        return 0.0
    steps = np.abs(np.diff(shown, axis=0)) / np.ptp(shown, axis=0)
    around = np.unique(np.clip(np.concatenate([places - 1, places]), 0, len(steps) - 1))
    return float(steps[around].max())
