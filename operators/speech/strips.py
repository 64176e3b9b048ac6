"""Between what strips hold and what is said: lines, and all of a face's strips as one motion of its mouth."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import blake2b

import bpy

from ...scene.sounds import is_missing
from ...speech.line import Line, LineWord, interrupted, together
from ...speech.phonemes import Phoneme
from ...speech.utterance import Sound, Utterance
from ..blender_types import Object
from .strip_props import (
    RISORIUS_PG_said_sound,
    RISORIUS_PG_said_word,
    RISORIUS_PG_speech_strip,
    edited,
    written_at_once,
)

#: Letters of what is said that name a strip, and how many performances are kept as they were worked out.
NAMED, KEPT = 24, 8
#: Digits that Blender's single precision is good for, of seconds and of shares.
DIGITS = 6


@dataclass(frozen=True, eq=False)
class Speech:
    """All that the strips of a face say.

    Attributes
    ----------
    utterance : its time 0 is that of the performance. titles, starts : of strips that play, and their first frames.
    ends : the last frame of each. digest : of what is said. remarks : what the user should know.
    """

    utterance: Utterance
    titles: tuple[str, ...]
    starts: tuple[float, ...]
    ends: tuple[float, ...]
    digest: str
    remarks: tuple[str, ...] = ()


_kept: OrderedDict[tuple[object, ...], Speech] = OrderedDict()


def playing_strips(obj: Object) -> list[RISORIUS_PG_speech_strip]:
    """The strips that play: those that are not muted and say something."""
    return [strip for strip in obj.risorius.speech.strips if not strip.mute and strip.words]


def length_of(strip: RISORIUS_PG_speech_strip) -> float:
    """Seconds that a strip lasts, as it is stretched."""
    return float(strip.duration * strip.stretch)


def speech_of(obj: Object, first_frame: float, fps: float) -> Speech | None:
    """What the strips of a face say, in seconds from a frame on; None where they say nothing.

    It is kept until something is edited: a strip may hold an hour of words.
    """
    strips = playing_strips(obj)
    if not strips:
        return None
    name = (obj.risorius.speech.edited, tuple(strip.start for strip in strips), first_frame, fps)
    found = _kept.pop(name, None)
    if found is None:
        found = _worked_out(strips, first_frame, fps)
    _kept[name] = found
    while len(_kept) > KEPT:
        _kept.popitem(last=False)
    return found


def _worked_out(strips: Sequence[RISORIUS_PG_speech_strip], first_frame: float, fps: float) -> Speech:
    """See `speech_of`."""
    parts = [((strip.start - first_frame) / fps, round(strip.stretch, DIGITS), read_line(strip)) for strip in strips]
    utterance, titles = together(parts), tuple(title_of_strip(strip) for strip in strips)
    said = tuple(f"{titles[number]}: is cut off by the speech that begins in it" for number in interrupted(parts))
    starts = tuple(float(strip.start) for strip in strips)
    ends = tuple(float(strip.start + length_of(strip) * fps) for strip in strips)
    digest = blake2b(repr(utterance).encode(), digest_size=12).hexdigest()
    return Speech(utterance, titles, starts, ends, digest, said)


def title_of_strip(strip: RISORIUS_PG_speech_strip) -> str:
    """The name the user gave, or the first words."""
    return str(strip.name).strip() or shortened(" ".join(title_of_word(word) for word in strip.words[:NAMED])) or "-"


def title_of_word(word: RISORIUS_PG_said_word) -> str:
    """Its letters, or else the symbols of its sounds."""
    return str(word.name) or " ".join(sound.symbol for sound in word.sounds) or "-"


def shortened(text: str) -> str:
    """A text of so many letters at most, cut between words."""
    words = " ".join(text.split())
    return words if len(words) <= NAMED else f"{words[: NAMED - 1].rsplit(' ', 1)[0]}..."


def read_line(strip: RISORIUS_PG_speech_strip) -> Line:
    """What a strip says, not stretched."""
    words = tuple(_read_word(word) for word in strip.words)
    return Line(words, max(strip.duration, words[-1].end if words else 0.0))


def _read_word(word: RISORIUS_PG_said_word) -> LineWord:
    """One word."""
    begins, ends = round(word.begins, DIGITS), round(word.ends, DIGITS)
    sounds = tuple(_read_sound(sound, begins, ends) for sound in word.sounds)
    return LineWord(word.name, begins, ends, sounds, round(word.strength, DIGITS))


def _read_sound(sound: RISORIUS_PG_said_sound, begins: float, ends: float) -> Sound:
    """One sound of a word."""
    first, last = (begins + round(share, DIGITS) * (ends - begins) for share in (sound.first, sound.last))
    jaw, lips = round(sound.jaw, DIGITS), round(sound.lips, DIGITS)
    phoneme = Phoneme(sound.symbol, int(sound.viseme), jaw, lips, sound.own, sound.vowel)
    return Sound(first, last, phoneme, sound.symbol, round(sound.stress, DIGITS), round(sound.strength, DIGITS))


def write_line(strip: RISORIUS_PG_speech_strip, line: Line) -> None:
    """Let a strip say a line instead of what it said."""
    active = strip.active
    with written_at_once():
        strip.words.clear()
        strip.duration = line.duration
        for word in line.words:
            _write_word(strip.words.add(), word)
        strip.active = max(0, min(active, len(line.words) - 1))
    edited(strip)


def _write_word(entry: RISORIUS_PG_said_word, word: LineWord) -> None:
    """One word."""
    entry.name, entry.begins, entry.ends, entry.strength = word.text, word.start, word.end, word.strength
    for sound in word.sounds:
        write_sound(entry.sounds.add(), sound, word)


def write_sound(entry: RISORIUS_PG_said_sound, sound: Sound, word: LineWord) -> None:
    """One sound of a word."""
    length = word.end - word.start
    entry.viseme = str(sound.phoneme.viseme)
    entry.symbol = sound.symbol or sound.phoneme.symbol
    entry.first, entry.last = (sound.start - word.start) / length, (sound.end - word.start) / length
    entry.strength, entry.stress = sound.strength, sound.stress
    entry.jaw, entry.lips = sound.phoneme.jaw, sound.phoneme.lips
    entry.own, entry.vowel = sound.phoneme.own, sound.phoneme.vowel


def trouble_of(strip: RISORIUS_PG_speech_strip) -> str:
    """What is wrong with a strip's sound, or nothing."""
    if is_missing(strip.sound):
        return f"Sound is missing: {bpy.path.basename(strip.sound.filepath) if strip.sound is not None else ''}"
    return ""
