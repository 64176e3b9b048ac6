"""What has been baked, in the panel: clips of new shape keys, and clips on the rig with how far it follows.

Of several clips on the rig, those at the current frame say more.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

from ...scene.bake import shape_keys
from ...scene.rig.kept import Followed, kept_clips
from ..active import active_object
from ..blender_types import Context, Object, UILayout
from ..sidebar import LINE
from .ops import RISORIUS_OT_bake_again, RISORIUS_OT_clear
from .settings import stale_clips, stale_rig_clips

#: Letters that an icon, or a step to the right, takes from a line.
STEP = 4
#: So much of what was assumed is shown; the report has all.
SAID = 6


def draw_baked(layout: UILayout, context: Context) -> None:
    """The clips of a face, those out of date marked, each with a button that removes it."""
    obj, scene = active_object(context), context.scene
    clips, on_rig = shape_keys.read_own(obj.data).clips, kept_clips(obj)
    if not clips and not on_rig:
        return
    stale, stale_on_rig = stale_clips(obj, scene), stale_rig_clips(obj, scene)
    if clips:
        box = layout.box().column(align=True)
        for clip, keys in clips.items():
            _draw_clip(box, clip, f"{len(keys)} key{'s' * (len(keys) != 1)}", stale=clip in stale, on_rig=False)
            _draw_read(box, obj, clip)
    if on_rig:
        box, now = layout.box().column(align=True), float(scene.frame_current)
        box.label(text="On your own controls")
        for clip, kept in on_rig.items():
            followed, (first, last) = kept.followed, kept.frames
            state = followed.line if followed is not None else ""
            _draw_clip(box, clip, state, stale=clip in stale_on_rig, on_rig=True)
            if followed is not None and (len(on_rig) == 1 or first <= now <= last):
                _draw_details(box, followed)
            _draw_read(box, obj, clip)
    if stale or stale_on_rig:
        layout.operator(RISORIUS_OT_bake_again.bl_idname, icon="FILE_REFRESH")
    layout.operator(RISORIUS_OT_clear.bl_idname, text="Clear All Bakes", icon="TRASH").clip = ""


def _draw_clip(box: UILayout, clip: str, state: str, *, stale: bool, on_rig: bool) -> None:
    """One clip."""
    row = box.row(align=True)
    row.label(text=clip, icon="ERROR" if stale else "ACTION")
    row.label(text="out of date" if stale else state)
    button = row.operator(RISORIUS_OT_clear.bl_idname, text="", icon="X")
    button.clip, button.on_rig = clip, on_rig


def _draw_read(box: UILayout, obj: Object, clip: str) -> None:
    """What was assumed when the recording behind a clip was read, and what was not read."""
    recording = obj.risorius.recording
    if recording.clip != clip or not recording.said:
        return
    column = box.column(align=True)
    column.active = False
    for said in recording.said.splitlines()[:SAID]:
        for index, line in enumerate(textwrap.wrap(said, LINE - STEP)[:2]):
            column.label(text=line, icon="BLANK1" if index else "INFO")


def _draw_details(box: UILayout, followed: Followed) -> None:
    """Which controls carry a clip, and what shows too little."""
    column = box.column(align=True)
    column.active = False
    for what, names in (("Mostly", followed.carriers), ("Too little", followed.missing)):
        for line in listed(what, names):
            column.label(text=line, icon="BLANK1")


def listed(what: str, names: Sequence[str], *, width: int = LINE - STEP, lines: int = 2) -> list[str]:
    """As many of some names as fit on a few lines, and how many more there are."""
    for count in range(len(names), 0, -1):
        more = f" +{len(names) - count}" if count < len(names) else ""
        wrapped = textwrap.wrap(f"{what}: {', '.join(names[:count])}{more}", width)
        if len(wrapped) <= lines:
            return wrapped
    return []
