"""Baking: shape keys and keyframes from a face's poses and motions.

Everything is computed before anything is written, so an error or a cancelled bake leaves the scene as it was.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import Floats
from ...errors import SceneError
from ...progress import Progress, Work, Writing, part_of
from ..creases import marks as crease_marks
from ..faces import FaceSource, face_of, face_steps
from . import action as actions
from . import shape_keys
from .compress import TOLERANCE, Shapes, gathering, squeeze
from .compress_long import compress_long
from .gathered import Gathered
from .motion import Motion
from .notes import Note
from .remarks import remarks, unmet_remarks
from .target import Target
from .timing import ClipTiming, scene_fps
from .writing import Written, write_baked

if TYPE_CHECKING:
    from ...api import EmotionShares, Face, Retargeted
    from ...face.long_motion import LongMotion

#: So many frames that differ most are measured for what does not show, or until all does.
MEASURED = 60


@dataclass(frozen=True, eq=False)
class BakeResult:
    """What a bake has written.

    Attributes
    ----------
    clip, action : the clip's name, and its action's.
    keys : names of its shape keys.
    error : largest distance of any vertex from the computed motion, metres.
    frame_range : first and last frame.
    achieved : (68,) FAPs measured on an expression; None for a motion.
    remarks : what the user should know and may want to do something about. told : what is merely worth knowing.
    followed : how far the controls of a rig follow, where the bake went onto these.
    peaks : name of a control of that rig -> the value farthest from its rest, of those that move.
    left_alone : name -> why, of what could have been a control.
    """

    clip: str
    action: str
    keys: tuple[str, ...]
    error: float
    frame_range: tuple[float, float]
    achieved: Floats | None = None
    remarks: tuple[str, ...] = ()
    told: tuple[str, ...] = ()
    followed: Retargeted | None = None
    peaks: Mapping[str, float] = field(default_factory=dict)
    left_alone: Mapping[str, str] = field(default_factory=dict)


def bake_expression(
    target: Target,
    faps: Floats,
    *,
    clip: str,
    timing: ClipTiming,
    peak: float = 1.0,
    drive: str = "natural",
    emotion: EmotionShares | None = None,
    contractions: Mapping[str, float] | None = None,
    creases: bool | None = None,
    note: Note | None = None,
) -> Work[BakeResult]:
    """Bake one expression as one shape key at its apex, with keyframes along onset, apex and offset.

    Parameters
    ----------
    faps : (68,) FAPs; NaN where the expression is silent.
    clip : name of the shape key and of the clip; a clip of this name is replaced.
    peak : the key's value at the apex.
    drive, emotion, contractions : as for `Face.pose`.
    creases : whether the head gets creases (`creases.settle`); None: where a material of it draws them.
    note : what is noted on the action (`notes.py`).

    Raises
    ------
    SceneError, ModelError, SolverError : nothing has been changed then.
    """
    yield Progress(0.0, "Reading the face")
    source = target.source()
    yield Progress(0.1, "Placing the muscles")
    face = yield from part_of(face_steps(source), 0.1, 0.15)
    yield from part_of(face.prepare(), 0.15, 0.9)
    yield Progress(0.9, f"Solving the skin for {clip}")
    pose = face.pose(faps, drive=drive, emotion=emotion, contractions=contractions)
    shapes = (np.asarray(pose.positions) - face.vertices)[None]
    marks = crease_marks.prepare(source, creases)
    yield Writing(0.95, "Writing the shape key")
    written = write_baked(
        target, source, clip, [clip], shapes, [timing.curve(peak)], slider_min=0.0, creases=marks, note=note
    )
    return _result(clip, written, target, source, pose.unmet, achieved=np.asarray(pose.achieved))


def bake_motion(
    target: Target,
    motion: Motion,
    *,
    clip: str,
    start: float = 1.0,
    fps: float | None = None,
    drive: str = "natural",
    tolerance: float = TOLERANCE,
    max_keys: int | None = None,
    creases: bool | None = None,
    note: Note | None = None,
) -> Work[BakeResult]:
    """Simulate a motion and bake it, compressed to as few shape keys as keep every vertex within `tolerance`.

    Parameters
    ----------
    motion : expressions in time or a FAP stream (`motion.py`).
    clip : name of the clip, and of its shape keys with a number; a clip of this name is replaced.
    start : first frame in Blender's timeline.
    fps : frames per second of the motion; by default the scene's.
    drive : as for `Face.simulate`.
    tolerance : metres on a life-size face; in proportion on one of another size.
    max_keys : no more shape keys than these, the best ones; a remark says where the motion is then farther off.
    creases, note : as for `bake_expression`.

    Raises
    ------
    SceneError, ModelError, SolverError : nothing has been changed then.
    """
    rate = fps if fps is not None else scene_fps()
    count = motion.frame_count(rate)
    yield Progress(0.0, "Reading the face")
    source = target.source()
    yield Progress(0.02, "Placing the muscles")
    face = yield from part_of(face_steps(source), 0.02, 0.03)
    yield from part_of(face.prepare(), 0.03, 0.1)
    yield from part_of(motion.prepare(), 0.1, 0.12)
    between = motion.between(face, drive)
    within, said = tolerance * face.scale, tuple[str, ...]()
    if between is None:
        packed, missed = yield from part_of(_simulated(face, motion, rate, drive, within, max_keys), 0.12, 0.97)
    else:
        long = yield from part_of(between, 0.12, 0.7)
        packed, missed = yield from part_of(_between(face, long, within, max_keys), 0.7, 0.97)
        said = (long_remark(clip, long),)
    said += few_keys_remarks(clip, packed, within)
    if len(packed.shapes) == 0:
        raise SceneError(source.head.name, "nothing moves in this motion: increase its activation or its duration")
    names = [shape_keys.fitting(clip, f" {number + 1:02d}") for number in range(len(packed.shapes))]
    times = start + np.arange(count, dtype=np.float64)
    curves = [actions.Curve(times, weights, linear=True) for weights in packed.weights.T]
    marks = crease_marks.prepare(source, creases)
    yield Writing(0.97, "Writing the shape keys")
    written = write_baked(target, source, clip, names, packed.shapes, curves, slider_min=-1.0, creases=marks, note=note)
    return _result(clip, written, target, source, missed, error=packed.error, said=said)


def _simulated(
    face: Face, motion: Motion, fps: float, drive: str, tolerance: float, max_keys: int | None
) -> Work[tuple[Shapes, Mapping[int, str]]]:
    """A motion simulated frame by frame, as shapes within a tolerance in metres; FAP number -> why it does not show."""
    count = motion.frame_count(fps)
    gathered = gathering(len(face.vertices), tolerance=tolerance, max_keys=max_keys)
    frames = motion.positions(face, fps, drive)
    yield from part_of(frames.prepare(), 0.0, 0.2)
    for index, positions in enumerate(frames):
        gathered.add(positions - face.vertices)
        yield Progress(0.2 + 0.6 * (index + 1) / count, f"Simulating frame {index + 1} of {count}")
    missed = yield from part_of(_missed(face, motion.asked(drive), gathered), 0.8, 0.82)
    return (yield from part_of(squeeze(gathered, tolerance=tolerance, max_keys=max_keys), 0.82, 1.0)), missed


def _missed(face: Face, asked: Floats, gathered: Gathered) -> Work[Mapping[int, str]]:
    """FAP number -> why it does not show, of FAPs asked (k, 68) of a motion that was gathered."""
    shown = [face.measure(face.vertices)]
    missed, telling = face.unmet_measured(asked, np.array(shown)), gathered.telling(MEASURED)
    for number, step in enumerate(telling[:, None]):
        if not missed:
            break
        yield Progress(number / MEASURED, "Measuring the motion")
        shown.append(face.measure(face.vertices + gathered.frames(step).reshape(-1, 3)))
        missed = face.unmet_measured(asked, np.array(shown))
    return missed


def _between(
    face: Face, long: LongMotion, tolerance: float, max_keys: int | None
) -> Work[tuple[Shapes, Mapping[int, str]]]:
    """The same of a long motion, of which the frames that differ most are looked at."""
    some = long.posed[:MEASURED]
    missed = yield from part_of(face.unmet_steps(long.frames[some], long.positions(some)), 0.0, 0.2)
    packing = compress_long(long, face.vertices, tolerance=tolerance, max_keys=max_keys)
    return (yield from part_of(packing, 0.2, 1.0)), missed


def long_remark(clip: str, long: LongMotion) -> str:
    """What is to be said of a motion of which only some frames were posed."""
    off = long.off if len(long.off) else np.zeros(1)  # every frame was posed
    usual, most = (1000.0 * np.percentile(off, share) for share in (50, 100))
    return (
        f"{clip}: {len(long.posed)} of {len(long)} frames were posed and the others are between these, as a rule within"
        f" {usual:.1f} mm, at most {most:.1f} mm"
    )


def few_keys_remarks(clip: str, packed: Shapes, tolerance: float) -> tuple[str, ...]:
    """What is to be said where fewer shape keys were allowed than a tolerance in metres takes."""
    if packed.error <= tolerance or not packed.is_limited:
        return ()
    keys = f"{len(packed.shapes)} shape key" + "s" * (len(packed.shapes) != 1)
    return (f"{clip}: {keys} show the motion within {1000.0 * packed.error:.2f} mm; more keys show it better",)


def joined(results: Sequence[BakeResult]) -> BakeResult:
    """Several results told as one."""
    starts, ends = zip(*(result.frame_range for result in results), strict=True)
    return BakeResult(
        ", ".join(result.clip for result in results),
        ", ".join(result.action for result in results),
        tuple(dict.fromkeys(key for result in results for key in result.keys)),
        max(result.error for result in results),
        (min(starts), max(ends)),
        remarks=tuple(dict.fromkeys(remark for result in results for remark in result.remarks)),
        told=tuple(dict.fromkeys(line for result in results for line in result.told)),
        left_alone={name: why for result in results for name, why in result.left_alone.items()},
    )


def _result(
    clip: str,
    written: Written,
    target: Target,
    source: FaceSource,
    missed: Mapping[int, str],
    *,
    error: float = 0.0,
    achieved: Floats | None = None,
    said: tuple[str, ...] = (),
) -> BakeResult:
    """What to tell of a bake; `missed` : FAP number -> why, of what was asked and does not show. `said` : besides."""
    frames = actions.frames_of(written.action)
    said += remarks(source.head, face_of(source)) + written.remarks + unmet_remarks(missed, clip) + target.remarks()
    return BakeResult(clip, written.action.name, written.keys, error, frames, achieved, said)
