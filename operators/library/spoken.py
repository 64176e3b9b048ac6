"""Between speech on a timeline and what a preset file holds of it."""

from __future__ import annotations

from pathlib import Path

import bpy

from ...errors import RisoriusError
from ...files import write_whole
from ...mpeg4.preset_speech import KeptSpeech
from ...scene.bake.timing import scene_fps
from ...scene.blender_types import Sound as BlenderSound
from ...speech.kept import kept_words, line_of_kept
from ...speech.utterance import Utterance
from ..blender_types import Object, Scene
from ..speech.placing import place_strip
from ..speech.sharing import drop_sound
from ..speech.strip_props import RISORIUS_PG_speech_strip
from ..speech.strips import read_line, write_line


def kept_speech(strip: RISORIUS_PG_speech_strip, start: float, preset: Path | None, number: int) -> KeptSpeech:
    """A strip that begins at `start` seconds; a sound that has no file of its own is written beside the preset.

    Raises
    ------
    FormatError : it cannot be written.
    """
    sound = "" if strip.sound is None else _sound_path(strip.sound, preset, number)
    words = kept_words(read_line(strip))
    return KeptSpeech(start, words, strip.name, round(strip.stretch, 6), strip.mute, sound, strip.voice or "en")


def _sound_path(sound: BlenderSound, preset: Path | None, number: int) -> str:
    """Where a sound is, written beside the preset if it is only in the .blend."""
    if sound.packed_file is None:
        return str(Path(bpy.path.abspath(sound.filepath)).resolve())
    if preset is None:
        return ""
    path = preset.with_name(f"{preset.stem} {number}{Path(sound.filepath).suffix or '.wav'}")
    write_whole(path, bytes(sound.packed_file.data))
    return path.name


def lay_out_speech(speech: tuple[KeptSpeech, ...], obj: Object, scene: Scene, folder: Path) -> list[str]:
    """Put a preset's speech in place of what there is, from the current frame on; what could not be, in words."""
    held, said = obj.risorius.speech, list[str]()
    for strip in held.strips:
        drop_sound(strip)
    held.strips.clear()
    for kept in speech:
        start = scene.frame_current + round(kept.start * scene_fps(scene))
        sound = folder / kept.sound if kept.sound else None
        utterance = Utterance((), 0.0)
        try:
            strip, _ = place_strip(obj, scene, utterance, kept.name, start, file=sound)
        except RisoriusError as refusal:
            said.append(f"{kept.name}: without sound: {refusal}")
            strip, _ = place_strip(obj, scene, utterance, kept.name, start)
        write_line(strip, line_of_kept(kept))
        strip.stretch, strip.mute, strip.voice = kept.stretch, kept.mute, kept.voice
    held.active = 0
    return said
