"""What a bake notes on its action: of what kind it is, of which settings, and where in it expressions begin.

The notes tell later whether a baked clip still is what its settings say.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from ..blender_types import Action
from .action import own_actions
from .tracks import CLIP_TAG

KIND_TAG, SETTINGS_TAG, ONTO_TAG = "risorius_kind", "risorius_settings", "risorius_onto"


class BakeKind(StrEnum):
    """How a clip was baked: an expression with few keyframes, a simulated motion, or a strip of a timeline."""

    EXPRESSION = "expression"
    MOTION = "motion"
    STRIP = "strip"


@dataclass(frozen=True)
class Note:
    """What is noted.

    Attributes
    ----------
    kind : how it was baked. settings : a digest of all that it was baked from.
    markers : names and frames of what begins in it; they become the action's pose markers.
    onto : which of the character's own controls it went to ("keys", "bones"), or "" for new shape keys.
    """

    kind: BakeKind
    settings: str
    markers: tuple[tuple[str, float], ...] = ()
    onto: str = ""


def write_note(action: Action, note: Note) -> None:
    """Note it on an action, in place of what was noted."""
    action[KIND_TAG], action[SETTINGS_TAG], action[ONTO_TAG] = note.kind.value, note.settings, note.onto
    for marker in list(action.pose_markers):
        action.pose_markers.remove(marker)
    for name, frame in note.markers:
        action.pose_markers.new(name).frame = round(frame)


def read_notes(face: str) -> Mapping[str, Note]:
    """Clip -> what its bake has noted, of all clips of a face that have notes."""
    notes = {str(action[CLIP_TAG]): note_of(action) for action in own_actions(face)}
    return {clip: note for clip, note in notes.items() if note is not None}


def note_of(action: Action) -> Note | None:
    """What a bake has noted on an action, or None."""
    kind = str(action.get(KIND_TAG))
    if kind not in list(BakeKind):
        return None
    markers = tuple((str(marker.name), float(marker.frame)) for marker in action.pose_markers)
    return Note(BakeKind(kind), str(action.get(SETTINGS_TAG, "")), markers, str(action.get(ONTO_TAG, "")))
