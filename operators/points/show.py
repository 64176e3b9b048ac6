"""Showing feature points that were found: on the face, from its front, with a question where they are doubtful."""

from __future__ import annotations

from ...face.fit.doubt import DOUBTFUL_SCORE
from ...scene.points.carried import carry_rest
from ...scene.points.found import Finding
from ...scene.points.seen import Visible
from ..active import active_object
from ..base import RisoriusOperator
from ..blender_types import Context
from ..followers.rows import following, list_again
from .look import turn_to_face
from .props import list_names
from .question import ask_whether_right


def show_points(context: Context) -> None:
    """Show the points of the active object, on what its modifiers make of it."""
    list_names()
    if not Visible.of(active_object(context), context.evaluated_depsgraph_get()).same_polygons:
        carry_rest(active_object(context))
    context.window_manager.risorius.points.show = True


def show_finding(operator: RisoriusOperator, context: Context, finding: Finding) -> str:
    """Show the points, ask where they are doubtful, and say what was found."""
    show_points(context)
    for problem in finding.unreadable:
        operator.report({"WARNING"}, f"A saved topology was skipped: {problem}")
    turn_to_face(context, finding.kept)
    if finding.kept.is_questioned:
        operator.report(
            {"WARNING"},
            f"{active_object(context).name} is unlike most faces (score {finding.score:.2f}, most have 0 to"
            f" {DOUBTFUL_SCORE:g}): check its points, or click six points",
        )
    ask_whether_right(context, finding.kept)
    obj = active_object(context)
    list_again(obj, context.scene)
    return finding.summary(obj.name) + following(obj)
