"""A strip put on the timeline with its sound."""

from __future__ import annotations

import uuid
from pathlib import Path

from ...scene.blender_types import SequencerStrip
from ...scene.sounds import add_sound, add_wav
from ...speech.line import line_of
from ...speech.utterance import Utterance
from ..blender_types import Object, Scene
from .strip_props import RISORIUS_PG_speech_strip, edited, written_at_once
from .strips import write_line


def place_strip(
    obj: Object,
    scene: Scene,
    utterance: Utterance,
    title: str,
    start: int,
    *,
    file: Path | None = None,
    wav: bytes | None = None,
) -> tuple[RISORIUS_PG_speech_strip, SequencerStrip | None]:
    """A strip of a face, and its sound on the sequencer: a file, or the bytes of a WAV file.

    Raises
    ------
    FormatError : the sound cannot be played; nothing has been changed then.
    """
    speech, tag, sound = obj.risorius.speech, uuid.uuid4().hex, None
    if file is not None:
        sound = add_sound(scene, file, frame=start, tag=tag)
    elif wav is not None:
        sound = add_wav(scene, wav, title, frame=start, tag=tag)
    with written_at_once():
        strip = speech.strips.add()
        strip.name, strip.start, strip.tag, strip.voice = title, start, tag, speech.voice
        strip.sound = None if sound is None else sound.sound
        write_line(strip, line_of(utterance))
        speech.active = len(speech.strips) - 1
    edited(strip)
    return strip, sound
