"""The clips of a face's timeline: an emotion each, and when it shows."""

from __future__ import annotations

from typing import Annotated, Any

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ...mpeg4.timing import Ramp, load_timings
from ..bake.props import seconds
from ..blender_types import Entries
from ..changes import retimed
from ..emotion.props import RISORIUS_PG_emotion

_TIMING = load_timings()["natural"]


def _chosen(owner: Any, context: Any) -> None:
    """Another clip is the one being edited."""
    from .linked import show_clip

    show_clip(owner.id_data)


def _renamed(owner: Any, context: Any) -> None:
    """What is written on its bar is another name; the face stays as it is shown."""
    from .drawing import redraw

    redraw()


class RISORIUS_PG_clip(bpy.types.PropertyGroup):
    """One expression in time."""

    name: Annotated[
        str,
        StringProperty(
            name="Name",
            description="What the clip, its marker and its strip are called. Empty: named after the emotion",
            update=_renamed,
        ),
    ]
    emotion: Annotated[RISORIUS_PG_emotion, PointerProperty(type=RISORIUS_PG_emotion)]
    start: Annotated[
        int,
        IntProperty(
            name="Start Frame", description="Frame at which the expression begins to show", default=1, update=retimed
        ),
    ]
    onset: Annotated[float, seconds("Onset (s)", "Seconds until it is full", _TIMING.onset, update=retimed)]
    apex: Annotated[float, seconds("Apex (s)", "Seconds that it is held", _TIMING.apex, update=retimed)]
    offset: Annotated[float, seconds("Offset (s)", "Seconds until it is gone", _TIMING.offset, update=retimed)]
    peak: Annotated[
        float,
        FloatProperty(
            name="Peak",
            description="How much of the expression shows at its apex, from 0 (nothing) to 1 (all of it)",
            default=_TIMING.peak,
            min=0.0,
            max=1.0,
            update=retimed,
        ),
    ]
    ramp: Annotated[
        str,
        EnumProperty(
            name="Ramp",
            description="How the expression comes and goes",
            items=(
                (Ramp.MINIMUM_JERK.value, "Brisk", "As aimed movements go: still at both ends, quick in between"),
                (Ramp.COSINE.value, "Gentle", "More evenly, as felt expressions come and go"),
            ),
            default=_TIMING.ramp.value,
            update=retimed,
        ),
    ]
    mute: Annotated[
        bool, BoolProperty(name="Mute", description="Leave this clip out of playback and of bakes", update=retimed)
    ]
    solo: Annotated[
        bool,
        BoolProperty(
            name="Solo", description="Play and bake only this clip, and others that are solo too", update=retimed
        ),
    ]


def _amount(name: str, description: str, most: float, **options: Any) -> Any:
    """How much of a variation."""
    return FloatProperty(name=name, description=description, default=0.0, min=0.0, max=most, precision=2, **options)


def _seed(what: str, **options: Any) -> Any:
    """From which number it is drawn."""
    return IntProperty(name="Seed", description=f"Another number draws other {what}", default=1, min=0, **options)


class RISORIUS_PG_variation(bpy.types.PropertyGroup):
    """What makes the performance look alive; nothing of it unless it is asked for."""

    draws: Annotated[
        float,
        _amount(
            "Draws",
            "How far each expression departs from the typical one: 0 not at all, 1 anywhere within the emotion's "
            "ranges. Clips with a seed of their own keep it",
            1.0,
            update=retimed,
        ),
    ]
    draws_seed: Annotated[int, _seed("expressions", update=retimed)]
    blinks: Annotated[
        float,
        _amount(
            "Blinks (/min)",
            "Blinks per minute: people at rest blink 17 times, in conversation 26 times, when reading 4.5 times. "
            "Seen in a baked motion",
            60.0,
            step=100,
        ),
    ]
    blinks_seed: Annotated[int, _seed("blinks")]
    head: Annotated[
        float,
        _amount(
            "Head",
            "Small turns of the head: 1 is about one degree, as of someone who holds still. Seen in a baked motion",
            5.0,
        ),
    ]
    head_seed: Annotated[int, _seed("turns")]
    eyes: Annotated[
        float,
        _amount(
            "Eyes",
            "Small movements of the eyes: 1 looks about two degrees aside and back. Seen in a baked motion",
            5.0,
        ),
    ]
    eyes_seed: Annotated[int, _seed("looks")]


class RISORIUS_PG_timeline(bpy.types.PropertyGroup):
    """The clips of one face, and which of them is being edited."""

    clips: Annotated[
        Entries[RISORIUS_PG_clip],
        CollectionProperty(
            type=RISORIUS_PG_clip, name="Clips", description="Expressions in time; where they overlap they blend"
        ),
    ]
    active: Annotated[
        int,
        IntProperty(name="Active Clip", description="The clip that is being edited", default=0, min=0, update=_chosen),
    ]
    linked: Annotated[
        bool,
        BoolProperty(
            name="Edit in Emotion Panel",
            description="The Emotion panel shows the emotion of the selected clip, and what is changed there changes "
            "the clip. Off: the panel is free to try something out, and clips stay as they are",
            default=True,
            update=_chosen,
        ),
    ]
    variation: Annotated[RISORIUS_PG_variation, PointerProperty(type=RISORIUS_PG_variation)]


def active_clip(timeline: Any) -> Any | None:
    """The clip that is being edited, or None."""
    return timeline.clips[timeline.active] if timeline.active < len(timeline.clips) else None


def sounding(timeline: Any) -> list[Any]:
    """The clips that play: those that are solo where any is, else those that are not muted."""
    solo = [clip for clip in timeline.clips if clip.solo]
    return solo or [clip for clip in timeline.clips if not clip.mute]
