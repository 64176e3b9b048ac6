"""The speech of a timeline that was saved as a preset."""

from __future__ import annotations

import re
from pathlib import Path

from ...errors import FormatError
from ...mpeg4.preset_file import read_preset
from ..kept import line_of_kept
from ..line import together
from ..utterance import Utterance


def is_preset(text: str) -> bool:
    """Whether a text is a preset of Risorius."""
    return re.search(r"^\s*risorius\s*=", text[:2000], flags=re.MULTILINE) is not None


def preset_utterance(path: Path) -> Utterance:
    """All that a preset's timeline says, from its beginning on; what is muted is left out.

    Raises
    ------
    FormatError : it is not a preset, or says nothing.
    """
    speech = [kept for kept in read_preset(path).speech if not kept.mute and kept.words]
    if not speech:
        raise FormatError(path, "says nothing: it needs speech that is not muted")
    clips = len(read_preset(path).clips)
    said = (f"clips of the timeline are left out ({clips}): only its speech is read",) if clips else ()
    return together([(kept.start, kept.stretch, line_of_kept(kept)) for kept in speech], said)
