"""Operators on the words of speech on the timeline, and on their sounds."""

from __future__ import annotations

from dataclasses import replace

from bpy.props import StringProperty

from ...errors import RisoriusError, SceneError
from ...scene.bake.timing import scene_fps
from ...scene.blender_types import Event
from ...speech.line import Line, LineWord, word_of
from ...speech.phonemes import Phoneme
from ...speech.utterance import Sound
from ..annotated import Annotated
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context
from .strip_ops import StripOperator, strip_of
from .strip_props import RISORIUS_PG_said_word, RISORIUS_PG_speech_strip, active_word, edited
from .strips import read_line, title_of_word, write_line

#: The viseme of an open mouth, and what a sound without a symbol of its own is called.
OPEN = Phoneme("10", 10, vowel=True)
#: Seconds that a word lasts for each of its letters where no voice says how long.
LETTER = 0.07


class WordOperator(StripOperator):
    """What the operators on the active word share."""

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where a word is selected."""
        reason = super().refusal(context)
        if reason is not None:
            return reason
        return None if active_word(strip_of(context)) is not None else "This speech has no words: insert one"


def moment(context: Context, strip: RISORIUS_PG_speech_strip) -> float:
    """Seconds of a strip at the current frame, as it was before it was stretched."""
    return float((context.scene.frame_current_final - strip.start) / scene_fps(context.scene) / strip.stretch)


def word_at(context: Context) -> tuple[RISORIUS_PG_speech_strip, RISORIUS_PG_said_word]:
    """The strip and the word that are edited.

    Raises
    ------
    SceneError : there is none.
    """
    strip = strip_of(context)
    word = active_word(strip)
    if word is None:
        raise SceneError("Speech", "has no words: insert one")
    return strip, word


class RISORIUS_OT_select_word(WordOperator, Operator):
    """Select the word at the current frame"""

    bl_idname = "risorius.select_word"
    bl_label = "Select Word at Current Frame"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context: Context) -> str:
        """The one that lasts there, or else the nearest one."""
        strip = strip_of(context)
        at = moment(context, strip)
        away = [max(word.begins - at, at - word.ends, 0.0) for word in strip.words]
        strip.active = away.index(min(away))
        return f"Selected {title_of_word(strip.words[strip.active])}"


class RISORIUS_OT_split_word(WordOperator, Operator):
    """Split the selected word in two at the current frame, or in its middle"""

    bl_idname = "risorius.split_word"
    bl_label = "Split Word"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context: Context) -> str:
        """Split it."""
        strip, word = word_at(context)
        title, at = title_of_word(word), moment(context, strip)
        if not word.begins < at < word.ends:
            at = (word.begins + word.ends) / 2.0
        write_line(strip, read_line(strip).split(strip.active, at))
        one, other = (title_of_word(strip.words[strip.active + k]) for k in (0, 1))
        return f"Split {title} into {one} and {other}"


class RISORIUS_OT_join_words(WordOperator, Operator):
    """Join the selected word with the next one"""

    bl_idname = "risorius.join_words"
    bl_label = "Join with Next"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context: Context) -> str:
        """Join them."""
        strip, _ = word_at(context)
        write_line(strip, read_line(strip).joined(strip.active))
        return f"Joined {title_of_word(strip.words[strip.active])}"


class RISORIUS_OT_remove_word(WordOperator, Operator):
    """Remove the selected word: the mouth pauses there. The sound stays"""

    bl_idname = "risorius.remove_word"
    bl_label = "Remove Word"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context: Context) -> str:
        """Remove it; the one after it, or the last, is selected then."""
        strip, word = word_at(context)
        title = title_of_word(word)
        strip.words.remove(strip.active)
        strip.active = max(0, min(strip.active, len(strip.words) - 1))
        edited(strip, context)
        return f"Removed {title}"


class RISORIUS_OT_insert_word(StripOperator, Operator):
    """Insert a word at the current frame, or after the selected one. The sound stays"""

    bl_idname = "risorius.insert_word"
    bl_label = "Insert Word"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = True

    text: Annotated[
        str,
        StringProperty(name="Word", description="Word to insert, pronounced by eSpeak NG", options={"SKIP_SAVE"}),
    ]

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask for the word."""
        return context.window_manager.invoke_props_dialog(self)

    def run(self, context: Context) -> str:
        """Insert it in the room that there is."""
        strip = strip_of(context)
        if not self.text.strip():
            raise SceneError("Word", "is empty: write one")
        line, word = read_line(strip), pronounced(self, self.text, strip)
        number, at = _place(line, moment(context, strip), int(strip.active))
        made = line.inserted(number, word.over(at, at + word.end - word.start))
        write_line(strip, made)
        strip.active = number
        return f"Inserted {title_of_word(strip.words[number])} at {strip.words[number].begins:.2f} s"


def _place(line: Line, at: float, active: int) -> tuple[int, float]:
    """Which number a new word gets, and when it starts: at a time that is in a pause, else after the selected word."""
    inside = any(word.start <= at < word.end for word in line.words)
    if line.words and (inside or not 0.0 <= at <= line.duration):
        return active + 1, line.words[active].end
    return sum(word.end <= at for word in line.words), max(at, 0.0)


def pronounced(operator: RisoriusOperator, text: str, strip: RISORIUS_PG_speech_strip) -> LineWord:
    """A word as the strip's voice says it; an open mouth where there is none, which is said.

    Raises
    ------
    ParameterError : the voice cannot say it.
    """
    from ... import api

    try:
        api.voices()
    except RisoriusError as missing:
        operator.report({"WARNING"}, f"{text}: shown as an open mouth. {missing}")
        length = LETTER * max(len(text), 1)
        return LineWord(text, 0.0, length, (Sound(0.0, length, OPEN, OPEN.symbol),))
    return word_of(api.speak(text, voice=strip.voice or "en").utterance, " ".join(text.split()))


class RISORIUS_OT_pronounce_word(WordOperator, Operator):
    """Replace the sounds of the selected word by those of its letters, as eSpeak NG pronounces them in the voice of \
the speech. Its time stays"""

    bl_idname = "risorius.pronounce_word"
    bl_label = "Pronounce"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = True

    def run(self, context: Context) -> str:
        """Pronounce it, within its time."""
        strip, word = word_at(context)
        if not word.name.strip():
            raise SceneError("Word", "has no letters: write it")
        line, number = read_line(strip), int(strip.active)
        old = line.words[number]
        new = replace(pronounced(self, word.name, strip).over(old.start, old.end), strength=old.strength)
        write_line(strip, line.with_word(number, new))
        return f"{title_of_word(strip.words[number])}: {' '.join(sound.symbol for sound in strip.words[number].sounds)}"


class RISORIUS_OT_add_sound(WordOperator, Operator):
    """Add a sound to the selected word, in the second half of the selected sound"""

    bl_idname = "risorius.add_sound"
    bl_label = "Add Sound"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context: Context) -> str:
        """Halve the selected sound; the new one has its mouth until another is chosen."""
        strip, word = word_at(context)
        line, number, place = read_line(strip), int(strip.active), int(word.active)
        said = line.words[number]
        if not said.sounds:
            sounds: tuple[Sound, ...] = (Sound(said.start, said.end, OPEN, OPEN.symbol),)
        else:
            old = said.sounds[min(place, len(said.sounds) - 1)]
            halves = replace(old, end=old.middle), replace(old, start=old.middle)
            sounds = (*said.sounds[:place], *halves, *said.sounds[place + 1 :])
        write_line(strip, line.with_word(number, replace(said, sounds=sounds)))
        strip.words[number].active = min(place + 1, len(sounds) - 1)
        return f"{title_of_word(strip.words[number])} has {len(sounds)} sounds"


class RISORIUS_OT_remove_sound(WordOperator, Operator):
    """Remove the selected sound from its word: its neighbours share the mouth"""

    bl_idname = "risorius.remove_sound"
    bl_label = "Remove Sound"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where a sound is selected."""
        reason = super().refusal(context)
        if reason is not None:
            return reason
        return None if word_at(context)[1].sounds else "This word has no sounds"

    def run(self, context: Context) -> str:
        """Remove it."""
        _, word = word_at(context)
        place = min(int(word.active), len(word.sounds) - 1)
        symbol = word.sounds[place].symbol
        word.sounds.remove(place)
        word.active = max(0, min(place, len(word.sounds) - 1))
        edited(word, context)
        return f"Removed {symbol} from {title_of_word(word)}"
