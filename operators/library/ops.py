"""Operators that save and load presets; by menu, or by dropping a file on the viewport."""

from __future__ import annotations

from pathlib import Path

import bpy
from bpy.props import EnumProperty, StringProperty

from ...errors import SceneError
from ...files import safe_stem
from ...mpeg4.preset_file import PresetKind, read_preset, write_preset
from ...scene.blender_types import Event
from ..active import active_object, face_reason
from ..annotated import Annotated
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
                    "Save all clips and speech with their times, the variation, and muscles set by hand",
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
        nothing = not obj.risorius.timeline.clips and not obj.risorius.speech.strips
        if self.kind == PresetKind.TIMELINE and nothing:
            raise SceneError(obj.name, "has no clips yet: add one, or save the expression")
        folder = own_folder(create=True)
        if folder is None:
            raise SceneError("Blender", "has no folder for your presets: check the file paths in the preferences")
        stem = safe_stem(str(self.preset), "Mine")
        path = folder / f"{stem}.toml"
        is_expression = self.kind == PresetKind.EXPRESSION
        held = expression_of(obj) if is_expression else timeline_of(obj, context.scene, path)
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
        done, said = load(read_preset(path), active_object(context), context, path.parent)
        for line in said:
            self.report({"WARNING"}, line)
        return f"{done} from {path.name}"
