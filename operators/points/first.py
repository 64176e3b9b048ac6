"""First the face, then what is to be done with it: a button that needs feature points finds them itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import bpy

from ...progress import Work, part_of
from ...scene.as_read import is_there
from ...scene.points.found import Finding, find_points
from ...scene.points.kept import forget_points_of, has_points
from ..blender_types import Object, Scene
from ..followers.rows import forget_list, list_once

T = TypeVar("T")

#: The share of finding the face in the whole.
SHARE = 0.4


def with_points(obj: Object, then: Callable[[], Work[T]], *, scene: Scene) -> Work[T | Finding]:
    """Find the face of `obj` where it has no points yet, then go on with the other work and return its result.

    With a window a doubtful face ends it early, and what was found is returned: somebody should look first.
    Closed before its end or refused, it leaves no points behind: such a button makes no undo step.
    """
    if has_points(obj):
        list_once(obj, scene)
        return (yield from then())
    finding = yield from part_of(find_points(obj, scene=scene), 0.0, SHARE)
    if finding.kept.is_questioned and not bpy.app.background:
        return finding
    mesh, was_listed = obj.data, obj.risorius.face.followers_listed
    try:
        list_once(obj, scene)
        return (yield from part_of(then(), SHARE, 1.0))
    except BaseException:
        if is_there(mesh):
            forget_points_of(mesh)
        if is_there(obj) and not was_listed:
            forget_list(obj)
        raise
