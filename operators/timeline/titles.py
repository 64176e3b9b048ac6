"""What a clip is called."""

from __future__ import annotations

from ..emotion.profile import title_of
from .props import RISORIUS_PG_clip


def clip_title(clip: RISORIUS_PG_clip) -> str:
    """The name the user gave, or the emotion's."""
    return str(clip.name).strip() or title_of(clip.emotion)
