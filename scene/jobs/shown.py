"""What a clip shows: expressions, a stream of FAPs, or speech, as a motion at the frame rate of a scene."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from ...arrays import Bools, Floats
from ...errors import ParameterError
from ...mpeg4 import ARCHETYPES, FAPS, Liveliness, Unit, bridged
from ..bake.motion import CueMotion, FapMotion, at_rate

if TYPE_CHECKING:
    from ...api import Cue, FapStream, Saying

#: The upper lids, of which a blink asks this much or more, in FAP units.
UPPER_LIDS, SHUT = (19, 20), 512.0
#: What a face shows: no turns, whose unit is small, no lids, and not FAPs 1 and 2, which stand for others.
EXPRESSIVE = [number - 1 for number, fap in FAPS.items() if fap.unit not in (None, Unit.AU) and not 19 <= number <= 22]


@dataclass(frozen=True, eq=False)
class Shown:
    """What is shown at a frame rate.

    Attributes
    ----------
    motion : what a bake simulates.
    frames : (T, 68) FAPs that are requested; NaN where silent.
    emotions : (T, 6) strength of each archetype.
    apex : frame, counted from 0, at which a still shows most.
    meant : the speech or the stream that it is.
    cue : the expression of a still that needs no motion; None: it is a frame of a motion.
    remarks : what was assumed.
    """

    motion: CueMotion | FapMotion
    frames: Floats
    emotions: Floats
    apex: int
    cue: Cue | None = None
    meant: Saying | FapStream | None = None
    remarks: tuple[str, ...] = ()

    @property
    def moves(self) -> bool:
        """Whether anything is requested at all: a neutral face rests."""
        return bool((np.nan_to_num(self.frames) != 0.0).any())


#: What is shown, when the frame rate is known.
ShownAt: TypeAlias = Callable[[float], Shown]


def expressions(cues: Sequence[Cue], *, liveliness: Liveliness, tissue: str, rest: float) -> ShownAt:
    """Expressions in time, and `rest` seconds of the neutral face after them; a still shows the first one's apex."""

    def shown(fps: float) -> Shown:
        from ... import api

        end = max(cue.start + cue.duration for cue in cues)
        calm = [api.Cue(api.expression("neutral"), start=end, onset=0.0, apex=rest, offset=0.0)] if rest > 0.0 else []
        all_of_it = [*cues, *calm]
        frames = api.sequence(all_of_it, fps=fps)
        overlay = liveliness.over(len(frames), fps)
        frames = overlay.upon_all(frames)
        first = cues[0]
        begin = first.start + first.onset
        apex = _open_eyed(int(np.floor(begin * fps)), int(np.floor((begin + first.apex) * fps)), overlay.closure == 0.0)
        motion = CueMotion(all_of_it, liveliness=liveliness, tissue=tissue)
        return Shown(motion, frames, api.emotion_weights(all_of_it, fps=fps), apex, first)

    return shown


def stream(read: FapStream) -> ShownAt:
    """A stream of FAPs; a still shows the frame in which most is requested."""

    def shown(fps: float) -> Shown:
        played = bridged(read.expanded(), read.fps)
        frames = at_rate(played.frames, read.fps, fps)
        if len(frames) == 0:
            raise ParameterError("frames", "must contain at least one frame", 0)
        return Shown(FapMotion(frames), frames, _unknown(len(frames)), _most(frames), meant=read, remarks=played.said)

    return shown


def speech(say: Callable[[float], Saying]) -> ShownAt:
    """Speech; a still shows the frame in which most is requested."""

    def shown(fps: float) -> Shown:
        saying = say(fps)
        frames = saying.stream.frames
        motion = FapMotion(frames, saying.emotions, planned=True)
        return Shown(motion, frames, saying.emotions, _most(frames), meant=saying, remarks=saying.assumed)

    return shown


def _open_eyed(begin: int, end: int, is_open: Bools) -> int:
    """The last frame of an apex without a blink; its last one where there is none."""
    end = min(end, len(is_open) - 1)
    found = np.flatnonzero(is_open[begin : end + 1])
    return begin + int(found[-1]) if len(found) else end


def _most(frames: Floats) -> int:
    """The frame in which most is requested of mouth, brows and cheeks, where there is one with open eyes."""
    asked = np.abs(np.nan_to_num(frames))
    shown = asked[:, EXPRESSIVE].sum(axis=1)
    is_open = (np.nan_to_num(frames)[:, [number - 1 for number in UPPER_LIDS]] < SHUT).all(axis=1)
    if not shown.any():
        return int(asked.sum(axis=1).argmax())
    return int(np.where(is_open | ~is_open.any(), shown, -1.0).argmax())


def _unknown(count: int) -> Floats:
    """(T, 6) strengths that nobody knows."""
    return np.full((count, len(ARCHETYPES)), np.nan)
