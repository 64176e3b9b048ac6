"""The parts that are kept with the active face's mesh, drawn over it as colours."""

from __future__ import annotations

from contextlib import ExitStack

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from mathutils import Vector
from numpy.typing import NDArray

from ...arrays import Ints
from ...face.mesh.parts import Part
from ...scene.mesh import read_parts, triangle_corners
from ...scene.points.seen import Visible
from ..blender_types import Context
from ..points.view import Viewport

#: Colours of the parts; grey where nobody has told.
COLOURS = {
    Part.SKIN: (0.90, 0.62, 0.45),
    Part.EYEBALL_L: (0.25, 0.60, 1.00),
    Part.EYEBALL_R: (0.20, 0.90, 0.95),
    Part.TEETH_UPPER: (1.00, 0.95, 0.35),
    Part.TEETH_LOWER: (0.75, 0.85, 0.20),
    Part.TONGUE: (0.95, 0.25, 0.50),
    Part.OTHER: (0.60, 0.35, 0.85),
    Part.SKULL: (0.35, 0.22, 0.12),
}
UNTOLD = (0.5, 0.5, 0.5)
STRENGTH = 0.6
#: How far the colours stand off the surface towards the viewer, as a share of the object's size.
OFF = 8e-4


def colours(parts: Ints) -> NDArray[np.float32]:
    """(V, 4) colour of each vertex, float32."""
    table = np.array([COLOURS[part] for part in Part] + [UNTOLD])
    shown = np.empty((len(parts), 4), dtype=np.float32)
    shown[:, :3], shown[:, 3] = table[parts], STRENGTH  # -1, untold, is the last row
    return shown


def _draw() -> None:
    """Draw handler: in the world."""
    context: Context = bpy.context
    obj, viewport = context.object, Viewport.of(context)
    if obj is None or obj.type != "MESH" or viewport is None or not context.window_manager.risorius.parts.show:
        return
    if not viewport.draws_over(obj):
        return
    parts = read_parts(obj.data)
    visible = Visible.of(obj, context.evaluated_depsgraph_get())
    if parts is None or not visible.same_polygons:
        return
    triangles = triangle_corners(visible.shown.data).astype(np.int32)
    shader = gpu.shader.from_builtin("SMOOTH_COLOR")
    content = {"pos": visible.vertices.astype(np.float32), "color": colours(parts)}
    batch = batch_for_shader(shader, "TRIS", content, indices=triangles)
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("LESS_EQUAL")
    with gpu.matrix.push_pop():
        gpu.matrix.translate(Vector(viewport.eye()[1]) * (OFF * max(obj.dimensions)))
        gpu.matrix.multiply_matrix(obj.matrix_world)
        batch.draw(shader)
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")


def attach(undo: ExitStack) -> None:
    """Draw until undone."""
    handler = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")
    undo.callback(bpy.types.SpaceView3D.draw_handler_remove, handler, "WINDOW")
