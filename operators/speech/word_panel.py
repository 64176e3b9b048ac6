"""The panel of words: those of the selected speech, and the sounds of the selected word."""

from __future__ import annotations

from ..active import active_object
from ..blender_classes import Panel, UIList
from ..blender_types import Context, UILayout
from ..sidebar import MeshSidebar
from .strip_ops import chosen_strip
from .strip_props import (
    RISORIUS_PG_said_sound,
    RISORIUS_PG_said_word,
    RISORIUS_PG_speech_strip,
    active_sound,
    active_word,
)
from .strips import title_of_word
from .word_ops import (
    RISORIUS_OT_add_sound,
    RISORIUS_OT_insert_word,
    RISORIUS_OT_join_words,
    RISORIUS_OT_pronounce_word,
    RISORIUS_OT_remove_sound,
    RISORIUS_OT_remove_word,
    RISORIUS_OT_select_word,
    RISORIUS_OT_split_word,
)

#: Rows of the lists.
ROWS = 5


class RISORIUS_UL_words(UIList):
    """Words of the selected speech: letters, start, strength."""

    def draw_item(
        self,
        context: Context,
        layout: UILayout,
        data: RISORIUS_PG_speech_strip,
        item: RISORIUS_PG_said_word,
        icon: int,
        active_data: object,
        active_property: str,
    ) -> None:
        """One word."""
        split = layout.split(factor=0.5, align=True)
        split.label(text=title_of_word(item))
        row = split.row(align=True)
        row.label(text=f"{item.begins:.2f}")
        row.prop(item, "strength", text="", emboss=False)


class RISORIUS_UL_said_sounds(UIList):
    """Sounds of the selected word: symbol, viseme, strength."""

    def draw_item(
        self,
        context: Context,
        layout: UILayout,
        data: RISORIUS_PG_said_word,
        item: RISORIUS_PG_said_sound,
        icon: int,
        active_data: object,
        active_property: str,
    ) -> None:
        """One sound."""
        split = layout.split(factor=0.16, align=True)
        split.label(text=item.symbol)
        row = split.split(factor=0.72, align=True)
        row.prop(item, "viseme", text="")
        row.prop(item, "strength", text="", emboss=False)


class RISORIUS_PT_words(MeshSidebar, Panel):
    """The words of the selected speech."""

    bl_label = "Words"
    bl_parent_id = "RISORIUS_PT_speech"

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Only with speech on the timeline."""
        return context.object is not None and super().poll(context) and chosen_strip(context.object) is not None

    def draw(self, context: Context) -> None:
        """The list of words, then the selected one, then its sounds."""
        layout, strip = self.layout, chosen_strip(active_object(context))
        if strip is None:
            return
        row = layout.row()
        row.template_list("RISORIUS_UL_words", "", strip, "words", strip, "active", rows=ROWS)
        side = row.column(align=True)
        side.operator(RISORIUS_OT_insert_word.bl_idname, text="", icon="ADD")
        side.operator(RISORIUS_OT_remove_word.bl_idname, text="", icon="REMOVE")
        side.operator(RISORIUS_OT_select_word.bl_idname, text="", icon="EYEDROPPER")
        word = active_word(strip)
        if word is not None:
            self._draw_word(layout, word)
            self._draw_sounds(layout, word)

    def _draw_word(self, layout: UILayout, word: RISORIUS_PG_said_word) -> None:
        """Its letters and times."""
        row = layout.row(align=True)
        row.operator(RISORIUS_OT_split_word.bl_idname, text="Split", icon="UNLINKED")
        row.operator(RISORIUS_OT_join_words.bl_idname, icon="LINKED")
        row = layout.row(align=True)
        row.prop(word, "name", text="", placeholder=title_of_word(word))
        row.operator(RISORIUS_OT_pronounce_word.bl_idname, icon="SPEAKER")
        column = layout.column(align=True)
        column.use_property_split, column.use_property_decorate = True, False
        for name in ("start", "end"):
            column.prop(word, name)
        column.prop(word, "strength", slider=True)

    def _draw_sounds(self, layout: UILayout, word: RISORIUS_PG_said_word) -> None:
        """The list of its sounds, and the selected one."""
        row = layout.row()
        row.template_list("RISORIUS_UL_said_sounds", "", word, "sounds", word, "active", rows=ROWS - 1)
        side = row.column(align=True)
        side.operator(RISORIUS_OT_add_sound.bl_idname, text="", icon="ADD")
        side.operator(RISORIUS_OT_remove_sound.bl_idname, text="", icon="REMOVE")
        sound = active_sound(word)
        if sound is not None:
            column = layout.column(align=True)
            column.use_property_split, column.use_property_decorate = True, False
            for name in ("start", "end"):
                column.prop(sound, name)
            column.prop(sound, "strength", slider=True)
            column.prop(sound, "stress", slider=True)
