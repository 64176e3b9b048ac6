"""Runs inside a Blender window, stepped by a timer: what a user does in the first minute, and what came of it.

Writes its findings as JSON to the path after `--`, then waits for the picture to be taken (a file beside it), and
unregisters the extension.
"""

import json
import sys
import traceback
from pathlib import Path

import bpy

REPORT = Path(sys.argv[sys.argv.index("--") + 1])
PICTURE_TAKEN = REPORT.with_suffix(".png")
MODULE = "bl_ext.user_default.risorius"
LIMIT = 240  # ticks of half a second for the bake

found = {}
state = {"ticks": 0}


def registered():
    """Everything of Risorius that Blender knows of."""
    names = [name for name in dir(bpy.types) if "risorius" in name.lower()]
    owners = (bpy.types.Object, bpy.types.Scene, bpy.types.WindowManager)
    names += [f"{kind.__name__}.risorius" for kind in owners if hasattr(kind, "risorius")]
    return names


def viewport():
    """Window, area and region of the 3D viewport, and its sidebar's region."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    regions = {region.type: region for region in area.regions}
    return window, area, regions["WINDOW"], regions["UI"]


def add_head_and_start_bake():
    """Add the default head, show its points and parts, open the sidebar's tab and press Bake as the button does."""
    window, area, region, _ = viewport()
    with bpy.context.temp_override(window=window, area=area, region=region):
        for obj in list(bpy.data.objects):
            bpy.data.objects.remove(obj)
        found["add_head"] = sorted(bpy.ops.risorius.add_head())
        head = bpy.context.object
        head.risorius.emotion.word = "surprise"
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.view3d.view_selected()
        area.spaces.active.show_region_ui = True
        found["find_points"] = sorted(bpy.ops.risorius.find_points())
        found["use_drag_tool"] = sorted(bpy.ops.risorius.use_drag_tool())
        bpy.context.window_manager.risorius.parts.show = True
        found["bake_begun"] = sorted(bpy.ops.risorius.bake_expression("INVOKE_DEFAULT"))
    return head


def tick():
    """One step each half second."""
    try:
        return step()
    except Exception:
        found["error"] = traceback.format_exc()
        write()
        return None


def step():
    """Begin; wait for the bake; show its apex; wait for the picture; unregister."""
    state["ticks"] += 1
    if "head" not in state:
        found["registered"] = registered()
        state["head"] = add_head_and_start_bake().name
        return 0.5
    head = bpy.data.objects[state["head"]]
    keys = head.data.shape_keys
    if "baked" not in found:
        baked = keys is not None and keys.animation_data is not None and keys.animation_data.action is not None
        if not baked and state["ticks"] < LIMIT:
            return 0.5
        found["baked"] = baked
        found["keys"] = [key.name for key in keys.key_blocks] if keys else []
        if baked:
            first, last = keys.animation_data.action.frame_range
            bpy.context.scene.frame_set(round(first + 0.4 * (last - first)))
            found["values"] = [key.value for key in keys.key_blocks]
        shown = bpy.context.window_manager.risorius
        shown.points.show = shown.parts.show = False  # they were drawn while it was baked; the picture is of the face
        viewport()[3].active_panel_category = "Risorius"
        return 1.0
    if "shown" not in found:
        viewport()[1].tag_redraw()
        found["listed"] = len(bpy.context.window_manager.risorius.points.names)
        found["tool"] = bpy.context.workspace.tools.from_space_view3d_mode("OBJECT").idname
        found["shown"] = viewport()[3].active_panel_category
        write()
        return 0.5
    if not PICTURE_TAKEN.exists():
        return 0.5
    bpy.ops.preferences.addon_disable(module=MODULE)
    found["after"] = registered()
    write()
    return None


def write():
    """The findings so far, in one piece."""
    draft = REPORT.with_suffix(".draft")
    draft.write_text(json.dumps(found))
    draft.replace(REPORT)


bpy.app.timers.register(tick, first_interval=2.0)
