"""The Emotion panel as the editor of the selected clip: one choice in two places, kept alike while they are linked.

The drive is the face's, not a clip's: one motion is driven in one way.
"""

from __future__ import annotations

from contextlib import ExitStack

from ..blender_classes import PropertyGroup
from ..blender_types import Object
from ..changes import changed, follow
from ..emotion.props import RISORIUS_PG_emotion
from .props import RISORIUS_PG_clip, active_clip

#: Set first, for it brings its own place and strength; set last, for the others may switch it.
_FIRST, _LAST, _OF_THE_FACE = "word", "by", ("drive",)

_copying = False


def copy_choice(source: RISORIUS_PG_emotion, target: RISORIUS_PG_emotion) -> None:
    """Copy a chosen emotion from one group to another, without following what that changes in turn."""
    global _copying
    if _copying:
        return
    names = [p.identifier for p in source.bl_rna.properties if not p.is_readonly and p.identifier != "name"]
    between = [name for name in names if name not in (_FIRST, _LAST, *_OF_THE_FACE)]
    _copying = True
    try:
        for name in (_FIRST, *between, _LAST):
            if getattr(target, name) != getattr(source, name):
                setattr(target, name, getattr(source, name))
    finally:
        _copying = False


def show_clip(obj: Object) -> None:
    """Load the selected clip into the Emotion panel, where they are linked, and let the face show it in full."""
    clip = linked_clip(obj)
    if clip is not None and not _copying:
        copy_choice(clip.emotion, obj.risorius.emotion)
        changed(obj.risorius.emotion)


def linked_clip(obj: Object) -> RISORIUS_PG_clip | None:
    """The clip that the Emotion panel edits now, or None."""
    timeline = obj.risorius.timeline
    return active_clip(timeline) if timeline.linked else None


def _follow(owner: PropertyGroup) -> None:
    """What has been chosen in the panel goes to the clip, and the other way round."""
    obj = owner.id_data
    clip = linked_clip(obj) if hasattr(obj, "risorius") else None
    if clip is None:
        return
    panel = obj.risorius.emotion
    if owner == panel:
        copy_choice(panel, clip.emotion)
    elif owner == clip.emotion:
        copy_choice(clip.emotion, panel)


def attach(undo: ExitStack) -> None:
    """Keep them alike until undone."""
    follow(_follow, undo)
