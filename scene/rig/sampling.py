"""What moving a channel does to a face: each is moved a little, both ways, and the mesh is looked at.

Which bones move the face at all is found first, many at once, halving those that do: a body has hundreds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from ...arrays import Floats
from ...progress import Progress, Work
from ..faces import FaceSource
from .channels import Channel
from .rig import Control, Evaluate
from .rig_copy import RigCopy, rig_copy

#: Moved by less than this a face does not move, metres of a life-size face.
STILL = 5e-5
#: A channel that moves no vertex by more than this in its whole range is not worth keying, metres of a life-size face.
WEAK = 3e-4
#: The two ways of a channel differ where one differs by more than this share from the other.
DIFFERENT = 0.25
#: Two channels of a bone do the same where the cosine between what they do is at least this.
SAME = 0.999
#: A control moves the whole head where bridge of the nose, ears and corners of the eyes go with this share of all.
WHOLE = 0.3
STEADY = ("3.7", "3.8", "3.11", "3.12", "9.12", "10.7", "10.8", "10.9", "10.10")


class Kind(Enum):
    """What a channel is of a bone."""

    LOCATION = "location"
    ROTATION = "rotation"
    SCALE = "scale"
    PROPERTY = "property"


#: How far a channel is moved, and how far it may go where nothing limits it: metres of a life-size face for locations,
#: radians, factors, a property's own numbers; and no farther than what moves a vertex by `REACH`.
STEP = {Kind.LOCATION: 4e-3, Kind.ROTATION: 0.15, Kind.SCALE: 0.15, Kind.PROPERTY: 0.5}
LOW = {Kind.LOCATION: -0.03, Kind.ROTATION: -np.pi / 3.0, Kind.SCALE: -0.5, Kind.PROPERTY: -1.0}
HIGH = {Kind.LOCATION: 0.03, Kind.ROTATION: np.pi / 3.0, Kind.SCALE: 1.0, Kind.PROPERTY: 1.0}
REACH = 0.03


@dataclass(frozen=True)
class Candidate:
    """A channel that may do something; `unit` is its unit in metres of a life-size face. Its limits may be infinite."""

    channel: Channel
    kind: Kind
    unit: float = 1.0

    @property
    def steps(self) -> tuple[float, float]:
        """How far it is moved down and up, both positive, within its limits."""
        step = STEP[self.kind] / (self.unit if self.kind is Kind.LOCATION else 1.0)
        down, up = self.channel.resting - self.channel.low, self.channel.high - self.channel.resting
        if self.kind is Kind.PROPERTY:
            return down / 2.0 if np.isfinite(down) else step, up / 2.0 if np.isfinite(up) else step
        return min(step, down), min(step, up)

    def limited(self, rates: tuple[float, float]) -> Channel:
        """The channel within limits, where a value of 1 moves some vertex by `rates` metres, down and up."""
        size = self.unit if self.kind is Kind.LOCATION else 1.0
        rest = self.channel.resting
        ways = [
            min(bound / size, REACH / max(rate, 1e-12))
            for bound, rate in zip((-LOW[self.kind], HIGH[self.kind]), rates, strict=True)
        ]
        low = self.channel.low if np.isfinite(self.channel.low) else rest - ways[0]
        high = self.channel.high if np.isfinite(self.channel.high) else rest + ways[1]
        return replace(self.channel, low=low, high=high)


@dataclass(frozen=True, eq=False)
class Sampled:
    """Controls that move the face, what each does (K, V, 3), and the names of groups that move the whole head."""

    entries: tuple[Control, ...]
    effects: Floats
    whole: tuple[str, ...]


def sampled(copy: RigCopy, groups: Sequence[tuple[str, Sequence[Candidate]]], scale: float) -> Work[Sampled]:
    """Move all candidates, group by group; a group is a bone's, with its name.

    Parameters
    ----------
    scale : of the face; 1 is life-size.
    """
    steady = _steady(copy)
    moving = yield from _moving(copy, groups, scale)
    entries: list[Control] = []
    effects: list[Floats] = []
    whole: list[str] = []
    for number, (name, candidates) in enumerate(moving):
        yield Progress(0.2 + 0.8 * number / len(moving), f"Moving {name}")
        together = copy.displacement(_stirred(candidates))
        if _moves_all(together, steady):
            whole.append(name)
            continue
        first = len(effects)
        for candidate in candidates:
            for control, effect in _controls(copy, candidate, scale, effects[first:]):
                entries.append(control)
                effects.append(effect)
            yield Progress(0.2 + 0.8 * number / len(moving), f"Moving {name}")
    return Sampled(tuple(entries), np.array(effects).reshape(-1, *copy.source.vertices.shape), tuple(whole))


def evaluation(source: FaceSource) -> Evaluate:
    """Shows what a face's rig does with channels at values, frame by frame."""

    def evaluated(frames: Sequence[Mapping[Channel, float]]) -> Work[Floats]:
        shown = np.zeros((len(frames), *source.vertices.shape))
        with rig_copy(source) as copy:
            for number, values in enumerate(frames):
                yield Progress(number / len(frames), "Looking at what the controls show")
                shown[number] = copy.displacement(values)
        return shown

    return evaluated


def _steady(copy: RigCopy) -> Sequence[int]:
    """Vertices of the head that go where the skull goes."""
    points, head = copy.source.points, copy.source.pieces[0].metric
    places = [points[name] for name in STEADY if name in points]
    return [p if isinstance(p, int) else int(((head - p) ** 2).sum(axis=1).argmin()) for p in places]


def _moves_all(moved: Floats, steady: Sequence[int]) -> bool:
    """Whether a displacement (V, 3) is one of the whole head."""
    length = np.linalg.norm(moved, axis=1)
    return len(steady) > 0 and float(np.median(length[list(steady)])) > WHOLE * float(length.max(initial=0.0))


def _stirred(candidates: Sequence[Candidate]) -> dict[Channel, float]:
    """All of some channels moved, each as far as it may."""
    moved = {}
    for candidate in candidates:
        down, up = candidate.steps
        moved[candidate.channel] = up if up >= down else -down
    return moved


def _moving(
    copy: RigCopy, groups: Sequence[tuple[str, Sequence[Candidate]]], scale: float
) -> Work[list[tuple[str, Sequence[Candidate]]]]:
    """The groups that move the face, found by halving."""
    found: list[tuple[str, Sequence[Candidate]]] = []
    waiting = [[group for group in groups if group[1]]]
    count = max(len(waiting[0]), 1)
    while waiting:
        some = waiting.pop()
        yield Progress(0.2 * (1.0 - sum(map(len, waiting), len(some)) / count), "Looking for controls of the face")
        if not some:
            continue
        stirred = _stirred([candidate for _, candidates in some for candidate in candidates])
        if np.abs(copy.displacement(stirred)).max(initial=0.0) <= STILL * scale:
            continue
        if len(some) == 1:
            found += some
            continue
        half = len(some) // 2
        waiting += [some[half:], some[:half]]
    return found


def _controls(
    copy: RigCopy, candidate: Candidate, scale: float, before: Sequence[Floats]
) -> list[tuple[Control, Floats]]:
    """A channel as one control or, where its two ways do different things, two; what each does at value 1.

    None where it does nothing, or what another channel of its bone, with one of the effects `before`, does already.
    """
    down, up = candidate.steps
    channel = candidate.channel
    rising = copy.displacement({channel: up}) / up if up > 0.0 else None
    if rising is not None and any(_alike(rising, other) for other in before):
        return []
    falling = copy.displacement({channel: -down}) / -down if down > 0.0 else None
    sizes = [0.0 if way is None else float(np.linalg.norm(way, axis=1).max(initial=0.0)) for way in (falling, rising)]
    limited = candidate.limited((sizes[0] / scale, sizes[1] / scale))
    reach = max((limited.resting - limited.low) * sizes[0], (limited.high - limited.resting) * sizes[1])
    if reach <= WEAK * scale:
        return []
    if rising is None or falling is None:
        one = rising if rising is not None else falling
        assert one is not None
        return [(Control(limited), one)]
    if np.linalg.norm(rising - falling) > DIFFERENT * max(np.linalg.norm(rising), np.linalg.norm(falling)):
        return [(Control(limited, 1), rising), (Control(limited, -1), -falling)]
    return [(Control(limited), (rising + falling) / 2.0)]


def _alike(one: Floats, other: Floats) -> bool:
    """Whether two displacements (V, 3) are the same, or opposite, but for their size."""
    sizes = float(np.linalg.norm(one)) * float(np.linalg.norm(other))
    return abs(float((one * other).sum())) >= SAME * sizes
