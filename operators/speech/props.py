"""What a face says, and how."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from ...errors import RisoriusError
from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Context, Entries
from ..screen import redraw_timelines
from .strip_props import RISORIUS_PG_speech_strip, edited


@lru_cache(maxsize=1)
def _known_voices() -> tuple[tuple[str, str], ...]:
    """Language codes and names of the voices; none where there is no eSpeak NG."""
    from ... import api

    try:
        return tuple(api.voices().items())
    except RisoriusError:
        return ()


def _matching(_group: PropertyGroup, _context: Context, typed: str) -> Iterable[tuple[str, str]]:
    """Voices whose code or name holds what is typed."""
    wanted = typed.lower()
    return [(code, name) for code, name in _known_voices() if wanted in code.lower() or wanted in name.lower()]


class RISORIUS_PG_speech(PropertyGroup):
    """What is said and how; saved with the face."""

    source: Annotated[
        str,
        EnumProperty(
            name="Say",
            description="What is said",
            items=(
                ("TEXT", "Text", "Say a text, in a voice of eSpeak NG"),
                ("TIMINGS", "Timings", "Say what an aligner or a lip-sync tool has timed"),
            ),
        ),
    ]
    text: Annotated[str, StringProperty(name="Text", description="Text to say")]
    voice: Annotated[
        str,
        StringProperty(
            name="Voice",
            description="Language of the voice, as en, de or fr; with a variant, as en+f3",
            default="en",
            search=_matching,
            search_options={"SUGGESTION"},
        ),
    ]
    speed: Annotated[int, IntProperty(name="Speed", description="Words per minute", default=175, min=80, max=450)]
    pitch: Annotated[int, IntProperty(name="Pitch", description="Pitch of the voice", default=50, min=0, max=99)]
    timings: Annotated[
        str,
        StringProperty(
            name="Timings",
            description="What is said when: a Praat TextGrid, Rhubarb's JSON, TSV or XML, or a table or JSON of sounds",
            subtype="FILE_PATH",
        ),
    ]
    sound: Annotated[
        str,
        StringProperty(
            name="Sound", description="The sound, from the same beginning as the timings", subtype="FILE_PATH"
        ),
    ]
    tier: Annotated[str, StringProperty(name="Tier", description="Tier of a TextGrid with the sounds. Empty: found")]
    with_feeling: Annotated[
        bool,
        BoolProperty(
            name="With Feeling",
            description="Show the clips of the timeline while speaking, or without clips the chosen emotion",
            default=True,
            update=edited,
        ),
    ]
    lean: Annotated[
        float,
        FloatProperty(
            name="Lean",
            description="How far the mouth leans to the emotion while speaking",
            default=1.0,
            min=0.0,
            max=2.0,
            update=edited,
        ),
    ]
    articulation: Annotated[
        float,
        FloatProperty(
            name="Articulation",
            description="How distinctly lips and tongue move. Lips close in any case",
            default=1.0,
            min=0.0,
            max=2.0,
            update=edited,
        ),
    ]
    jaw: Annotated[
        float,
        FloatProperty(name="Jaw", description="How far the jaw opens", default=1.0, min=0.0, max=2.0, update=edited),
    ]
    strips: Annotated[
        Entries[RISORIUS_PG_speech_strip],
        CollectionProperty(
            type=RISORIUS_PG_speech_strip,
            name="Speech",
            description="Speech on the timeline. Where two overlap, the later one cuts the other off",
        ),
    ]
    active: Annotated[
        int,
        IntProperty(
            name="Active Speech", description="Speech that is being edited", default=0, min=0, update=redraw_timelines
        ),
    ]
    edited: Annotated[str, StringProperty(options={"HIDDEN"})]
