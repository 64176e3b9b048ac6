"""The clips of a face's timeline: an emotion each, and when it shows."""

from __future__ import annotations

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
from ..annotated import Annotated
from ..bake.props import seconds
from ..blender_classes import PropertyGroup
from ..blender_types import Context, Entries
from ..changes import retimed
from ..emotion.props import RISORIUS_PG_emotion
from ..screen import redraw_timelines

_TIMING = load_timings()["natural"]


def _chosen(owner: RISORIUS_PG_timeline, context: Context) -> None:
    """Another clip is the one being edited."""
    from .linked import show_clip

    show_clip(owner.id_data)


class RISORIUS_PG_clip(PropertyGroup):
    """One expression in time."""

    name: Annotated[
        str,
        StringProperty(
            name="Name",
            description="Name of the clip, its marker and its strip. Empty: the name of the emotion",
            update=redraw_timelines,
        ),
    ]
    emotion: Annotated[RISORIUS_PG_emotion, PointerProperty(type=RISORIUS_PG_emotion)]
    start: Annotated[
        int,
        IntProperty(name="Start Frame", description="Frame at which the expression starts", default=1, update=retimed),
    ]
    onset: Annotated[
        float, seconds("Onset (s)", "Seconds from the start to the full expression", _TIMING.onset, update=retimed)
    ]
    apex: Annotated[
        float, seconds("Apex (s)", "Seconds for which the expression is held", _TIMING.apex, update=retimed)
    ]
    offset: Annotated[
        float, seconds("Offset (s)", "Seconds until the expression has faded", _TIMING.offset, update=retimed)
    ]
    peak: Annotated[
        float,
        FloatProperty(
            name="Peak",
            description="Share of the expression that shows at the apex, from 0 (none) to 1 (full)",
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
            description="Curve along which the expression appears and fades",
            items=(
                (Ramp.MINIMUM_JERK.value, "Brisk", "Like an aimed movement: slow at both ends, fast in between"),
                (Ramp.COSINE.value, "Gentle", "More even, like a felt expression"),
            ),
            default=_TIMING.ramp.value,
            update=retimed,
        ),
    ]
    mute: Annotated[
        bool, BoolProperty(name="Mute", description="Leave this clip out of playback and bakes", update=retimed)
    ]
    solo: Annotated[
        bool,
        BoolProperty(name="Solo", description="Play and bake only this clip and other solo clips", update=retimed),
    ]


def _amount(name: str, description: str, most: float, **options: object) -> object:
    """How much of a variation."""
    return FloatProperty(name=name, description=description, default=0.0, min=0.0, max=most, precision=2, **options)


def _seed(what: str, **options: object) -> object:
    """From which number it is drawn."""
    return IntProperty(
        name="Seed", description=f"Random seed: another number draws different {what}", default=1, min=0, **options
    )


class RISORIUS_PG_variation(PropertyGroup):
    """What makes the performance look alive; nothing of it unless it is asked for."""

    draws: Annotated[
        float,
        _amount(
            "Expressions",
            "How far each expression differs from the typical one: 0 not at all, 1 anywhere within the "
            "emotion's ranges, in any of the ways people show it. Clips with their own seed keep it",
            1.0,
            update=retimed,
        ),
    ]
    draws_seed: Annotated[int, _seed("expressions", update=retimed)]
    blinks: Annotated[
        float,
        _amount(
            "Blinks (/min)",
            "Blinks per minute: people blink 17 times at rest, 26 times in conversation, 4.5 times while "
            "reading. Only in a baked motion",
            60.0,
            step=100,
        ),
    ]
    blinks_seed: Annotated[int, _seed("blinks")]
    head: Annotated[
        float,
        _amount(
            "Head",
            "Small turns of the head: 1 is about one degree, like a person who holds still. Words such as bashful or "
            "bored turn it, too. Only in a baked motion",
            5.0,
        ),
    ]
    head_seed: Annotated[int, _seed("turns")]
    eyes: Annotated[
        float,
        _amount(
            "Eyes",
            "Small movements of the eyes: 1 looks about two degrees to the side and back. Words such as bashful or "
            "bored look away, too. Only in a baked motion",
            5.0,
        ),
    ]
    eyes_seed: Annotated[int, _seed("looks")]


class RISORIUS_PG_timeline(PropertyGroup):
    """The clips of one face, and which of them is being edited."""

    clips: Annotated[
        Entries[RISORIUS_PG_clip],
        CollectionProperty(
            type=RISORIUS_PG_clip, name="Clips", description="Expressions in time; where they overlap they blend"
        ),
    ]
    active: Annotated[
        int,
        IntProperty(name="Active Clip", description="Clip that is being edited", default=0, min=0, update=_chosen),
    ]
    linked: Annotated[
        bool,
        BoolProperty(
            name="Edit in Emotion Panel",
            description="Edit the emotion of the selected clip in the Emotion panel. If off, the panel is free "
            "for trying things out and does not change the clips",
            default=True,
            update=_chosen,
        ),
    ]
    variation: Annotated[RISORIUS_PG_variation, PointerProperty(type=RISORIUS_PG_variation)]


def active_clip(timeline: RISORIUS_PG_timeline) -> RISORIUS_PG_clip | None:
    """The clip that is being edited, or None."""
    return timeline.clips[timeline.active] if timeline.active < len(timeline.clips) else None


def playing_clips(timeline: RISORIUS_PG_timeline) -> list[RISORIUS_PG_clip]:
    """The clips that play: those that are solo where any is, else those that are not muted."""
    solo = [clip for clip in timeline.clips if clip.solo]
    return solo or [clip for clip in timeline.clips if not clip.mute]
