"""Blender's cloth by position-based dynamics: the node group on its XPBD solver node, in Blender 5.2 and later."""

from __future__ import annotations

import statistics
import time
from pathlib import Path
from typing import Any

#: Blender's own node group, and where Blender keeps it.
GROUP, ASSETS = "Cloth Dynamics (Experimental)", "assets/nodes/geometry_nodes_dynamics_assets.blend"
#: The attribute that it takes the weights of pins from unless told otherwise.
PINS = "Group"
#: Weight by which each vertex is held softly at its place.
HELD = 0.5


def xpbd_frame(vertices: Any, polygons: Any, frames: int) -> float | str:
    """Seconds per frame with its default settings, each vertex held softly; or why there are none."""
    import bpy

    if not hasattr(bpy.types, "GeometryNodeXPBDSolver"):
        return f"Blender {bpy.app.version_string} has no XPBD solver node"
    assets = Path(bpy.utils.system_resource("DATAFILES")) / ASSETS
    if not assets.is_file():
        return f"Blender {bpy.app.version_string} came without {GROUP}"
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(str(assets)) as (there, wanted):
        wanted.node_groups = [name for name in there.node_groups if name == GROUP]
    thing = sheet(vertices, polygons)
    modifier = thing.modifiers.new("cloth", "NODES")
    modifier.node_group = bpy.data.node_groups[GROUP]
    seconds = frame_seconds(thing, frames)
    moved = evaluated(thing) - vertices
    if not abs(moved).max() < 1.0:
        return "it does not hold such a sheet together"
    return seconds if abs(moved).max() > 0.0 else "it does not move such a sheet"


def sheet(vertices: Any, polygons: Any) -> Any:
    """An object of its own for a sheet, with a vertex group that holds each vertex half."""
    import bpy

    data = bpy.data.meshes.new("sheet")
    data.from_pydata(vertices.tolist(), [], polygons)
    thing = bpy.data.objects.new("sheet", data)
    bpy.context.scene.collection.objects.link(thing)
    thing.vertex_groups.new(name=PINS).add(list(range(len(vertices))), HELD, "REPLACE")
    return thing


def frame_seconds(thing: Any, frames: int) -> float:
    """Median processor seconds of a frame, played from the first on."""
    import bpy

    scene = bpy.context.scene
    scene.frame_set(1)
    evaluated(thing)
    times = []
    for frame in range(2, frames + 2):
        begin = time.process_time()
        scene.frame_set(frame)
        thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
        times.append(time.process_time() - begin)
    return statistics.median(times)


def evaluated(thing: Any) -> Any:
    """(V, 3) vertices as they show."""
    import bpy
    import numpy as np

    data = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    places = np.empty(3 * len(data.vertices), dtype=np.float32)
    data.vertices.foreach_get("co", places)
    return places.reshape(-1, 3)
