"""Sound on a scene's timeline."""

from __future__ import annotations

from pathlib import Path

from ..errors import FormatError
from .blender_types import Scene

#: The channel of the sequencer that sound goes to where it is free.
CHANNEL = 2


def add_sound(scene: Scene, path: str | Path, *, frame: int, packed: bool = False) -> None:
    """Put a sound file on a scene's timeline, from a frame on, on the first channel that is free there.

    `packed`: into the .blend, so that it needs the file no more.

    Raises
    ------
    FormatError : it is not there, or Blender cannot play it.
    """
    file = Path(path)
    if not file.is_file():
        raise FormatError(file, "does not exist: check the path of the sound")
    editor = scene.sequence_editor or scene.sequence_editor_create()
    strips = editor.strips if hasattr(editor, "strips") else editor.sequences
    used = {strip.channel for strip in strips}
    channel = next(number for number in range(CHANNEL, CHANNEL + len(used) + 1) if number not in used)
    try:
        strip = strips.new_sound(file.stem, str(file.resolve()), channel, frame)
    except RuntimeError as error:
        raise FormatError(file, f"is no sound that this Blender can play: {error}") from error
    if strip.frame_final_duration <= 1:
        strips.remove(strip)
        raise FormatError(file, "is no sound that this Blender can play: convert it to WAV")
    if packed:
        strip.sound.pack()
