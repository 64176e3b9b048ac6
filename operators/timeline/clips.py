"""What the operators on clips share."""

from __future__ import annotations

from ..base import RisoriusOperator
from ..blender_types import Context
from .linked import copy_choice
from .props import RISORIUS_PG_clip, active_clip

#: What of a clip a timing preset says.
TIMES = ("onset", "apex", "offset", "peak", "ramp")


def copy_clip(source: RISORIUS_PG_clip, target: RISORIUS_PG_clip) -> None:
    """Copy a clip, all but its name."""
    copy_choice(source.emotion, target.emotion)
    for name in (*TIMES, "start", "mute", "solo"):
        setattr(target, name, getattr(source, name))


def end_of(clip: RISORIUS_PG_clip, fps: float) -> int:
    """The first frame at which a clip is over."""
    return int(clip.start + round((clip.onset + clip.apex + clip.offset) * fps))


class ClipOperator(RisoriusOperator):
    """What the operators on the active clip share."""

    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where a clip is selected."""
        if context.object is None:
            return "There is no active object"
        if active_clip(context.object.risorius.timeline) is None:
            return "The timeline has no clips yet: add one with +"
        return None
