"""Blender's classes that those of Risorius derive from, with what mypy is to know of them.

Blender's own have no types: a class that derived from them could be asked for anything. What these say is what
operators, panels and properties use.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing import ClassVar, Protocol

    from ..scene.blender_types import Event, Items
    from .blender_types import Context, Object, Structure, UILayout

    class AddonPreferences:
        """What the user has set for the add-on."""

    class PropertyGroup:
        """Properties that are kept with something; those that Risorius is told of, with an object."""

        name: str
        bl_rna: ClassVar[Structure]
        id_data: Object

        def is_property_set(self, name: str) -> bool:
            """Whether the user has set it."""
            raise NotImplementedError

        def path_from_id(self) -> str:
            """Where they are in what they are kept with."""
            raise NotImplementedError

    class Operator:
        """What a button, a key or a menu entry does. `layout`: where it draws its fields."""

        layout: UILayout

        def report(self, kind: set[str], message: str) -> None:
            """Tell the user."""

        @classmethod
        def poll_message_set(cls, message: str) -> None:
            """Why the button is grey."""

    class Panel:
        """A panel."""

        layout: UILayout

    class Menu:
        """A menu."""

        layout: UILayout

    class UIList:
        """A list in a panel."""

        filter_name: str
        bitflag_filter_item: int

    class Gizmo:
        """Something in the viewport that is drawn and can be grasped."""

        use_draw_modal: bool
        is_highlight: bool

    class Gizmos(Items[Gizmo], Protocol):
        """The gizmos of a group."""

        def new(self, kind: str) -> Gizmo:
            """One more."""

    class GizmoGroup:
        """Gizmos that show together."""

        gizmos: Gizmos

    class FileHandler:
        """What may be dropped on an editor."""

    class WorkSpaceTool:
        """A tool in the toolbar."""

    class ImportHelper:
        """An operator that asks for a file to read."""

        filepath: str

        def invoke(self, context: Context, event: Event) -> set[str]:
            """Ask for the file."""
            raise NotImplementedError

    class ExportHelper(ImportHelper):
        """An operator that asks for a file to write."""

    class AddPresetBase:
        """Blender's operator that saves presets."""

    class PresetPanel:
        """Blender's panel of presets."""

        @classmethod
        def draw_panel_header(cls, layout: UILayout) -> None:
            """The button that opens it."""
else:
    from bl_operators.presets import AddPresetBase as AddPresetBase
    from bl_ui.utils import PresetPanel as PresetPanel
    from bpy.types import AddonPreferences as AddonPreferences
    from bpy.types import FileHandler as FileHandler
    from bpy.types import Gizmo as Gizmo
    from bpy.types import GizmoGroup as GizmoGroup
    from bpy.types import Menu as Menu
    from bpy.types import Operator as Operator
    from bpy.types import Panel as Panel
    from bpy.types import PropertyGroup as PropertyGroup
    from bpy.types import UIList as UIList
    from bpy.types import WorkSpaceTool as WorkSpaceTool
    from bpy_extras.io_utils import ExportHelper as ExportHelper
    from bpy_extras.io_utils import ImportHelper as ImportHelper
