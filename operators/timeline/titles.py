"""What a clip is called."""

from __future__ import annotations

from typing import Any

from ..emotion.profile import title_of


def clip_title(clip: Any) -> str:
    """The name the user gave, or the emotion's."""
    return str(clip.name).strip() or title_of(clip.emotion)
