"""Baking onto a rig: a pose or a motion of the muscles as keyframes of the controls that a character already has.

Everything is computed before anything is written, so an error or a cancelled bake leaves the scene as it was. No key is
added and none is changed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, TypeAlias

import numpy as np

from ...arrays import Floats
from ...progress import Progress, Work, Writing, part_of
from ..bake.action import Curve
from ..bake.baking import BakeResult, long_remark
from ..bake.motion import Motion
from ..bake.notes import Note, write_note
from ..bake.remarks import sewn_remarks, thinned_remarks, unmet_remarks
from ..bake.target import Target
from ..bake.timing import ClipTiming, scene_fps
from ..faces import FaceSource, face_steps, read_face
from ..refusals import sharer_of
from .clips import Keyframes, overlap, refuse_unkeyable, remove_rig_clips, write_rig_clip
from .kept import Followed, keep
from .rig import Rig
from .rounds import frames_to_look_at, settled_values

if TYPE_CHECKING:
    from ...api import Controls, EmotionShares, Face, Retargeted

#: Finds the controls of a face, bit by bit.
FindRig: TypeAlias = Callable[[FaceSource], Work[Rig]]

#: Names and FAPs that a remark lists.
LISTED = 4


@dataclass(frozen=True)
class Onto:
    """How a clip is put onto a rig.

    Attributes
    ----------
    symmetric : controls that are each other's mirror image get one value.
    smooth : how smooth values are over time; 0 leaves each frame to itself, 1 is usual.
    above : on top of what plays already, to be taken off again; else as keyframes in the actions that play now.
    """

    symmetric: bool = False
    smooth: float = 1.0
    above: bool = True


class Timed(Protocol):
    """When an expression shows, and how much of it."""

    def curve(self, peak: float) -> Curve:
        """Its keyframes; `peak` where it is full."""
        ...


@dataclass(frozen=True, eq=False)
class Expression:
    """One expression to be baked: FAPs (68,), NaN where it is silent, and when it happens.

    `clip`, `peak`, `emotion`, `contractions` and `note` are as for `bake.bake_expression`.
    """

    clip: str
    faps: Floats
    timing: Timed
    peak: float = 1.0
    emotion: EmotionShares | None = None
    contractions: Mapping[str, float] | None = None
    note: Note | None = None


def bake_expression_onto(
    target: Target,
    faps: Floats,
    find_rig: FindRig,
    *,
    clip: str,
    timing: ClipTiming,
    onto: Onto = Onto(),
    peak: float = 1.0,
    drive: str = "natural",
    emotion: EmotionShares | None = None,
    contractions: Mapping[str, float] | None = None,
    note: Note | None = None,
) -> Work[BakeResult]:
    """Bake one expression onto the controls of a rig, with keyframes along onset, apex and offset.

    Parameters
    ----------
    find_rig : `key_rig`, or that of bones, as work.
    others : as for `bake.bake_expression`.

    Raises
    ------
    SceneError, ModelError, SolverError : nothing has been changed then.
    """
    expression = Expression(clip, faps, timing, peak, emotion, contractions, note)
    (result,) = yield from bake_expressions_onto(target, [expression], find_rig, onto=onto, drive=drive)
    return result


def bake_expressions_onto(
    target: Target, expressions: Sequence[Expression], find_rig: FindRig, *, onto: Onto = Onto(), drive: str = "natural"
) -> Work[list[BakeResult]]:
    """Bake several expressions, a clip each; the rig is looked at once, and all are computed before any is written.

    Those that share frames add up.

    Raises
    ------
    SceneError, ModelError, SolverError : nothing has been changed then.
    """
    from ... import api

    source, face, rig, controls = yield from _prepared(target, find_rig)
    retargeting = api.Retargeting(face, controls, symmetric=onto.symmetric)
    solved: list[tuple[Expression, Retargeted, Mapping[int, str]]] = []
    for index, each in enumerate(expressions):
        yield Progress(0.7 + 0.3 * index / len(expressions), f"Solving the skin for {each.clip}")
        pose = face.pose(each.faps, drive=drive, emotion=each.emotion, contractions=each.contractions)
        take = retargeting.take(frames_to_look_at(rig, 1))
        take.add(pose.positions)
        part = 0.7 + 0.3 * index / len(expressions), 0.7 + 0.3 * (index + 1) / len(expressions)
        found = yield from part_of(settled_values(rig, retargeting, take, requested=each.faps), *part)
        solved.append((each, found, pose.unmet))
    yield Writing(1.0, "Writing keyframes")
    rig.refuse_changed()
    remove_rig_clips(source.head, [each.clip for each in expressions])
    results: list[BakeResult] = []
    for each, found, missed in solved:
        curve = _on_frames(each.timing.curve(each.peak))
        values = {
            channel: moved[0] * curve.values for channel, moved in rig.channel_values(found.names, found.values).items()
        }
        said = (*unmet_remarks(missed, each.clip), *_about(target, rig, face))
        keyframes = Keyframes(curve.frames, values, curve.linear)
        adding = any(overlap(result.frame_range, keyframes.span) for result in results)
        results.append(_write(source, rig, each.clip, keyframes, onto, found, said, note=each.note, adding=adding))
    return results


def bake_motion_onto(
    target: Target,
    motion: Motion,
    find_rig: FindRig,
    *,
    clip: str,
    start: float = 1.0,
    fps: float | None = None,
    onto: Onto = Onto(),
    drive: str = "natural",
    note: Note | None = None,
) -> Work[BakeResult]:
    """Simulate a motion and bake it onto the controls of a rig; parameters as for `bake.bake_motion`.

    Raises
    ------
    SceneError, ModelError, SolverError : nothing has been changed then.
    """
    from ... import api

    rate = fps if fps is not None else scene_fps()
    count = motion.frame_count(rate)
    source, face, rig, controls = yield from _prepared(target, find_rig)
    retargeting = api.Retargeting(face, controls, symmetric=onto.symmetric)
    take = retargeting.take(frames_to_look_at(rig, count))
    yield from part_of(motion.prepare(), 0.7, 0.71)
    between, long = motion.between(face, drive), None
    if between is not None:
        frames: Iterable[Floats] = (long := (yield from part_of(between, 0.71, 0.75)))
    else:
        simulated = motion.positions(face, rate, drive)
        yield from part_of(simulated.prepare(), 0.71, 0.75)
        frames = simulated
    for index, positions in enumerate(frames):
        take.add(positions)
        yield Progress(0.75 + 0.15 * (index + 1) / count, f"Simulating frame {index + 1} of {count}")
    work = settled_values(rig, retargeting, take, fps=rate, requested=motion.asked(drive), smooth=onto.smooth)
    found = yield from part_of(work, 0.9, 1.0)
    values = rig.channel_values(found.names, found.values)
    keyframes = Keyframes(start + np.arange(count, dtype=np.float64), values, linear=True)
    about = _about(target, rig, face)
    said = about if long is None else (*about, long_remark(clip, long))
    yield Writing(1.0, "Writing keyframes")
    rig.refuse_changed()
    return _write(source, rig, clip, keyframes, onto, found, said, note=note)


def _prepared(target: Target, find_rig: FindRig) -> Work[tuple[FaceSource, Face, Rig, Controls]]:
    """The face, ready for poses, and the controls of its rig, which are refused before the face takes long."""
    yield Progress(0.0, "Reading the face")
    source = read_face(target.obj, companions=target.companions)
    yield Progress(0.05, "Looking at the controls")
    rig = yield from part_of(find_rig(source), 0.05, 0.25)
    refuse_unkeyable(place.owner for entry in rig.entries for place in entry.channel.places)
    controls = rig.controls()
    yield Progress(0.25, "Placing the muscles")
    face = yield from part_of(face_steps(source), 0.25, 0.3)
    yield from part_of(face.prepare(), 0.3, 0.7)
    return source, face, rig, controls


def _about(target: Target, rig: Rig, face: Face) -> tuple[str, ...]:
    """What the user should know about the face, what of it stays behind, and what else moves along."""
    name = rig.source.head.name
    return (*sewn_remarks(name, face.sewn), *thinned_remarks(name, face), *target.remarks(), *_sharing(rig))


def _sharing(rig: Rig) -> list[str]:
    """Remarks on objects that share the keys of a face and move with it."""
    keyed = {place.owner for entry in rig.entries for place in entry.channel.places}
    said = []
    for obj in rig.source.objects:
        sharer = sharer_of(obj) if obj.data.shape_keys in keyed else None
        if sharer is not None and sharer not in [str(other.name) for other in rig.source.objects]:
            said.append(
                f"{sharer} shares the mesh of {obj.name} and moves with it: make it single user to keep it still"
            )
    return said


def _write(
    source: FaceSource,
    rig: Rig,
    clip: str,
    keyframes: Keyframes,
    onto: Onto,
    found: Retargeted,
    said: tuple[str, ...],
    *,
    note: Note | None,
    adding: bool = False,
) -> BakeResult:
    """Key a clip and tell of it."""
    written = write_rig_clip(source.head, clip, keyframes, above=onto.above, adding=adding)
    keep(written.actions, Followed.of(found))
    if note is not None:
        for action in written.actions:
            write_note(action, note)
    used = tuple(channel.name for channel, moved in keyframes.values.items() if np.abs(moved).max() > 0.0)
    peaks = {channel.name: channel.resting + _farthest(moved) for channel, moved in keyframes.values.items()}
    apex = int(np.argmax(found.moved))
    return BakeResult(
        clip,
        ", ".join(action.name for action in written.actions),
        used,
        float(found.off.max(initial=0.0)),
        keyframes.span,
        found.shown[apex],
        (*rig_remarks(clip, rig, found), *written.remarks, *said),
        rig_tales(clip, found),
        found,
        {name: peaks[name] for name in used},
        dict(rig.left_alone),
    )


def _on_frames(curve: Curve) -> Curve:
    """Eased keyframes on whole frames, as a hand would set them."""
    if curve.linear:
        return curve
    frames, first = np.unique(np.floor(curve.frames + 0.5), return_index=True)
    return Curve(frames, curve.values[first])


def _farthest(moved: Floats) -> float:
    """Of values (N,) that count from rest, the one farthest from it."""
    return float(moved[np.argmax(np.abs(moved))])


def rig_tales(clip: str, found: Retargeted) -> tuple[str, ...]:
    """How far the controls of a rig follow, and which of them were of no use."""
    told = [
        f"{clip}: the controls show {found.explained:.0%} of the motion, {1000.0 * found.off_at_peak:.1f} mm off at its"
        f" peak, most of it with {_listed(list(found.carriers))}"
    ]
    if found.still:
        told.append(f"not used, because they do not move the face: {_listed(list(found.still))}")
    if found.same:
        told.append(
            f"not used, because another does the same: {_listed([f'{a} ({b})' for a, b in found.same.items()])}"
        )
    return tuple(told)


def rig_remarks(clip: str, rig: Rig, found: Retargeted) -> tuple[str, ...]:
    """What the controls of a rig miss, and what was left alone."""
    from ... import api

    said: list[str] = []
    if found.missing:
        said.append(f"{clip}: too little of {_listed([short.line for short in found.missing])}")
    said += [f"{clip}: {line}" for line in api.unmet_lines(found.unmet)]
    if np.abs(found.head_turns).max(initial=0.0) > 0.0:
        said.append(f"{clip}: the head's turn is not on these controls")
    for reason in dict.fromkeys(rig.left_alone.values()):
        names = [name for name, why in rig.left_alone.items() if why == reason]
        said.append(f"left alone: {_listed(names)}: {reason}")
    return tuple(said)


def _listed(names: list[str]) -> str:
    """The first of some names, and how many more."""
    more = len(names) - LISTED
    return ", ".join(names[:LISTED]) + (f" and {more} more" if more > 0 else "")
