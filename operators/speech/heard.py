"""What is chosen in the panel, as it is said: a text in its voice, or timings with their sound."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import bpy

from ...errors import FormatError
from ...speech.utterance import Utterance
from .props import RISORIUS_PG_speech
from .strips import shortened


@dataclass(frozen=True, eq=False)
class Heard:
    """What is said when, and its sound: a file, or the bytes of a WAV file."""

    title: str
    utterance: Utterance
    file: Path | None = None
    wav: bytes | None = None


def nothing_said(chosen: RISORIUS_PG_speech) -> str | None:
    """Why nothing can be said, or None."""
    if chosen.source == "TEXT":
        return None if chosen.text.strip() else "Nothing is said yet: write a text"
    return None if chosen.timings else "Nothing is said yet: choose a file of timings"


def heard(chosen: RISORIUS_PG_speech) -> Heard:
    """What is chosen, spoken or read.

    Raises
    ------
    RisoriusError : it cannot be said.
    """
    from ... import api

    title = title_of(chosen)
    if chosen.source == "TEXT":
        voiced = api.speak(chosen.text, voice=chosen.voice, speed=int(chosen.speed), pitch=int(chosen.pitch))
        return Heard(title, voiced.utterance, wav=voiced.wav())
    sound = Path(bpy.path.abspath(chosen.sound)) if chosen.sound else None
    if sound is not None and not sound.is_file():
        raise FormatError(sound, "does not exist: check the path of the sound")
    path = bpy.path.abspath(chosen.timings)
    return Heard(title, api.read_timings(path, tier=chosen.tier.strip() or None), file=sound)


def title_of(chosen: RISORIUS_PG_speech) -> str:
    """A name by what is said."""
    return Path(bpy.path.abspath(chosen.timings)).stem if chosen.source != "TEXT" else shortened(chosen.text)
