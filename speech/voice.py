"""Text becomes sound and timed phonemes: eSpeak NG, offline, in some hundred languages.

The library comes with the package espeakng-loader, which Risorius' extension holds; else one that is installed is used.
Source of its interface: eSpeak NG 1.52, speak_lib.h.
"""

from __future__ import annotations

import _ctypes
import contextlib
import ctypes
import ctypes.util
import difflib
import shutil
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, RisoriusError
from ..files import scratch_folder, write_whole
from .phonemes import Alphabet, is_mark
from .timings.labels import Label, Timings, utterance_of
from .utterance import Utterance
from .waves import LOUDEST, wav_of

#: From speak_lib.h: the sound is handed over; phonemes are events, in IPA; errors do not end the process.
RETRIEVAL, PHONEME_EVENTS, PHONEME_IPA, NO_EXIT = 1, 0x0001, 0x0002, 0x8000
UTF8, CHARACTERS = 1, 1
RATE, PITCH = 1, 3
LIST_END, WORD, PHONEME = 0, 1, 7

#: Words per minute and pitch that eSpeak NG takes, and what it speaks with if nothing is said.
SPEEDS, USUAL_SPEED = (80, 450), 175
PITCHES, USUAL_PITCH = (0, 99), 50

#: Seconds that a sound lasts, at most, that the voice says within the one before. Own choice: a short l.
MERGED = 0.08

#: Signs that are not said at either end of a word.
EDGES = ' .,;:!?…()[]{}"„“”«»‹›–—-¿¡*/|'

MISSING = (
    "Speaking text needs eSpeak NG: install it (in Python: pip install espeakng-loader), or time the sounds yourself"
)


@dataclass(frozen=True, eq=False)
class Voiced:
    """A text as it is spoken: what is said when, and the sound, (n,) 16 bits at `rate` per second."""

    utterance: Utterance
    sound: NDArray[np.int16]
    rate: int

    def write(self, path: str | Path) -> None:
        """Write the sound as WAV; FormatError where it cannot be written."""
        write_whole(path, self.wav())

    def wav(self) -> bytes:
        """The sound as a WAV file holds it."""
        return wav_of(self.sound[:, None] / LOUDEST, self.rate)


class _Id(ctypes.Union):
    _fields_ = (("number", ctypes.c_int), ("name", ctypes.c_char_p), ("string", ctypes.c_char * 8))


class _Event(ctypes.Structure):
    _fields_ = (
        ("type", ctypes.c_int),
        ("unique_identifier", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_position", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user_data", ctypes.c_void_p),
        ("id", _Id),
    )


class _Voice(ctypes.Structure):
    _fields_ = (("name", ctypes.c_char_p), ("languages", ctypes.c_char_p), ("identifier", ctypes.c_char_p))


_Callback = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(_Event))


@dataclass
class _Heard:
    """What the library has handed over: pieces of sound; phonemes and words by the sample at which they begin."""

    pieces: list[bytes]
    phonemes: list[tuple[int, str]]
    words: list[tuple[int, int, int]]

    def hear(self, sound: ctypes._Pointer[ctypes.c_short], count: int, events: ctypes._Pointer[_Event]) -> int:
        """The library's callback; 0 asks for more."""
        if count:
            self.pieces.append(ctypes.string_at(sound, 2 * count))
        place = 0
        while events[place].type != LIST_END:
            event = events[place]
            if event.type == WORD:
                self.words.append((event.sample, event.text_position - 1, event.length))
            elif event.type == PHONEME:
                symbol = bytes(event.id.string).decode("utf-8", errors="ignore")
                if not symbol.startswith("("):  # (de): another language begins
                    self.phonemes.append((event.sample, symbol))
            place += 1
        return 0


@contextlib.contextmanager
def _library() -> Iterator[tuple[ctypes.CDLL, int]]:
    """eSpeak NG, ready, and its samples per second.

    What it has said before changes times by some milliseconds, whatever it is asked to forget. So each text is spoken
    by a fresh copy of the package's library, which is unloaded again: the same text gives the same speech.

    Raises
    ------
    RisoriusError : it is not here, or lacks its data.
    """
    with scratch_folder() as folder:
        try:
            import espeakng_loader

            path: str | None = str(shutil.copy(espeakng_loader.get_library_path(), folder))
            data: bytes | None = espeakng_loader.get_data_path().encode()
        except ImportError:
            path, data = ctypes.util.find_library("espeak-ng"), None
        if path is None:
            raise RisoriusError(MISSING)
        try:
            library = ctypes.CDLL(path)
            rate = int(library.espeak_Initialize(RETRIEVAL, 0, data, PHONEME_EVENTS | PHONEME_IPA | NO_EXIT))
        except (OSError, AttributeError) as error:
            raise RisoriusError(f"eSpeak NG cannot be loaded from {path} ({error}): install it again") from error
        if rate <= 0:
            raise RisoriusError(f"eSpeak NG at {path} lacks its data: install it again")
        library.espeak_ListVoices.restype = ctypes.POINTER(ctypes.POINTER(_Voice))
        try:
            yield library, rate
        finally:
            library.espeak_Terminate()
            unload = getattr(_ctypes, "FreeLibrary" if sys.platform == "win32" else "dlclose")
            unload(library._handle)


def voices() -> dict[str, str]:
    """Language code -> name of the voice, in the order of the codes.

    Raises
    ------
    RisoriusError : there is no eSpeak NG.

    Examples
    --------
    >>> api.voices()["de"]
    'German'
    """
    with _library() as (library, _):
        return _voices(library)


def _voices(library: ctypes.CDLL) -> dict[str, str]:
    """The voices of a library that is ready."""
    listed, found, place = library.espeak_ListVoices(None), {}, 0
    while listed[place]:
        voice = listed[place].contents
        found[voice.languages[1:].decode("utf-8", errors="replace")] = voice.name.decode("utf-8", errors="replace")
        place += 1
    return dict(sorted(found.items()))


def speak(text: str, *, voice: str = "en", speed: float = USUAL_SPEED, pitch: float = USUAL_PITCH) -> Voiced:
    """Speak a text.

    Parameters
    ----------
    voice : a language code, as "en", "en-us", "de", with a variant if you like ("en+f3").
    speed : words per minute, 80 to 450. pitch : 0 to 99.

    Raises
    ------
    RisoriusError : there is no eSpeak NG.
    ParameterError : no such voice, nothing to say, or a value outside its range.

    Examples
    --------
    >>> voiced = api.speak("Good morning.", voice="en")
    >>> " ".join(word.text for word in voiced.utterance.words)
    'Good morning'
    """
    for name, value, (low, high) in (("speed", speed, SPEEDS), ("pitch", pitch, PITCHES)):
        if not low <= value <= high:
            raise ParameterError(name, f"must be from {low} to {high}", value)
    if not text.strip() or "\0" in text:
        raise ParameterError("text", "must say something", text[:40])
    heard = _Heard([], [], [])
    with _library() as (library, rate):
        if library.espeak_SetVoiceByName(voice.encode()) != 0:
            near = difflib.get_close_matches(voice, _voices(library), n=3) or ["en", "de", "fr"]
            raise ParameterError("voice", f"must be a language of eSpeak NG, as {', '.join(near)}", voice)
        library.espeak_SetParameter(RATE, round(speed), 0)
        library.espeak_SetParameter(PITCH, round(pitch), 0)
        callback = _Callback(heard.hear)  # kept while the library may call it
        library.espeak_SetSynthCallback(callback)
        written = text.encode()
        library.espeak_Synth(written, len(written) + 1, 0, CHARACTERS, 0, UTF8, None, None)
        library.espeak_Synchronize()
    sound = np.frombuffer(b"".join(heard.pieces), dtype=np.int16)
    return Voiced(_utterance(text, voice, heard, len(sound), rate), sound, rate)


def _letters(text: str, words: Sequence[tuple[int, int, int]]) -> list[str]:
    """What of a text is said by each word: some are said in one with the next, as "did not", and named once."""
    ends = [*(place for _, place, _ in words), len(text)][1:]
    letters = []
    for (_, place, length), end in zip(words, ends, strict=True):
        said = " ".join(text[place:end].split()).strip(EDGES)
        letters.append(said or text[place : place + length])
    return letters


def _utterance(text: str, voice: str, heard: _Heard, samples: int, rate: int) -> Utterance:
    """What was heard: each phoneme lasts to the next one, each word too."""
    phonemes = [(sample, symbol) for sample, symbol in heard.phonemes if not is_mark(symbol)]
    ends = [*(sample for sample, _ in phonemes), samples][1:]
    sounds = list[Label]()
    for number, ((sample, symbol), end) in enumerate(zip(phonemes, ends, strict=True), 1):
        start = sample / rate
        if end == sample and symbol and sounds:
            # A voice says some sounds within the one before, as the l of "well": they share its time.
            whole = sounds[-1]
            start = whole.end - min(MERGED, (whole.end - whole.start) / 2.0)
            sounds[-1] = replace(whole, end=start)
        sounds.append(Label(start, end / rate, symbol, f"phoneme {number}"))
    spoken = [sound for sound in sounds if sound.text]
    last = spoken[-1].end if spoken else 0.0
    starts = [*(sample / rate for sample, _, _ in heard.words), last][1:]
    words = [
        Label(sample / rate, max(end, sample / rate), letters)
        for (sample, _, _), end, letters in zip(heard.words, starts, _letters(text, heard.words), strict=True)
    ]
    if not spoken:
        raise ParameterError("text", f"must have words that the voice {voice} can say", text[:40])
    path = Path(f"text in the voice {voice}")
    return utterance_of(Timings(path, sounds, words, samples / rate), Alphabet.IPA)
