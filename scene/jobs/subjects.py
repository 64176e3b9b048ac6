"""Whose face a job is about: the default head, or the mesh of a file that looks most like a face."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import bpy

from ...errors import ModelError, RisoriusError
from ...face.mesh.point_files import read_point_file
from ...progress import Progress, Work, part_of
from ..bake.target import Target
from ..blender_types import Mesh, Object
from ..following.found import find_followers
from ..following.rows import Row, behind_of, followers_of, staying_of
from ..following.saved import saved_with
from ..head import add_default_head, select_only
from ..points.found import Finding, find_points, seek_points
from ..points.kept import has_points, write_kept
from ..points.stored import store_points
from .inputs import Input, meshes_of, named_mesh, open_input
from .painting import paint_parts

#: What is said of an object that seems to belong to a face, but is not in the list saved with it.
UNLISTED = "is not in the list Follows the Face: press Refresh there"


@dataclass(frozen=True)
class Subject:
    """The face of a job.

    Attributes
    ----------
    target : its objects.
    remarks : how it was chosen, where there was a choice.
    in_own_scene : whether the scene around it is the user's, to be left as it is.
    staying : objects about the face that do not follow it, but show beside it.
    file : where it comes from; None: the default head.
    """

    target: Target
    remarks: tuple[str, ...] = ()
    in_own_scene: bool = False
    staying: tuple[Object, ...] = ()
    file: Path | None = None

    @property
    def obj(self) -> Object:
        """The head."""
        return self.target.obj

    def shown(self) -> list[Object]:
        """All that pictures of the face show, the head first."""
        return [*self.target.objects(), *self.staying]


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
    face = _with_followers(obj, in_own_scene=asked.is_scene)
    return replace(face, remarks=remarks + face.remarks, file=asked.mesh)


def _with_followers(obj: Object, *, in_own_scene: bool) -> Subject:
    """A head with the objects that follow it: as saved with it in the file, else as found in its scene.

    What came into the scene after the list was saved is named, not taken along.
    """
    saved = saved_with(obj)
    single = saved.make_single_user
    kept = saved.rows if saved.is_whole else tuple(row for row in saved.rows if row.by_hand)
    others = find_followers(obj, beside={row.obj for row in kept})
    found = () if saved.is_whole else tuple(Row(other.obj, other.follows, other.why_not) for other in others)
    behind = behind_of((*kept, *found), make_single_user=single)
    if saved.is_whole:
        behind += tuple(f"{other.obj.name} ({UNLISTED})" for other in others)
    as_saved, as_found = (followers_of(rows, make_single_user=single) for rows in (kept, found))
    target = Target(obj, as_saved + as_found, make_single_user=single, left_behind=behind)
    remarks = tuple(
        f"the face is {obj.name}; these follow it{where}: {', '.join(each.obj.name for each in companions)}"
        for companions, where in ((as_saved, " as saved in the file"), (as_found, ""))
        if companions
    )
    return Subject(target, remarks, in_own_scene, tuple(staying_of((*kept, *found), make_single_user=single)))


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
