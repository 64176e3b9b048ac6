"""Panels that show what the face shows: beliefs, FAPs, features."""

from __future__ import annotations

import math
import textwrap

from ...scene.live.belief_curves import has_curves
from ...scene.live.reading import Reading
from ..active import active_object
from ..blender_classes import Panel
from ..blender_types import Context, UILayout
from ..sidebar import LINE, MeshSidebar
from . import live
from .ops import RISORIUS_OT_clear_reading, RISORIUS_OT_read_animation, RISORIUS_OT_show_beliefs

#: Words that are named besides the six.
CLOSEST = 4
#: So many FAPs are marked, those that speak most for (or against) the most believed emotion, by at least this much.
DECISIVE, LEAST = 5, 0.1


class RISORIUS_PT_read(MeshSidebar, Panel):
    """Beliefs that follow the frame, and the button that reads them all."""

    bl_label = "Read Expression"
    bl_parent_id = "RISORIUS_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """The rule, what is believed now, then the animation."""
        layout, chosen = self.layout, context.scene.risorius.read
        layout.row().prop(chosen, "rule", expand=True)
        reading, trouble = live.shown(active_object(context))
        if reading is not None:
            self._draw_beliefs(layout, reading)
            self._draw_words(layout, reading)
        else:
            column = layout.column(align=True)
            for index, line in enumerate(textwrap.wrap(trouble or "Reading ...", LINE)):
                column.label(text=line, icon="BLANK1" if index else "INFO")
        self._draw_animation(layout, context)

    def _draw_beliefs(self, layout: UILayout, reading: Reading) -> None:
        """What is most believed, and a bar for each of the six."""
        best, neutral = reading.beliefs.best, reading.beliefs.neutral
        row = layout.row()
        if best is not None and not reading.beliefs.best_profile:
            row.label(text="Neutral", icon="CHECKMARK")
        elif reading.is_resting or best is None:
            row.label(text="At rest: almost no expression", icon="INFO")
        else:
            row.label(text=best.capitalize(), icon="CHECKMARK")
            row.label(text=f"strength {reading.strength:.0%}")
        column = layout.column(align=True)
        column.active = neutral is not None or not reading.is_resting
        bars = [(name.capitalize(), belief) for name, belief in reading.beliefs.items()]
        for name, belief in bars if neutral is None else [*bars, ("Neutral", neutral)]:
            split = column.split(factor=0.3, align=True)
            split.label(text=name)
            split.progress(factor=belief, type="BAR", text=f"{belief:.3f}")

    def _draw_words(self, layout: UILayout, reading: Reading) -> None:
        """The closest words that are none of the six."""
        if reading.is_resting:
            return
        others = [(word, belief) for word, belief in reading.words.items() if word not in reading.beliefs][:CLOSEST]
        box = layout.box().column(align=True)
        box.label(text="Closest other words (robust rule)")
        for word, belief in others:
            split = box.split(factor=0.6)
            split.label(text=word)
            split.label(text=f"{belief:.2f}")

    def _draw_animation(self, layout: UILayout, context: Context) -> None:
        """The button, files that it may write, and what there is."""
        chosen = context.scene.risorius.read
        row = layout.row()
        row.scale_y = 1.3
        row.operator(RISORIUS_OT_read_animation.bl_idname, icon="FCURVE")
        column = layout.column(align=True)
        column.use_property_split, column.use_property_decorate = True, False
        column.label(text="Files to write:")
        for name in ("stream", "table", "plot"):
            column.prop(chosen, name)
        if has_curves(active_object(context)):
            row = layout.row(align=True)
            row.operator(RISORIUS_OT_show_beliefs.bl_idname, icon="IMAGE_DATA")
            row.operator(RISORIUS_OT_clear_reading.bl_idname, text="", icon="X")


class RISORIUS_PT_read_faps(MeshSidebar, Panel):
    """FAPs beside the ranges of the profile that is most believed, those that decide marked."""

    bl_label = "FAPs"
    bl_parent_id = "RISORIUS_PT_read"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """A row per FAP."""
        from ... import api

        layout, chosen = self.layout, context.scene.risorius.read
        layout.prop(chosen, "all_faps")
        reading, _ = live.shown(active_object(context))
        if reading is None:
            return
        profile, decisive = reading.beliefs.best_profile, reading.beliefs.decisive
        ranges = profile.ranges if profile is not None else {}
        weighty = list(decisive.items())[:DECISIVE]
        marked = {number: "+ " if speaks > 0.0 else "- " for number, speaks in weighty if abs(speaks) >= LEAST}
        seen = {number for number in api.FAPS if not math.isnan(reading.faps[number - 1])}
        column = layout.column(align=True)
        _row(column, "", "shown", "asked")
        for number in sorted(seen if chosen.all_faps else {*ranges, *marked}):
            value = f"{reading.faps[number - 1]:.0f}" if number in seen else "unseen"
            asked = _range(*ranges[number]) if number in ranges else ""
            _row(column, f"{marked.get(number, '')}{number} {api.fap(number).name}", value, asked)
        if profile is not None:
            layout.label(text=f"+ supports {reading.beliefs.best}, - opposes it")


class RISORIUS_PT_read_features(MeshSidebar, Panel):
    """The fifteen features of the first paper: how distances of feature points have changed."""

    bl_label = "Features"
    bl_parent_id = "RISORIUS_PT_read"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """A row per feature."""
        from ... import api

        reading, _ = live.shown(active_object(context))
        column = self.layout.column(align=True)
        if reading is None or reading.features is None:
            column.label(text="" if reading is None else "The face lacks points for features", icon="INFO")
            return
        for feature, value in zip(api.FEATURES, reading.features, strict=True):
            points = f"{feature.point_a} to {feature.point_b}"
            _row(column, f"f{feature.number}  {points}", f"{value:.0f}", str(feature.unit))


def _range(low: float, high: float) -> str:
    """A range as its middle and half of its length: ends of four figures and a sign do not fit into a sidebar."""
    return f"{(low + high) / 2.0:.0f}±{(high - low) / 2.0:.0f}"


def _row(column: UILayout, name: str, value: str, beside: str) -> None:
    """A name, a value, and what stands beside it."""
    split = column.split(factor=0.57, align=True)
    split.label(text=name)
    right = split.split(factor=0.42, align=True)
    for text in (value, beside):
        row = right.row()
        row.alignment = "RIGHT"
        row.label(text=text)
