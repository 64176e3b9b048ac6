"""What is kept with a clip on a rig, on its actions: what its bake has noted, and how far the rig follows."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

from ...tables import is_number, parsed_json
from ..bake.notes import Note, note_of
from ..blender_types import Action, Object
from .clips import rig_clips

if TYPE_CHECKING:
    from ...api import Retargeted

#: A property of an action: how far the rig follows, as JSON.
FOLLOWED = "risorius_rig_followed"


@dataclass(frozen=True)
class Followed:
    """How far the controls of a rig follow a clip.

    Attributes
    ----------
    explained : share of the motion of the outer skin that shows.
    off : root mean square over that skin of the distance from the motion where most moves, metres.
    carriers : names of the controls that most of it goes through.
    missing : names of FAPs that show too little, or do not show.
    """

    explained: float
    off: float
    carriers: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()

    @classmethod
    def of(cls, found: Retargeted) -> Followed:
        """In short."""
        from ... import api

        missing = dict.fromkeys([*(short.number for short in found.missing), *found.unmet])
        names = tuple(api.fap(number).name for number in missing)
        return cls(found.explained, found.off_at_peak, tuple(found.carriers), names)

    @property
    def line(self) -> str:
        """Share and millimetres."""
        return f"{self.explained:.0%}, {1000.0 * self.off:.1f} mm off"


@dataclass(frozen=True)
class KeptClip:
    """A clip on a rig: its actions, first and last frame, how far the rig follows, and what was noted."""

    actions: tuple[Action, ...]
    frames: tuple[float, float]
    followed: Followed | None = None
    note: Note | None = None


def keep(actions: Sequence[Action], followed: Followed) -> None:
    """Keep on the actions of a clip how far the rig follows."""
    for action in actions:
        action[FOLLOWED] = json.dumps(asdict(followed))


def kept_clips(head: Object) -> Mapping[str, KeptClip]:
    """Clip -> what is kept of it, of all clips on the rig of a head, by their first frame."""
    found = {clip: _kept(actions) for clip, actions in rig_clips(head).items()}
    return dict(sorted(found.items(), key=lambda entry: entry[1].frames))


def _kept(actions: Sequence[Action]) -> KeptClip:
    """What is kept of one clip."""
    frames = min(float(a.frame_start) for a in actions), max(float(a.frame_end) for a in actions)
    return KeptClip(tuple(actions), frames, _followed(actions[0]), note_of(actions[0]))


def _followed(action: Action) -> Followed | None:
    """How far the rig follows; None where nobody has kept it."""
    try:
        stored = parsed_json(str(action.get(FOLLOWED, "")))
        carriers, missing = (tuple(str(name) for name in stored[what]) for what in ("carriers", "missing"))
        explained, off = float(stored["explained"]), float(stored["off"])
        return Followed(explained, off, carriers, missing) if is_number(explained) and is_number(off) else None
    except (ValueError, KeyError, TypeError, OverflowError):
        return None
