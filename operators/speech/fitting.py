"""A strip's sound as long as what is said in it, with its pitch."""

from __future__ import annotations

from pathlib import Path

import bpy

from ...errors import FormatError
from ...files import read_bytes
from ...scene.blender_types import Scene, Sound
from ...scene.sounds import add_again, add_wav, remove_sound
from ...speech.stretching import stretched
from ...speech.waves import read_wav, wav_of
from ..blender_types import Scene as SceneWithChoices
from .sharing import part_sound
from .strip_props import RISORIUS_PG_speech_strip, edited
from .strips import title_of_strip


def fit_sound(scene: Scene | SceneWithChoices, strip: RISORIUS_PG_speech_strip) -> None:
    """Put a strip's sound on the sequencer anew, stretched as the strip is.

    Raises
    ------
    FormatError : its file is missing or cannot be read; what is on the sequencer stays then.
    """
    sound = strip.sound
    if sound is None:
        return
    part_sound(strip)
    amount = round(float(strip.stretch), 4)
    if amount == 1.0:
        if sound.packed_file is None and not Path(bpy.path.abspath(sound.filepath)).is_file():
            raise FormatError(bpy.path.abspath(sound.filepath), "does not exist: check the path of the sound")
        remove_sound(bpy.data.scenes, strip.tag)
        add_again(scene, sound, frame=strip.start, tag=strip.tag)
    else:
        samples, rate = read_wav(_bytes_of(sound), Path(bpy.path.abspath(sound.filepath)))
        wav = wav_of(stretched(samples, rate, amount), rate)
        remove_sound(bpy.data.scenes, strip.tag)
        add_wav(scene, wav, f"{title_of_strip(strip)} {amount:g}", frame=strip.start, tag=strip.tag)
    strip.fitted = strip.stretch
    edited(strip)


def _bytes_of(sound: Sound) -> bytes:
    """A sound's file, be it in the .blend."""
    if sound.packed_file is not None:
        return bytes(sound.packed_file.data)
    return read_bytes(Path(bpy.path.abspath(sound.filepath)))
