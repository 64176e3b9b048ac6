"""Which feature point the mouse is over, whatever tool is in hand.

Draw handlers are not told of the mouse. A gizmo is: Blender asks it at every move whether the mouse is over it, and
draws the viewport again when that changes. Clicks go on to the tool in hand.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack

from ...mpeg4 import FEATURE_POINTS
from ..blender_classes import Gizmo, GizmoGroup
from ..blender_types import Context, KeyConfig, KeyMap
from ..gizmo_keys import forget_keymap
from .overlay import hover, point_at, shows_points

NAMES = tuple(FEATURE_POINTS)
#: A keymap of its own, and a key that keyboards do not have.
_KEYMAP, _NO_KEY = "Risorius Point Names", "F24"


class RISORIUS_GT_point_names(Gizmo):
    """Nothing to be grasped: it only tells which point the mouse is over."""

    bl_idname = "RISORIUS_GT_point_names"

    def test_select(self, context: Context, location: Sequence[int]) -> int:
        """The point under the mouse, as its place in the standard's list; -1 for none."""
        name = point_at(context, (float(location[0]), float(location[1])))
        hover(name)
        return -1 if name is None else NAMES.index(name)

    def draw(self, context: Context) -> None:
        """The overlay writes the name, over the points; here the mouse is known to have left the viewport."""
        if not self.is_highlight:
            hover(None)


class RISORIUS_GGT_point_names(GizmoGroup):
    """There while points are shown."""

    bl_idname = "RISORIUS_GGT_point_names"
    bl_label = "Feature Point Names"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"PERSISTENT"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Only while points are shown."""
        return shows_points(context)

    @classmethod
    def setup_keymap(cls, keyconfig: KeyConfig) -> KeyMap:
        """No mouse button, so every click is for the tool in hand; a key, for Blender does not ask gizmos without."""
        keymap = keyconfig.keymaps.new(_KEYMAP, space_type="VIEW_3D", region_type="WINDOW")
        if len(keymap.keymap_items) == 0:
            keymap.keymap_items.new("gizmogroup.gizmo_tweak", _NO_KEY, "PRESS")
        return keymap

    def setup(self, context: Context) -> None:
        """The one gizmo."""
        self.gizmos.new(RISORIUS_GT_point_names.bl_idname)


def attach(undo: ExitStack) -> None:
    """Blender puts the gizmo into every 3D viewport by itself; its keys go when that is undone."""
    undo.callback(forget_keymap, _KEYMAP)
