"""What has been baked, in the panel: clips of new shape keys, and clips on the rig with how far it follows."""

from __future__ import annotations

from ...scene.bake import shape_keys
from ...scene.rig.kept import Followed, kept_clips
from ..active import active_object
from ..blender_types import Context, UILayout
from ..sidebar import LINE
from .ops import RISORIUS_OT_bake_again, RISORIUS_OT_clear
from .settings import stale_clips, stale_rig_clips

#: Letters that an icon, or a step to the right, takes from a line.
STEP = 4


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
    if on_rig:
        chosen, box = obj.risorius.bake, layout.box().column(align=True)
        row = box.row(align=True)
        row.prop(chosen, "details", text="", icon="TRIA_DOWN" if chosen.details else "TRIA_RIGHT", emboss=False)
        row.label(text="On your rig: shown, off")
        for clip, kept in on_rig.items():
            followed = kept.followed
            _draw_clip(
                box, clip, followed.line if followed is not None else "", stale=clip in stale_on_rig, on_rig=True
            )
            if chosen.details and followed is not None:
                _draw_details(box, followed)
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


def _draw_details(box: UILayout, followed: Followed) -> None:
    """Which controls carry a clip, and what is missing."""
    column = box.column(align=True)
    column.active = False
    if followed.carriers:
        column.label(text=listed("With", followed.carriers), icon="BLANK1")
    if followed.missing:
        column.label(text=listed("Little", followed.missing), icon="BLANK1")


def listed(what: str, names: tuple[str, ...], room: int = LINE - STEP) -> str:
    """As many of some names as fit on a line, and how many more there are."""
    for count in range(len(names), 0, -1):
        more = len(names) - count
        text = f"{what} {', '.join(names[:count])}" + (f" +{more}" if more else "")
        if len(text) <= room:
            return text
    return f"{what} {names[0]}"[:room]
