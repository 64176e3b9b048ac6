"""A take of a minute at 60 frames per second onto shape keys: how long it takes, how smooth it is, what fights."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import risorius.api as api
from risorius.api import Retargeting
from risorius.arrays import Floats
from risorius.face.retarget.fights import opposed_pairs

from .heads import KeyedHead
from .measuring import ON, WORDS, cosines, plain_values

SECONDS, FPS = 60.0, 60.0
#: Every so many frames are also solved by themselves by plain bounded least squares.
PLAIN_EVERY = 60


@dataclass(frozen=True)
class Take:
    """What a take has shown.

    Attributes
    ----------
    muscles, seeing, solving : seconds of processor time for the motion of muscles and skin, for relating its frames to
        the keys, and for the keys' values.
    explained, plain : share of the skin's motion on the keys, and by plain least squares frame by frame.
    bends, own_bends : root mean square of second differences over time of the skin on the keys, and of the take's own,
        micrometres.
    jerks, own_jerks : the largest of these.
    share, own_share : second differences of the keys, each by what it does to the skin, as a share of how much they
        move; and those of the take's own skin.
    fights, plain_fights : mean number of pairs that pull against each other and are both on in a frame.
    """

    head: str
    frames: int
    muscles: float
    seeing: float
    solving: float
    explained: float
    plain: float
    bends: float
    own_bends: float
    jerks: float
    own_jerks: float
    share: float
    own_share: float
    fights: float
    plain_fights: float


def take_on(head: KeyedHead, seconds: float = SECONDS) -> Take:
    """A minute of emotions, one after another, with blinks and small motions of head and eyes."""
    retargeting = Retargeting(head.face, head.keys)
    take, skin, plain = retargeting.take(), [], []
    spent = {"muscles": 0.0, "seeing": 0.0}
    rest = retargeting.face.anatomy.mesh.positions
    frames = head.face.performance(cues(seconds), FPS, liveliness=api.Liveliness())
    for number in range(round(seconds * FPS)):
        start = time.process_time()
        positions = next(frames)
        middle = time.process_time()
        take.add(positions)
        spent["muscles"] += middle - start
        spent["seeing"] += time.process_time() - middle
        still = retargeting.face.anatomy.head_turn.undo(retargeting.frame.to_head(positions), rest)[0]
        skin.append(retargeting.sight.of_skin(still - rest).astype(np.float32))
        if number % PLAIN_EVERY == 0:
            plain.append(plain_values(retargeting, positions))
    start = time.process_time()
    found = retargeting.values(take, fps=FPS, requested=np.stack([cue.profile.frame() for cue in cues(seconds)]))
    spent["solving"] = time.process_time() - start
    return _figures(head, retargeting, found, np.array(skin), np.array(plain), spent)


def cues(seconds: float) -> Sequence[api.Cue]:
    """One emotion after another, each before the last has gone."""
    count = round(seconds / 2.0)
    return [
        api.Cue(api.expression(WORDS[i % len(WORDS)]), start=2.0 * i, onset=0.5, apex=1.0, offset=0.8, seed=i)
        for i in range(count)
    ]


def _figures(
    head: KeyedHead,
    retargeting: Retargeting,
    found: api.Retargeted,
    skin: Floats,
    plain: Floats,
    spent: Mapping[str, float],
) -> Take:
    """What is told of a take: skin (T, 3n) of the muscles, values `found`, and plain ones of every few frames."""
    does, vertices = retargeting.does.skin.astype(np.float32), skin.shape[1] // 3
    shown = np.diff(found.values, 2, axis=0).astype(np.float32) @ does
    bends = np.sqrt((shown**2).sum(axis=1) / vertices)
    own = np.sqrt((np.diff(skin, 2, axis=0) ** 2).sum(axis=1) / vertices)
    some = skin[::PLAIN_EVERY]
    left = ((plain.astype(np.float32) @ does - some) ** 2).sum() / (some**2).sum()
    opposed = opposed_pairs(cosines(retargeting), retargeting.controls.low, retargeting.controls.high, {})
    return Take(
        head.name,
        len(skin),
        spent["muscles"],
        spent["seeing"],
        spent["solving"],
        found.explained,
        1.0 - float(left),
        1e6 * float(np.sqrt((bends**2).mean())),
        1e6 * float(np.sqrt((own**2).mean())),
        1e6 * float(bends.max()),
        1e6 * float(own.max()),
        _bending(found.values * np.linalg.norm(does, axis=1)),
        _bending(skin),
        _fighting(opposed, found.values),
        _fighting(opposed, plain),
    )


def _bending(moved: Floats) -> float:
    """Root mean square of second differences over time of (T, n), as a share of the spread over time."""
    spread = np.sqrt(((moved - moved.mean(axis=0)) ** 2).mean())
    return float(np.sqrt((np.diff(moved, 2, axis=0) ** 2).mean()) / spread)


def _fighting(opposed: Sequence[Sequence[tuple[int, int]]], values: Floats) -> float:
    """Mean number of pairs that are both on in a frame of values (T, K)."""
    pairs = [list(pair) for group in opposed for pair in group]
    return float(sum((values[:, pair].min(axis=1) > ON).mean() for pair in pairs))
