"""Runs inside a Blender window and does what is asked through a folder: a script in, its answer out.

Requests are files NUMBER.py, answers NUMBER.json: {"result": ...} or {"error": "traceback"}. Names that one script
sets the next one has; `result` is what it answers.
"""

import json
import sys
import traceback
import warnings
from pathlib import Path

import bpy

FOLDER = Path(sys.argv[sys.argv.index("--") + 1])
EVERY = 0.05

# Python keeps quiet about these by default; the driver looks for them in what Blender printed.
for kind in (DeprecationWarning, PendingDeprecationWarning, FutureWarning):
    warnings.filterwarnings("always", category=kind, module=r"bl_ext\..*risorius")

names = {"bpy": bpy}


def _viewport():
    """Window, area, and the regions of the 3D viewport by their kind."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return window, area, {region.type: region for region in area.regions}


def in_viewport():
    """Override for operators that want a 3D viewport."""
    window, area, regions = _viewport()
    return bpy.context.temp_override(window=window, area=area, region=regions["WINDOW"])


names |= {"viewport": _viewport, "in_viewport": in_viewport}


def serve():
    """Answer the oldest request, if there is one."""
    for request in sorted(FOLDER.glob("*.py")):
        code = request.read_text()
        request.unlink()
        names["result"] = None
        try:
            exec(compile(code, request.name, "exec"), names)
            answer = {"result": names["result"]}
        except BaseException:
            answer = {"error": traceback.format_exc()}
        draft = request.with_suffix(".draft")
        draft.write_text(json.dumps(answer))
        draft.rename(request.with_suffix(".json"))
        break
    return EVERY


# Persistent: opening a file must not end the service.
bpy.app.timers.register(serve, first_interval=0.5, persistent=True)
