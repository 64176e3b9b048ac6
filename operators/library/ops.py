"""Operators that save and load presets, and import .fap files; by menu, or by dropping a file on the viewport."""

from __future__ import annotations

import re
from pathlib import Path

import bpy
from bpy.props import EnumProperty, StringProperty

from ...errors import FormatError, SceneError
from ...mpeg4.preset_file import PresetKind, read_preset, write_preset
from ...progress import Work
from ...scene.bake.baking import BakeResult
from ...scene.bake.motion import FapMotion, at_rate
from ...scene.bake.timing import scene_fps
from ...scene.blender_types import Event
from ...scene.points.found import Finding
from ..active import active_object, face_reason
from ..annotated import Annotated
from ..bake.ops import BakeOperator
from ..bake.work import stream_work
from ..base import RisoriusOperator
from ..blender_classes import ImportHelper, Operator
from ..blender_types import Context
from .exchange import expression_of, load, own_folder, timeline_of


class RISORIUS_OT_save_preset(RisoriusOperator, Operator):
    """Save the expression in the Emotion panel, or the whole timeline, as a preset for any face"""

    bl_idname = "risorius.save_preset"
    bl_label = "Save Preset"
    bl_options = {"REGISTER"}
    needs_scipy = False

    preset: Annotated[
        str,
        StringProperty(
            name="Name", description="Name of the preset. A preset with the same name is replaced", default="Mine"
        ),
    ]
    kind: Annotated[
        str,
        EnumProperty(
            name="What",
            description="Content of the preset",
            items=(
                (
                    PresetKind.EXPRESSION.value,
                    "Expression",
                    "Save the emotion in the Emotion panel, and muscles set by hand",
                ),
                (
                    PresetKind.TIMELINE.value,
                    "Timeline",
                    "Save all clips with their times, the variation, and muscles set by hand",
                ),
            ),
        ),
    ]

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a mesh."""
        return None if context.object is not None and context.object.type == "MESH" else "Select the mesh of a face"

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask for the name."""
        return context.window_manager.invoke_props_dialog(self)

    def run(self, context: Context) -> str:
        """Save it in the user's folder."""
        obj = active_object(context)
        if self.kind == PresetKind.TIMELINE and not obj.risorius.timeline.clips:
            raise SceneError(obj.name, "has no clips yet: add one, or save the expression")
        folder = own_folder(create=True)
        if folder is None:
            raise SceneError("Blender", "has no folder for your presets: check the file paths in the preferences")
        stem = re.sub(r"[^\w\- ]", "_", str(self.preset)).strip() or "Mine"
        held = expression_of(obj) if self.kind == PresetKind.EXPRESSION else timeline_of(obj, context.scene)
        path = folder / f"{stem}.toml"
        write_preset(path, held)
        return f"Saved {path}"


class RISORIUS_OT_load_preset(RisoriusOperator, ImportHelper, Operator):
    """Load an expression, or a timeline that replaces the current clips and starts at the current frame"""

    bl_idname = "risorius.load_preset"
    bl_label = "Load Preset"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    filename_ext = ".toml"
    filter_glob: Annotated[str, StringProperty(default="*.toml", options={"HIDDEN"})]
    filepath: Annotated[
        str,
        StringProperty(name="File", description="Preset file to load", subtype="FILE_PATH", options={"SKIP_SAVE"}),
    ]

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a face."""
        return face_reason(context.object)

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask for the file, unless one was dropped."""
        return self.execute(context) if self.filepath else ImportHelper.invoke(self, context, event)

    def run(self, context: Context) -> str:
        """Load it."""
        path = Path(bpy.path.abspath(self.filepath))
        return f"{load(read_preset(path), active_object(context), context)} from {path.name}"


class RISORIUS_OT_import_fap(BakeOperator, ImportHelper, Operator):
    """Bake a stream of MPEG-4 facial animation parameters (.fap) on the face, starting at the current frame"""

    bl_idname = "risorius.import_fap"
    bl_label = "Import FAP"
    bl_options = {"REGISTER", "UNDO"}
    title = "Baking the FAP file"

    filename_ext = ".fap"
    filter_glob: Annotated[
        str, StringProperty(default="*.fap;*.fba;*.json;*.jsonl;*.csv;*.tsv;*.txt;*.log", options={"HIDDEN"})
    ]
    filepath: Annotated[
        str, StringProperty(name="File", description="FAP file to bake", subtype="FILE_PATH", options={"SKIP_SAVE"})
    ]

    _was_asked_for = False
    _assumed: tuple[str, ...] = ()

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask for the file, unless one was dropped."""
        if self.filepath:
            return BakeOperator.invoke(self, context, event)
        self._was_asked_for = True
        return ImportHelper.invoke(self, context, event)

    def run(self, context: Context) -> str:
        """Run straight through; after the file browser, between events like any bake."""
        if self._was_asked_for and not bpy.app.background:
            bpy.ops.risorius.import_fap("INVOKE_DEFAULT", filepath=self.filepath)
            return f"Baking {Path(self.filepath).name}"
        return super().run(context)

    def show_apex(self, context: Context) -> None:
        """Stay at the frame: it is where the motion begins."""

    def finish(self, context: Context, result: BakeResult | Finding) -> str:
        """Say what the file left open, and what was written."""
        for assumed in self._assumed:
            self.report({"WARNING"}, f"{Path(self.filepath).name}: {assumed}")
        return super().finish(context, result)

    def baking(self, context: Context) -> Work[BakeResult]:
        """Simulate the stream at the scene's rate."""
        from ... import api

        obj, path = active_object(context), Path(bpy.path.abspath(self.filepath))
        recording = api.read_recording(path)
        played, said = recording.played()
        self._assumed = recording.assumed + said
        frames = at_rate(played, recording.stream.fps, scene_fps(context.scene))
        if len(frames) == 0:
            raise FormatError(path, "contains no frames")
        start = float(context.scene.frame_current)
        return stream_work(obj, context.scene, FapMotion(frames), clip=path.stem, start=start)
