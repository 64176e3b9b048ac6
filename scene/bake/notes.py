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

KIND_TAG, SETTINGS_TAG = "risorius_kind", "risorius_settings"


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
    """

    kind: BakeKind
    settings: str
    markers: tuple[tuple[str, float], ...] = ()


def write_note(action: Action, note: Note) -> None:
    """Note it on an action, in place of what was noted."""
    action[KIND_TAG], action[SETTINGS_TAG] = note.kind.value, note.settings
    for marker in list(action.pose_markers):
        action.pose_markers.remove(marker)
    for name, frame in note.markers:
        action.pose_markers.new(name).frame = round(frame)


def read_notes(face: str) -> Mapping[str, Note]:
    """Clip -> what its bake has noted, of all clips of a face that have notes."""
    notes = {}
    for action in own_actions(face):
        kind = str(action.get(KIND_TAG))
        if kind in list(BakeKind):
            markers = tuple((str(marker.name), float(marker.frame)) for marker in action.pose_markers)
            notes[str(action[CLIP_TAG])] = Note(BakeKind(kind), str(action.get(SETTINGS_TAG, "")), markers)
    return notes
