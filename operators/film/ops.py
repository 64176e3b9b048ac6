"""Operators that render a film and export a model."""

from __future__ import annotations

import math
from pathlib import Path

import bpy

from ...errors import SceneError
from ...progress import Work, part_of
from ...scene import bake, gltf, refusals
from ...scene.bake import tracks
from ...scene.laid_out import is_baked
from ...scene.pictures import film
from ...scene.pictures.look import Camera, Engine, Look
from ...scene.points.found import Finding
from ...scene.rig import remove_rig_clips
from ...scene.rig.kept import kept_clips
from ..active import active_object, target_of
from ..bake.destination import bake_reason
from ..bake.work import motion_work
from ..base import RisoriusOperator, WorkOperator
from ..blender_classes import Operator
from ..blender_types import Context, Object
from ..followers.rows import staying
from ..points.first import with_points
from ..points.show import show_finding
from .props import RISORIUS_PG_film

#: The share of a bake before a film in the whole.
BAKING = 0.3


class RISORIUS_OT_render_film(WorkOperator[film.FilmResult | Finding], Operator):
    """Render the face as a video. If nothing is baked yet, bake the timeline first. Your scene does not change"""

    bl_idname = "risorius.render_film"
    bl_label = "Render Video"
    bl_options = {"REGISTER"}
    needs_scipy = False
    title = "Rendering the video"

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only for meshes that can be read, with something to show or to bake."""
        reason = refusals.reason(context.object, writing=False)
        return bake_reason(active_object(context)) if reason is None and not moves(active_object(context)) else reason

    def work(self, context: Context) -> Work[film.FilmResult | Finding]:
        """Bake what is laid out where nothing moves the face yet, then render and encode.

        Closed early, that bake is taken away again.
        """
        obj = active_object(context)
        if moves(obj):
            return (yield from rendering(context))
        baking = with_points(obj, lambda: motion_work(obj, context.scene), scene=context.scene)
        baked = yield from part_of(baking, 0.0, BAKING)
        if isinstance(baked, Finding):
            return baked
        try:
            return (yield from part_of(rendering(context), BAKING, 1.0))
        except GeneratorExit:
            if baked.followed is None:
                bake.clear(target_of(obj), clips=[baked.clip])
            else:
                remove_rig_clips(obj, [baked.clip])
            raise

    def finish(self, context: Context, result: film.FilmResult | Finding) -> str:
        """Say where it is."""
        if isinstance(result, Finding):
            return show_finding(self, context, result)
        target = target_of(active_object(context), context.scene)
        for remark in (*result.remarks, *target.remarks()):
            self.report({"WARNING"}, remark)
        where = " and ".join(str(place) for place in (result.path, result.frames) if place is not None)
        return f"Rendered {result.frame_count} frames to {where}"


class RISORIUS_OT_export_gltf(RisoriusOperator, Operator):
    """Export the face with all its baked clips as glTF: a morph target per shape key, an animation per clip"""

    bl_idname = "risorius.export_gltf"
    bl_label = "Export glTF"
    bl_options = {"REGISTER"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where something is baked."""
        reason = refusals.reason(context.object, writing=False)
        if reason is None and not is_baked(context.object):
            return "Nothing has been baked on this face yet"
        return reason

    def run(self, context: Context) -> str:
        """Export."""
        chosen = context.scene.risorius.film
        path = absolute(chosen.model, ".glb", keep=(".glb", ".gltf"))
        target = target_of(active_object(context), context.scene)
        exported = gltf.export_gltf(target.objects(), path, morph_normals=chosen.morph_normals)
        for remark in (*exported.remarks, *target.remarks()):
            self.report({"WARNING"}, remark)
        return f"Exported {', '.join(exported.clips)} to {exported.path}: {exported.size.line}"


def rendering(context: Context) -> Work[film.FilmResult]:
    """Render and encode as it is chosen."""
    obj, chosen = active_object(context), context.scene.risorius.film
    path, (start, end) = film_path(chosen), frame_range(context)
    return film.render_film(
        [*target_of(obj).objects(), *staying(obj)],
        path if chosen.output != "PNG" else None,
        start=start,
        end=end,
        look=look_of(chosen),
        frames=None if chosen.output == "MP4" else path.with_suffix(""),
    )


def moves(obj: Object) -> bool:
    """Whether anything moves the face already: a bake, or an animation of the user's."""
    animated = any(
        owner is not None and owner.animation_data is not None for owner in (obj, obj.data, obj.data.shape_keys)
    )
    return animated or any(modifier.type == "ARMATURE" for modifier in obj.modifiers)


def look_of(chosen: RISORIUS_PG_film) -> Look:
    """The look chosen; with a window there is a graphics card that affords the fine one."""
    width, height = (size // 2 * 2 for size in (chosen.width, chosen.height))
    return Look(
        engine=Engine(chosen.engine),
        width=width,
        height=height,
        fine=not bpy.app.background,
        camera=Camera(chosen.camera),
    )


def film_path(chosen: RISORIUS_PG_film) -> Path:
    """The film's absolute path, ending in .mp4.

    Raises
    ------
    SceneError : no path.
    """
    return absolute(chosen.path, ".mp4", keep=(".mp4",))


def absolute(name: str, suffix: str, *, keep: tuple[str, ...]) -> Path:
    """An output's absolute path; beside a .blend that was never saved means the home folder.

    Raises
    ------
    SceneError : no name.
    """
    if not name.strip():
        raise SceneError("Output", "has no file: choose one")
    homeless = name.startswith("//") and not bpy.data.filepath
    path = Path.home() / name[2:] if homeless else Path(bpy.path.abspath(name))
    return path if path.suffix.lower() in keep else path.with_name(path.name + suffix)


def frame_range(context: Context) -> tuple[int, int]:
    """First and last frame: of the clips that the face plays, or of the scene."""
    scene = context.scene
    obj = active_object(context)
    played = tracks.played_frames(obj.data.shape_keys)
    spans = [(math.floor(kept.frames[0]), math.ceil(kept.frames[1])) for kept in kept_clips(obj).values()]
    spans += [played] if played is not None else []
    if scene.risorius.film.frames == "CLIP" and spans:
        return min(first for first, _ in spans), max(last for _, last in spans)
    return int(scene.frame_start), int(scene.frame_end)
