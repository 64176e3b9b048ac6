"""Save what a version of Risorius leaves in files, to be opened by all later ones: tests/blender/files/VERSION/.

    .venv-bpy-4.2/bin/python tools/saved_file.py

Run once before a release, with the oldest Blender. `kept.json` lists what must be there when the file is opened.
"""

from __future__ import annotations

import json
import sys
import tomllib
from typing import Any

import bpy
import numpy as np
import risorius
from places import ROOT
from risorius.mpeg4 import FapStream, expression, write_fap
from risorius.mpeg4.preset_file import write_preset
from risorius.operators.library.exchange import expression_of, timeline_of

VERSION = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))["version"]
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
    folder = FOLDER / VERSION
    folder.mkdir(parents=True, exist_ok=True)
    risorius.register()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.risorius.add_head()
    head = bpy.context.object
    bpy.ops.risorius.forget_points()
    head.modifiers.new("Fewer", "DECIMATE").ratio = 0.2  # so that the file stays small
    bpy.ops.object.modifier_apply(modifier="Fewer")
    bpy.ops.risorius.find_points()
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
    write_preset(folder / "timeline.toml", timeline_of(head, bpy.context.scene))
    write_preset(folder / "expression.toml", expression_of(head))
    write_fap(folder / "stream.fap", FapStream(np.round(expression("joy").frame())[None], fps=25.0, name="kept"))
    (folder / "kept.json").write_text(json.dumps(kept(head), indent=1) + "\n", encoding="utf-8")
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "saved.blend"), compress=True)
    return 0


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
