"""Save what a version of Risorius leaves in files, to be opened by all later ones: tests/blender/files/VERSION/.

    .venv-bpy-4.2/bin/python tools/saved_file.py

Run once before a release, with the oldest Blender. saved.blend has expressions, clips, speech with its sound and
settings, recorded.blend a recording; what must be there when they are opened is in `kept.json` and in NAME.state.json.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import risorius
from places import ROOT
from risorius.mpeg4 import FapStream, expression, write_fap
from risorius.mpeg4.preset_file import write_preset
from risorius.operators.library.exchange import expression_of, timeline_of
from risorius.resources import version
from risorius.speech.waves import wav_of
from saved_state import saved_state

RATE = 16000
FOLDER = ROOT / "tests" / "blender" / "files"
#: Settings of an object that the file has other than by default, and what they are.
SETTINGS = {
    "emotion.word": "worried", "emotion.activation": 5.5, "emotion.seed": 7, "emotion.drive": "exact",
    "bake.clip": "mine", "bake.start": 11, "bake.onset": 0.25, "bake.apex": 0.75, "bake.offset": 0.5,
    "bake.smooth": 0.125, "speech.text": "Bonjour", "speech.lean": 0.5, "speech.jaw": 1.25, "speech.articulation": 0.75,
    "tissue.thickness": 2.5, "tissue.depth": 7.5, "timeline.linked": False,
}  # fmt: skip


def main() -> int:
    """Make the files."""
    folder = FOLDER / version()
    folder.mkdir(parents=True, exist_ok=True)
    risorius.register()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    head = small_head()
    own = head.shape_key_add(name="Basis") and head.shape_key_add(name="My Key")
    own.data[5].co.x += 0.001
    head["mine"] = 3
    head.risorius.emotion.word = "joy"
    bpy.ops.risorius.bake_expression()
    for word, start in (("fear", 1), ("sadness", 40)):
        head.risorius.emotion.word = word
        bpy.ops.risorius.add_clip()
        head.risorius.timeline.clips[-1].start = start
    clip = head.risorius.timeline.clips[-1]
    clip.peak, clip.mute, clip.name = 0.5, True, "the sad one"
    for place, value in SETTINGS.items():
        room, _, name = place.partition(".")
        setattr(getattr(head.risorius, room), name, value)
    add_speech(head, folder)
    write_preset(folder / "timeline.toml", timeline_of(head, bpy.context.scene))
    write_preset(folder / "expression.toml", expression_of(head))
    write_fap(folder / "stream.fap", FapStream(np.round(expression("joy").frame())[None], fps=25.0, name="kept"))
    (folder / "kept.json").write_text(json.dumps(kept(head), indent=1) + "\n", encoding="utf-8")
    save(folder / "saved.blend")
    add_recording(folder)
    save(folder / "recorded.blend")
    return 0


def save(path: Path) -> None:
    """The open file, and what it holds."""
    state = json.dumps(saved_state(), indent=1, ensure_ascii=False)
    path.with_suffix(".state.json").write_text(state + "\n", encoding="utf-8")
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)


def add_speech(head: Any, folder: Path) -> None:
    """A strip of speech of two words, with a sound that is in the .blend."""
    timings, sound = folder / "line.csv", folder / "line.wav"
    timings.write_text(
        "start,end,phoneme,word\n0.0,0.2,m,me\n0.2,0.5,i,me\n0.5,0.7,t,too\n0.7,1.0,u,too\n", encoding="utf-8"
    )
    tone = 0.3 * np.sin(2.0 * np.pi * 200.0 * np.arange(RATE) / RATE)
    sound.write_bytes(wav_of(tone[:, None], RATE))
    chosen = head.risorius.speech
    chosen.source, chosen.timings, chosen.sound = "TIMINGS", str(timings), str(sound)
    bpy.context.scene.frame_set(21)
    bpy.ops.risorius.add_speech()
    chosen.strips[0].stretch = 1.5
    for each in bpy.data.sounds:
        each.pack()
    chosen.source, chosen.timings, chosen.sound = "TEXT", "", ""
    sound.unlink()


def add_recording(folder: Path) -> None:
    """Another file: a recording of a tracker on a head, and six engine shape keys."""
    take = folder / "take.csv"
    rows = [f"{index / 30:.4f},{min(index, 10) / 10:.2f},{index % 7 / 10:.2f}" for index in range(31)]
    take.write_text("\n".join(["time,jawOpen,mouthSmileLeft", *rows]) + "\n", encoding="utf-8")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    head = small_head()
    head.name = "Recorded"
    bpy.context.scene.frame_set(5)
    bpy.ops.risorius.import_fap(filepath=str(take))


def small_head() -> Any:
    """The default head with a fifth of its vertices, so that the file stays small, and its points."""
    bpy.ops.risorius.add_head()
    head = bpy.context.object
    bpy.ops.risorius.forget_points()
    head.modifiers.new("Fewer", "DECIMATE").ratio = 0.2
    bpy.ops.object.modifier_apply(modifier="Fewer")
    bpy.ops.risorius.find_points()
    return head


def kept(head: Any) -> dict[str, Any]:
    """What must be there."""
    keys, action = head.data.shape_keys, head.data.shape_keys.animation_data.action
    moved = np.zeros(3 * len(head.data.vertices))
    keys.key_blocks["joy"].data.foreach_get("co", moved)
    rest = np.zeros_like(moved)
    keys.key_blocks["Basis"].data.foreach_get("co", rest)
    return {
        "settings": {place: plain(value_of(head, place)) for place in SETTINGS},
        "clips": [
            {name: plain(getattr(clip, name)) for name in ("name", "start", "onset", "apex", "offset", "peak", "mute")}
            | {"word": clip.emotion.word}
            for clip in head.risorius.timeline.clips
        ],
        "keys": [block.name for block in keys.key_blocks],
        "action": action.name,
        "frames": list(action.frame_range),
        "joy": {"sum": float(np.abs(moved - rest).sum()), "most": float(np.abs(moved - rest).max())},
        "points": len(json.loads(head.data["risorius_points"])["points"]) if "risorius_points" in head.data else None,
        "mine": head["mine"],
    }


def value_of(head: Any, place: str) -> Any:
    """A setting by its place."""
    room, _, name = place.partition(".")
    return getattr(getattr(head.risorius, room), name)


def plain(value: Any) -> Any:
    """A value as JSON has it."""
    return round(value, 6) if isinstance(value, float) else value


if __name__ == "__main__":
    sys.exit(main())
