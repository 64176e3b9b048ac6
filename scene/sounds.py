"""Sound on a scene's timeline."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

import bpy

from ..errors import FormatError
from ..files import scratch_folder
from .blender_types import Scene, SequencerStrip, SequenceStrips, Sound

#: The channel of the sequencer that sound goes to where it is free.
CHANNEL = 2
#: What marks a strip of the sequencer as the sound of something said.
TAG = "risorius_speech"
#: A strip's times by their names in later Blenders, and their names before, which Blender 6.0 takes away.
EARLIER = {
    "content_start": "frame_start",
    "left_handle": "frame_final_start",
    "duration": "frame_final_duration",
    "left_handle_offset": "frame_offset_start",
    "right_handle_offset": "frame_offset_end",
}


def add_sound(scene: Scene, path: str | Path, *, frame: int, packed: bool = False, tag: str = "") -> SequencerStrip:
    """Put a sound file on a scene's timeline, from a frame on, on the first channel that is free there.

    `packed`: into the .blend, so that it needs the file no more. `tag`: by which the strip is found again.

    Raises
    ------
    FormatError : it is not there, or Blender cannot play it.
    """
    file = Path(path)
    if not file.is_file():
        raise FormatError(file, "does not exist: check the path of the sound")
    strips = _strips(scene)
    used = {strip.channel for strip in strips}
    channel = next(number for number in range(CHANNEL, CHANNEL + len(used) + 1) if number not in used)
    try:
        strip = strips.new_sound(file.stem, str(file.resolve()), channel, frame)
    except RuntimeError as error:
        raise FormatError(file, f"is no sound that this Blender can play: {error}") from error
    if frames_heard(strip) <= 1:
        strips.remove(strip)
        raise FormatError(file, "is no sound that this Blender can play: convert it to WAV")
    if packed:
        strip.sound.pack()
    if tag:
        strip[TAG] = tag
    return strip


def add_wav(scene: Scene, wav: bytes, name: str, *, frame: int, tag: str = "") -> SequencerStrip:
    """The same of a WAV file's bytes, which go into the .blend."""
    safe = "".join(letter if letter.isalnum() or letter in " -.'" else "_" for letter in name).strip() or "speech"
    with scratch_folder() as folder:
        path = folder / f"{safe}.wav"
        path.write_bytes(wav)
        return add_sound(scene, path, frame=frame, packed=True, tag=tag)


def add_again(scene: Scene, sound: Sound, *, frame: int, tag: str = "") -> SequencerStrip:
    """The same of a sound that the .blend knows already.

    Raises
    ------
    FormatError : its file is missing.
    """
    if sound.packed_file is None:
        strip = add_sound(scene, bpy.path.abspath(sound.filepath), frame=frame, tag=tag)
    else:
        strip = add_wav(scene, bytes(sound.packed_file.data), sound.name.removesuffix(".wav"), frame=frame, tag=tag)
    made, strip.sound = strip.sound, sound
    if made != sound and not made.users:
        bpy.data.sounds.remove(made)
    return strip


def is_missing(sound: Sound | None) -> bool:
    """Whether a sound's file is neither in the .blend nor where it was."""
    return sound is not None and sound.packed_file is None and not Path(bpy.path.abspath(sound.filepath)).is_file()


def move_sound(scenes: Iterable[Scene], tag: str, frame: int) -> None:
    """Let the strips of a tag start at another frame."""
    for _, strip in tagged(scenes, tag):
        setattr(strip, _time(strip, "content_start"), frame)


def mute_sound(scenes: Iterable[Scene], tag: str, *, mute: bool) -> None:
    """Let the strips of a tag be heard or not."""
    for _, strip in tagged(scenes, tag):
        strip.mute = mute


def remove_sound(scenes: Iterable[Scene], tag: str) -> None:
    """Take the strips of a tag away, and sounds that nobody uses then."""
    for strips, strip in list(tagged(scenes, tag)):
        sound = strip.sound
        strips.remove(strip)
        if sound is not None and not sound.users:
            bpy.data.sounds.remove(sound)


def tagged(scenes: Iterable[Scene], tag: str) -> Iterator[tuple[SequenceStrips, SequencerStrip]]:
    """The strips of a tag, with the sequencer's strips that they are among."""
    for scene in scenes:
        if tag and scene.sequence_editor is not None:
            strips = _strips(scene)
            for strip in strips:
                if strip.type == "SOUND" and strip.get(TAG) == tag:
                    yield strips, strip


def marked(scene: Scene) -> Iterator[tuple[str, SequencerStrip]]:
    """All sounds of something said on a scene's sequencer, with their tags."""
    if scene.sequence_editor is not None:
        for strip in _strips(scene):
            if strip.type == "SOUND" and (tag := strip.get(TAG)):
                yield str(tag), strip


def copy_sound(scene: Scene, strip: SequencerStrip, *, tag: str) -> SequencerStrip:
    """A strip like another one, at the same frames and as loud, with another tag.

    Raises
    ------
    FormatError : its file is missing.
    """
    copy = add_again(scene, strip.sound, frame=round(start_of(strip)), tag=tag)
    cut = [_time(strip, name) for name in ("left_handle_offset", "right_handle_offset")]
    for name in ("name", *cut, "volume", "pan", "mute", _time(strip, "content_start")):
        setattr(copy, name, getattr(strip, name))
    return copy


def start_of(strip: SequencerStrip) -> float:
    """The frame at which a strip's sound begins, though it may be cut there."""
    return float(getattr(strip, _time(strip, "content_start")))


def first_heard(strip: SequencerStrip) -> int:
    """The first frame at which a strip is heard."""
    return int(getattr(strip, _time(strip, "left_handle")))


def frames_heard(strip: SequencerStrip) -> int:
    """How many frames a strip is heard for."""
    return int(getattr(strip, _time(strip, "duration")))


def _time(strip: SequencerStrip, name: str) -> str:
    """What this Blender calls one of a strip's times."""
    return name if hasattr(strip, name) else EARLIER[name]


def scrub_along(scene: Scene) -> tuple[str, ...]:
    """Let sound be heard while the timeline is scrubbed and played; what was changed for that, in words."""
    said = []
    if not scene.use_audio_scrub:
        scene.use_audio_scrub = True
        said.append("Turned on Audio Scrubbing, to hear the sound at each frame")
    if scene.sync_mode != "AUDIO_SYNC":
        scene.sync_mode = "AUDIO_SYNC"
        said.append("Set Sync to Sync to Audio, to play in time with it")
    return tuple(said)


def _strips(scene: Scene) -> SequenceStrips:
    """The strips of a scene's sequencer, which is made if need be."""
    editor = scene.sequence_editor or scene.sequence_editor_create()
    return editor.strips if hasattr(editor, "strips") else editor.sequences
