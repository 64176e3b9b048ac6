"""What a motion takes of a face, step by step: its plans, and the muscles, lids and jaw that these take.

The skin follows with inertia and elasticity of its own (`face.simulate`); this is what drives it. And the other way
round: the action units that explain FAPs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Floats
from ...mpeg4 import Cue, Feeling, Liveliness, strengths
from ...progress import Progress, Report
from ..drive.natural.planning import natural
from ..drive.over_time import apex_plans, cue_plans, stream_plans
from ..drive.plan import Plan
from ..drive.request import Drive, Request
from ..face import Face
from ..posture import Effort
from ..requests import checked_drive, checked_emotions, checked_stream


@dataclass(frozen=True, eq=False)
class Efforts:
    """What T steps of a motion take of one face.

    Attributes
    ----------
    asked : (T, 68) FAPs as they are asked, FAP units; NaN where silent.
    goals : (T, 68) what the plans make of them, FAP units; NaN where nothing is known of a FAP.
    contractions : name of a muscle, of a movement of lids, or "jaw_open" -> (T,) contraction in [0, 1].
    units : action unit, with "_l" or "_r" where it has sides -> (T,) its amount in the plans; NaN in drives that plan
        none.
    jaw : (T, 3) angle of the opened mandible in radians, its slides to the left and forward in metres.
    """

    asked: Floats
    goals: Floats
    contractions: Mapping[str, Floats]
    units: Mapping[str, Floats]
    jaw: Floats


def stream_efforts(
    face: Face,
    frames: ArrayLike,
    *,
    drive: str | Drive = Drive.NATURAL,
    emotions: ArrayLike | None = None,
    planned: bool = False,
    progress: Report | None = None,
) -> Efforts:
    """What a stream of FAPs (T, 68) takes of a face; parameters and errors as `Face.simulate`.

    Examples
    --------
    >>> frames = np.full((2, 68), np.nan)
    >>> frames[:, 3 - 1] = 0.0, 500.0  # open_jaw
    >>> efforts = api.stream_efforts(api.default_face(), frames)
    >>> bool(efforts.contractions["jaw_open"][1] > 0.2)
    True
    """
    checked = checked_stream(frames)
    weights = checked_emotions(emotions, len(checked))
    plans = stream_plans(checked, checked_drive(drive), weights, planned=planned)
    return _efforts(face, plans, len(checked), progress)


def performance_efforts(
    face: Face,
    cues: Sequence[Cue],
    fps: float = 25.0,
    *,
    drive: str | Drive = Drive.NATURAL,
    contractions: Sequence[Mapping[str, float]] | None = None,
    liveliness: Liveliness | None = None,
    progress: Report | None = None,
) -> Efforts:
    """What expressions in time take of a face; parameters and errors as `Face.performance`.

    Examples
    --------
    >>> cue = api.Cue(api.expression("joy"), onset=0.2, apex=0.0, offset=0.2)
    >>> efforts = api.performance_efforts(api.default_face(), [cue], 10.0)
    >>> int(efforts.contractions["zygomaticus_major_l"].argmax()), int(efforts.units["AU12_l"].argmax())
    (2, 2)
    """
    plans = cue_plans(cues, fps, checked_drive(drive), contractions, liveliness)
    return _efforts(face, plans, len(strengths(cues, fps=fps)), progress)


def unit_names() -> tuple[str, ...]:
    """The action units of the natural drive, as in `Efforts.units`.

    Examples
    --------
    >>> "AU12_l" in api.unit_names()
    True
    """
    return natural().data.unit_names


def explaining_units(faps: ArrayLike) -> dict[str, Floats]:
    """Action unit -> (T,) amount, of the mixtures of units that explain FAPs (T, 68) without knowing of an emotion.

    Examples
    --------
    >>> joy = api.expression("joy")
    >>> pose = api.default_face().pose(joy.frame(), emotion=joy.weights)
    >>> units = api.explaining_units([pose.achieved])
    >>> bool(units["AU12_l"] > 0.2)
    True
    """
    plans = [natural().plan(Request(each, Drive.NATURAL, Feeling({}))) for each in checked_stream(faps)]
    return _columns([plan.units for plan in plans], unit_names())


def wanted_at_apexes(cues: Iterable[Cue], drive: str | Drive = Drive.NATURAL) -> Floats:
    """(k, 68) FAPs that each cue asks for at its peak, FAP units; NaN where silent or its emotion is against it.

    Joy that squints is not asked for the wide eyes of a profile of Table 5: the natural drive shows the squint.
    """
    cues = list(cues)
    plans = apex_plans(cues, checked_drive(drive))
    return np.stack([cue.peak * plan.wanted for cue, plan in zip(cues, plans, strict=True)])


def _efforts(face: Face, plans: Iterable[Plan], count: int, progress: Report | None) -> Efforts:
    """What plans, one for each step, take of a face, one step after another."""
    anatomy, balance = face.anatomy, face.poser.balance
    found: list[Effort] = []
    contractions: list[Mapping[str, float]] = []
    for plan in plans:
        effort = balance.effort(plan, before=found[-1] if found else None)
        contractions.append(anatomy.actuators.contractions(effort.amounts))
        found.append(effort)
        if progress is not None:
            progress(Progress.counted(len(found), count, "steps of muscles found"))
    is_natural = found[0].plan.request.drive is Drive.NATURAL
    units = _columns([each.plan.units for each in found], unit_names())
    jaws = [each.amounts.jaw for each in found]
    return Efforts(
        asked=np.stack([each.plan.request.faps for each in found]),
        goals=np.stack([each.plan.goal for each in found]),
        contractions=_columns(contractions, tuple(contractions[0])),
        units=units if is_natural else {name: np.full(len(found), np.nan) for name in units},
        jaw=np.array([(jaw.angle, face.scale * jaw.left, face.scale * jaw.forward) for jaw in jaws]),
    )


def _columns(rows: Sequence[Mapping[str, float]], names: Sequence[str]) -> dict[str, Floats]:
    """Name -> (T,) of figures named in each row; 0 where a row does not name it."""
    return {name: np.array([row.get(name, 0.0) for row in rows]) for name in names}
