"""Values of a rig's controls where these do not simply add up: solved, looked at, and solved again for what is left."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Floats
from ...progress import Progress, Work, part_of
from .rig import Rig

if TYPE_CHECKING:
    from ...api import Retargeted, Retargeting, Take

#: So often a rig is looked at, and at so many frames of a motion.
ROUNDS, FRAMES = 5, 40
#: Rounds end when one brings less than this share.
GAIN = 0.02


def frames_to_look_at(rig: Rig, count: int) -> Sequence[int]:
    """The frames at which what a rig shows is compared with a motion of `count` frames; none where controls add up."""
    if rig.evaluate is None:
        return ()
    return sorted({round(float(frame)) for frame in np.linspace(0, count - 1, FRAMES)})


def settled_values(
    rig: Rig,
    retargeting: Retargeting,
    take: Take,
    *,
    fps: float = 25.0,
    requested: ArrayLike | None = None,
    smooth: float = 1.0,
) -> Work[Retargeted]:
    """The values for a motion that come nearest to it as the rig shows them."""
    yield Progress(0.0, "Relating the motion to the controls")
    found = retargeting.values(take, fps=fps, requested=requested, smooth=smooth)
    if rig.evaluate is None:
        return found
    best, values, worse = None, found.values, False
    for number in range(ROUNDS):
        shown = yield from part_of(_shown(rig, found, values, take.kept), number / ROUNDS, (number + 1) / ROUNDS)
        beyond = take.beyond(shown - retargeting.controls.displacement(values[list(take.kept)]))
        told = retargeting.told(take, values, requested=requested, beyond=beyond)
        if best is None or retargeting.distance(told) < retargeting.distance(best):
            gained = best is None or retargeting.distance(told) < (1.0 - GAIN) * retargeting.distance(best)
            best, worse = told, False
            if not gained:
                break
            values = retargeting.values(take, fps=fps, requested=requested, smooth=smooth, beyond=beyond).values
        elif worse:
            break
        else:
            values, worse = (values + best.values) / 2.0, True
    assert best is not None
    return best


def _shown(rig: Rig, found: Retargeted, values: Floats, frames: Sequence[int]) -> Work[Floats]:
    """(n, V, 3) what a rig shows at some frames with its controls at values (T, K)."""
    assert rig.evaluate is not None
    moved = rig.channel_values(found.names, values)
    return (
        yield from rig.evaluate([{channel: float(own[frame]) for channel, own in moved.items()} for frame in frames])
    )
