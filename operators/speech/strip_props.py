"""Speech on the timeline: strips of words, words of sounds, each with its time.

A word's sounds are kept as shares of it, so that they follow wherever the word goes; what is typed are seconds.
"""

from __future__ import annotations

import contextlib
import uuid
from collections.abc import Iterator
from typing import cast

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

from ...mpeg4 import VISEMES
from ...mpeg4.high_level import Viseme
from ...scene.blender_types import Sound
from ...scene.sounds import move_sound, mute_sound
from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Context, Entries
from ..changes import retimed

#: Seconds of the shortest word; the share of a word that its shortest sound has.
LEAST_WORD, LEAST_SHARE = 0.02, 0.02
#: Visemes from this number on are vowels.
FIRST_VOWEL = 10
#: How far a strip may be stretched.
STRETCH = (0.25, 4.0)

_writing = False


@contextlib.contextmanager
def written_at_once() -> Iterator[None]:
    """Many changes, of which nobody is told: whoever makes them calls `edited` at the end."""
    global _writing
    before, _writing = _writing, True
    try:
        yield
    finally:
        _writing = before


def edited(owner: PropertyGroup, context: Context | None = None) -> None:
    """Something said on a face is another: what was worked out of it is void, and the listeners are told."""
    if not _writing:
        owner.id_data.risorius.speech.edited = uuid.uuid4().hex
        retimed(owner, context)


def _named(viseme: Viseme) -> str:
    """A viseme by its number, its sounds and a word."""
    return f"{viseme.number} {' '.join(viseme.phonemes)} ({viseme.examples[0]})"


#: Rest, then the standard's fourteen.
VISEME_ITEMS = [
    ("0", "Rest", "Mouth at rest"),
    *(
        (str(number), _named(viseme), f"As in {', '.join(viseme.examples)}")
        for number, viseme in VISEMES.items()
        if number
    ),
]


def _parent(owner: PropertyGroup) -> PropertyGroup:
    """The group in whose list another one is."""
    return cast("PropertyGroup", owner.id_data.path_resolve(owner.path_from_id().rpartition(".")[0]))


def _place(owner: PropertyGroup) -> int:
    """Its number in that list."""
    return int(owner.path_from_id().rpartition("[")[2].rstrip("]"))


def _viseme_chosen(owner: RISORIUS_PG_said_sound, context: Context) -> None:
    """Another viseme is shown in full, whatever the sound before was."""
    if not _writing:
        with written_at_once():
            owner.symbol, owner.jaw, owner.lips, owner.own = owner.viseme, 1.0, 1.0, True
            owner.vowel = int(owner.viseme) >= FIRST_VOWEL
        edited(owner, context)


def _seconds(share: str) -> object:
    """A sound's time as it is shown: seconds from the beginning of the strip's sound."""

    def get(owner: RISORIUS_PG_said_sound) -> float:
        word = cast("RISORIUS_PG_said_word", _parent(owner))
        return float(word.begins + getattr(owner, share) * (word.ends - word.begins))

    def set_(owner: RISORIUS_PG_said_sound, value: float) -> None:
        word, number = cast("RISORIUS_PG_said_word", _parent(owner)), _place(owner)
        wanted = (value - word.begins) / max(word.ends - word.begins, 1e-9)
        if share == "first":
            before = word.sounds[number - 1].last if number else 0.0
            owner.first = max(before, min(wanted, owner.last - LEAST_SHARE))
        else:
            after = word.sounds[number + 1].first if number + 1 < len(word.sounds) else 1.0
            owner.last = min(after, max(wanted, owner.first + LEAST_SHARE))

    name, end = ("Start (s)", "begins") if share == "first" else ("End (s)", "ends")
    return FloatProperty(
        name=name,
        description=f"When the sound {end}, in seconds of the strip. It stays between its neighbours and in its word",
        get=get,
        set=set_,
        step=1,
        precision=3,
        update=edited,
    )


def _word_seconds(time: str) -> object:
    """A word's time as it is shown, between its neighbours; its sounds follow."""

    def get(owner: RISORIUS_PG_said_word) -> float:
        return float(getattr(owner, time))

    def set_(owner: RISORIUS_PG_said_word, value: float) -> None:
        strip, number = cast("RISORIUS_PG_speech_strip", _parent(owner)), _place(owner)
        if time == "begins":
            before = strip.words[number - 1].ends if number else 0.0
            owner.begins = max(before, min(value, owner.ends - LEAST_WORD))
            return
        after = strip.words[number + 1].begins if number + 1 < len(strip.words) else float("inf")
        owner.ends = min(after, max(value, owner.begins + LEAST_WORD))
        strip.duration = max(strip.duration, owner.ends)

    return FloatProperty(
        name="Start (s)" if time == "begins" else "End (s)",
        description=f"When the word {time}, in seconds of the strip. Stays between its neighbours; its sounds follow",
        get=get,
        set=set_,
        step=2,
        precision=3,
        update=edited,
    )


def _strength(what: str) -> object:
    """How distinctly something is said."""
    return FloatProperty(
        name="Strength",
        description=f"How far the mouth goes for this {what}: 0 stays at rest, 1 as usual, 2 twice as far",
        default=1.0,
        min=0.0,
        max=2.0,
        update=edited,
    )


class RISORIUS_PG_said_sound(PropertyGroup):
    """A sound of a word: its mouth, and from which share of the word to which."""

    symbol: Annotated[
        str, StringProperty(name="Symbol", description="The sound, as an alphabet of phonetics writes it")
    ]
    viseme: Annotated[
        str,
        EnumProperty(
            name="Viseme",
            description="Mouth that shows, one of the standard's fourteen",
            items=VISEME_ITEMS,
            update=_viseme_chosen,
        ),
    ]
    first: Annotated[float, FloatProperty(default=0.0, min=0.0, max=1.0, options={"HIDDEN"})]
    last: Annotated[float, FloatProperty(default=1.0, min=0.0, max=1.0, options={"HIDDEN"})]
    start: Annotated[float, _seconds("first")]
    end: Annotated[float, _seconds("last")]
    strength: Annotated[float, _strength("sound")]
    stress: Annotated[
        float,
        FloatProperty(
            name="Stress",
            description="1 for the main stress of a word, 0.5 for a secondary one, else 0. Stress opens the jaw more, "
            "and brows and head may beat on it",
            default=0.0,
            min=0.0,
            max=1.0,
            update=edited,
        ),
    ]
    jaw: Annotated[float, FloatProperty(default=1.0, options={"HIDDEN"})]
    lips: Annotated[float, FloatProperty(default=1.0, options={"HIDDEN"})]
    own: Annotated[bool, BoolProperty(default=True, options={"HIDDEN"})]
    vowel: Annotated[bool, BoolProperty(default=False, options={"HIDDEN"})]


class RISORIUS_PG_said_word(PropertyGroup):
    """A word: its letters, when it is said, how distinctly, and its sounds."""

    name: Annotated[str, StringProperty(name="Word", description="Letters of the word. Pronounce makes its sounds")]
    begins: Annotated[float, FloatProperty(default=0.0, min=0.0, options={"HIDDEN"})]
    ends: Annotated[float, FloatProperty(default=0.1, min=0.0, options={"HIDDEN"})]
    start: Annotated[float, _word_seconds("begins")]
    end: Annotated[float, _word_seconds("ends")]
    strength: Annotated[float, _strength("word")]
    sounds: Annotated[
        Entries[RISORIUS_PG_said_sound],
        CollectionProperty(type=RISORIUS_PG_said_sound, name="Sounds", description="Sounds of the word, in order"),
    ]
    active: Annotated[int, IntProperty(name="Active Sound", description="Sound that is being edited", default=0, min=0)]


def _parted(owner: RISORIUS_PG_speech_strip) -> None:
    """Its sound is its own, not that of a copy of its face, too."""
    from .sharing import part_sound  # which knows strips

    part_sound(owner)


def _moved(owner: RISORIUS_PG_speech_strip, context: Context) -> None:
    """The sound follows its strip."""
    if not _writing:
        _parted(owner)
        move_sound(bpy.data.scenes, owner.tag, owner.start)
        edited(owner, context)


def _muted(owner: RISORIUS_PG_speech_strip, context: Context) -> None:
    """A strip that is muted is not heard, either."""
    if not _writing:
        _parted(owner)
        mute_sound(bpy.data.scenes, owner.tag, mute=owner.mute)
        edited(owner, context)


class RISORIUS_PG_speech_strip(PropertyGroup):
    """Something said in time; saved with the face."""

    name: Annotated[
        str, StringProperty(name="Name", description="Name of the strip and of its marker. Empty: its first words")
    ]
    start: Annotated[
        int,
        IntProperty(
            name="Start Frame", description="Frame at which the speech and its sound start", default=1, update=_moved
        ),
    ]
    stretch: Annotated[
        float,
        FloatProperty(
            name="Stretch",
            description="How many times longer the speech lasts. Fit Sound stretches its sound, too, at its pitch",
            default=1.0,
            min=STRETCH[0],
            max=STRETCH[1],
            step=1,
            update=edited,
        ),
    ]
    mute: Annotated[
        bool,
        BoolProperty(
            name="Mute", description="Leave this speech out of playback and bakes, with its sound", update=_muted
        ),
    ]
    duration: Annotated[float, FloatProperty(default=0.0, min=0.0, options={"HIDDEN"})]
    words: Annotated[
        Entries[RISORIUS_PG_said_word],
        CollectionProperty(type=RISORIUS_PG_said_word, name="Words", description="What is said, word by word"),
    ]
    active: Annotated[int, IntProperty(name="Active Word", description="Word that is being edited", default=0, min=0)]
    voice: Annotated[str, StringProperty(default="en", options={"HIDDEN"})]
    tag: Annotated[str, StringProperty(options={"HIDDEN"})]
    fitted: Annotated[float, FloatProperty(default=1.0, options={"HIDDEN"})]
    sound: Annotated[
        Sound | None,
        PointerProperty(type=bpy.types.Sound, name="Sound", description="The sound as it was recorded or spoken"),
    ]


def active_strip(strips: Entries[RISORIUS_PG_speech_strip], active: int) -> RISORIUS_PG_speech_strip | None:
    """The strip that is being edited, or None."""
    return strips[active] if active < len(strips) else None


def active_word(strip: RISORIUS_PG_speech_strip | None) -> RISORIUS_PG_said_word | None:
    """The word that is being edited, or None."""
    return strip.words[strip.active] if strip is not None and strip.active < len(strip.words) else None


def active_sound(word: RISORIUS_PG_said_word | None) -> RISORIUS_PG_said_sound | None:
    """The sound that is being edited, or None."""
    return word.sounds[word.active] if word is not None and word.active < len(word.sounds) else None
