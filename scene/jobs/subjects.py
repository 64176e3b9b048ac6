"""Whose face a job is about: the default head, or the mesh of a file that looks most like a face."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import bpy

from ...errors import ModelError, RisoriusError
from ...face.mesh.point_files import read_point_file
from ...progress import Progress, Work, part_of
from ..bake.target import Target
from ..blender_types import Mesh, Object
from ..companions import Companion
from ..following.found import find_followers
from ..following.kinds import PARTS, Follows
from ..head import add_default_head, select_only
from ..points.found import Finding, find_points, seek_points
from ..points.kept import has_points, write_kept
from ..points.stored import store_points
from ..refusals import reason
from .inputs import Input, meshes_of, named_mesh, open_input
from .painting import paint_parts


@dataclass(frozen=True)
class Subject:
    """The face of a job.

    Attributes
    ----------
    target : its objects.
    remarks : how it was chosen, where there was a choice.
    in_own_scene : whether the scene around it is the user's, to be left as it is.
    """

    target: Target
    remarks: tuple[str, ...] = ()
    in_own_scene: bool = False

    @property
    def obj(self) -> Object:
        """The head."""
        return self.target.obj


def subject(asked: Input, *, creases: bool = False) -> Work[Subject]:
    """Open or make the file of a job, with a face that has feature points.

    Parameters
    ----------
    creases : whether the skin of a mesh that brings no materials shows creases.

    Raises
    ------
    FormatError, SceneError : a file that cannot be read, no mesh in it, or none of the name asked for.
    ModelError : no points given and no face found.
    """
    yield Progress(0.0, "Loading the face")
    open_input(asked)
    if asked.mesh is None:
        return Subject(Target(add_default_head()))
    obj, remarks = yield from part_of(_bearer(asked.mesh, asked), 0.0, 0.9)
    if asked.points is not None:
        store_points(obj, read_point_file(asked.points))
    if not has_points(obj):
        yield from part_of(find_points(obj), 0.5, 1.0)
    if not asked.is_scene and not obj.data.materials:
        paint_parts(obj, creases=creases)
    _show(obj)
    target = _with_followers(obj)
    names = ", ".join(companion.obj.name for companion in target.companions)
    follow = (f"the face is {obj.name}; these follow it: {names}",) if names else ()
    return Subject(target, remarks + follow, asked.is_scene)


def _with_followers(obj: Object) -> Target:
    """A head with the objects of its scene that follow it; what cannot be written to stays behind."""
    companions, behind = [], []
    for follower in find_followers(obj):
        why = follower.why_not or reason(follower.obj)
        if follower.follows is Follows.NONE or why:
            behind.append(
                f"{follower.obj.name} ({(why or 'does not follow').removeprefix(follower.obj.name).lstrip(': ')})"
            )
        else:
            companions.append(Companion(follower.obj, PARTS[follower.follows]))
    return Target(obj, tuple(companions), left_behind=tuple(behind))


def _bearer(path: Path, asked: Input) -> Work[tuple[Object, tuple[str, ...]]]:
    """The object that bears the face, and how it was chosen."""
    found = meshes_of(path)
    if asked.object_name is not None:
        return named_mesh(path, found, asked.object_name), ()
    if len(found) == 1:
        return found[0], ()
    pointed = [obj for obj in found if has_points(obj)]
    if pointed:
        chosen, why = max(pointed, key=lambda obj: len(obj.data.vertices)), "it has feature points"
    else:
        chosen, why = yield from _most_face_like(path, found)
    return chosen, (f"{path.name} has {len(found)} meshes; the face is {chosen.name}: {why} (--object names another)",)


def _most_face_like(path: Path, found: list[Object]) -> Work[tuple[Object, str]]:
    """The mesh that looks most like a face, with its points; and what it was told by.

    Objects of one mesh are asked once, the densest first; one of a known topology ends the search.
    """
    by_mesh: dict[Mesh, Object] = {}
    for obj in sorted(found, key=_precedence):
        by_mesh.setdefault(obj.data, obj)
    distinct = list(by_mesh.values())
    best: tuple[Object, Finding] | None = None
    for number, obj in enumerate(distinct):
        yield Progress(number / len(distinct), f"Looking for a face in {obj.name} ({number + 1} of {len(distinct)})")
        try:
            finding = yield from part_of(seek_points(obj), number / len(distinct), (number + 1) / len(distinct))
        except RisoriusError:  # no face, or nothing that can be one
            continue
        if best is None or finding.score < best[1].score:
            best = obj, finding
        if finding.topology is not None:
            break
    if best is None:
        names = ", ".join(obj.name for obj in distinct)
        raise ModelError(
            f"{path}: no face found in any of its meshes ({names}): "
            "name the mesh with --object, and give its feature points with --points"
        )
    obj, finding = best
    write_kept(obj, finding.kept, as_given=True)
    return obj, f"its topology is {finding.topology}" if finding.topology else "it looks most like a face"


def _precedence(obj: Object) -> tuple[bool, int]:
    """What shows comes first, then what is dense."""
    return not obj.visible_get(), -len(obj.data.vertices)


def _show(obj: Object) -> None:
    """Select the face alone; a face that is in no scene is put into this one."""
    if obj.name not in bpy.context.scene.objects:
        bpy.context.scene.collection.objects.link(obj)
    if obj.name in bpy.context.view_layer.objects:
        select_only(obj)
