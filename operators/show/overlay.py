"""Muscles, strain and paths of the active face, drawn in the viewport. Nothing is kept but what a redraw repeats."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from mathutils import Vector

from ...arrays import Floats
from ...scene.live.live_face import LiveFace
from ...scene.mesh import edge_vertices, rest_vertices, triangle_corners
from ...scene.points.seen import Visible
from ..blender_types import Context, Object
from ..muscles.props import by_hand_of
from ..points.view import Viewport
from ..preview import live
from . import colours

#: How far things are drawn before their place, towards the viewer, as a share of the object's size: colours on the
#: skin; paths, which lie in it; and muscles, which lie under it. What is farther behind stays hidden.
ON_SKIN, IN_SKIN, UNDER_SKIN = 8e-4, 8e-3, 6e-2
#: Widths of lines in pixels: slack, contracted, a path.
SLACK, CONTRACTED, PATH = 1.2, 5.5, 3.0
#: Contractions are drawn in so many widths.
LEVELS = 4


def _draw() -> None:
    """Draw handler: in the world."""
    context: Context = bpy.context
    obj, viewport = context.object, Viewport.of(context)
    state = context.window_manager.risorius.show
    if obj is None or obj.type != "MESH" or viewport is None or not (state.muscles or state.strain or state.paths):
        return
    if not viewport.draws_over(obj):
        return
    visible = Visible.of(obj, context.evaluated_depsgraph_get())
    if not visible.same_polygons:
        return
    face = live.held(obj)
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("LESS_EQUAL")
    if state.strain:
        with _before(obj, viewport, ON_SKIN):
            _draw_strain(obj, visible)
    if face is not None and state.muscles:
        with _before(obj, viewport, UNDER_SKIN):
            _draw_muscles(obj, face, visible.vertices)
    shows = live.shown(obj)
    if face is not None and shows is not None and shows.paths is not None and state.paths:
        with _before(obj, viewport, IN_SKIN):
            _draw_paths(shows.paths)
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")


@contextmanager
def _before(obj: Object, viewport: Viewport, share: float) -> Iterator[None]:
    """Draw in the object's coordinates, a share of its size nearer to the viewer."""
    with gpu.matrix.push_pop():
        gpu.matrix.translate(Vector(viewport.eye()[1]) * (share * max(obj.dimensions)))
        gpu.matrix.multiply_matrix(obj.matrix_world)
        yield


def _draw_strain(obj: Object, visible: Visible) -> None:
    """Colours on the skin."""
    shader = gpu.shader.from_builtin("SMOOTH_COLOR")
    rest = rest_vertices(obj.data)
    found = colours.of_strain(colours.strain(rest, visible.vertices, edge_vertices(obj.data)))
    content = {"pos": visible.vertices.astype(np.float32), "color": found.astype(np.float32)}
    triangles = triangle_corners(visible.shown.data).astype(np.int32)
    batch_for_shader(shader, "TRIS", content, indices=triangles).draw(shader)


def _draw_muscles(obj: Object, face: LiveFace, shown: Floats) -> None:
    """Lines from the bone to where the skin is now; the more they are contracted, the redder and thicker."""
    shows = live.shown(obj)
    contractions = {**(shows.contractions if shows is not None else {}), **by_hand_of(obj)}
    by_width: dict[int, list[tuple[Floats, Floats]]] = {}
    for name, strands in face.muscle_strands(shown).items():
        contraction = contractions.get(name, 0.0)
        level = round(np.sqrt(min(max(contraction, 0.0), 1.0)) * LEVELS)
        for strand in strands:
            by_width.setdefault(level, []).append(
                (strand, np.tile(colours.of_contraction(contraction), (len(strand), 1)))
            )
    for level in sorted(by_width):
        _draw_lines(by_width[level], SLACK + (CONTRACTED - SLACK) * level / LEVELS)


def _draw_paths(paths: Floats) -> None:
    """The way of the skin, (k, T, 3)."""
    shades = colours.of_time(np.linspace(0.0, 1.0, paths.shape[1]))
    _draw_lines([(path, shades) for path in paths], PATH)


def _draw_lines(lines: list[tuple[Floats, Floats]], width: float) -> None:
    """Lines (n, 3) with colours (n, 4) at their points, in one go."""
    shader = gpu.shader.from_builtin("POLYLINE_SMOOTH_COLOR")
    pairs = [np.stack([line[:-1], line[1:]], axis=1).reshape(-1, 3) for line, _ in lines]
    shades = [np.stack([shade[:-1], shade[1:]], axis=1).reshape(-1, 4) for _, shade in lines]
    content = {"pos": np.concatenate(pairs).astype(np.float32), "color": np.concatenate(shades).astype(np.float32)}
    batch = batch_for_shader(shader, "LINES", content)
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    context: Context = bpy.context
    shader.uniform_float("lineWidth", width * context.preferences.system.ui_scale)
    batch.draw(shader)


def attach(undo: ExitStack) -> None:
    """Draw until undone."""
    handler = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")
    undo.callback(bpy.types.SpaceView3D.draw_handler_remove, handler, "WINDOW")
