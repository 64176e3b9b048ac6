"""Which kind of timings a file has: told by what it contains."""

from __future__ import annotations

from pathlib import Path

from ...errors import FormatError, ParameterError
from ...files import read_bytes
from ...mpeg4.streams.capture import read_json_document
from ...mpeg4.streams.capture.delimited import decoded
from ...mpeg4.streams.fap_file import looks_like_fap
from ...mpeg4.streams.fba.decoder import begins_as_fba
from ...tables import numbered_lines
from ..phonemes import Alphabet
from ..utterance import Utterance
from .documents import json_timings
from .labels import Timings, utterance_of
from .loudness import is_other_sound, is_wav, loudness_utterance
from .presets import is_preset, preset_utterance
from .rhubarb import is_rhubarb_tsv, rhubarb_from_tsv, rhubarb_from_xml
from .tabular import has_no_heading, label_file, table_timings
from .textgrid import textgrid_timings
from .visemes import viseme_timings

#: What a file may be, for messages.
READABLE = "a TextGrid of Praat, Rhubarb's JSON, TSV or XML, or a table or JSON of sounds with start and end, or WAV"


def read_marks(path: str | Path, *, tier: str | None = None, alphabet: str | Alphabet | None = None) -> Utterance:
    """What is said when, by a file that marks it in time; `recorded.read_timings` takes recordings of a mouth, too.

    Raises
    ------
    FormatError, ParameterError : as there.
    """
    file = Path(path)
    if alphabet is not None and alphabet not in list(Alphabet):
        raise ParameterError("alphabet", f"must be one of {', '.join(Alphabet)}", str(alphabet))
    if is_wav(data := read_bytes(file)):
        return loudness_utterance(file)
    if is_other_sound(data):
        raise FormatError(file, "is a sound, but not WAV: convert it to WAV, or give the times of its sounds")
    if file.suffix.lower() == ".toml" and is_preset(decoded(read_bytes(file)) or ""):
        return preset_utterance(file)
    timings = _opened(file, tier)
    return utterance_of(timings, None if alphabet is None else Alphabet(alphabet))


def _opened(path: Path, tier: str | None) -> Timings:
    """The marks of a file of any kind."""
    data = read_bytes(path)
    text = decoded(data)
    if begins_as_fba(data) or (text is not None and looks_like_fap(text)):
        return viseme_timings(path, data)
    if text is None:
        raise FormatError(path, f"is no text: it must be {READABLE}")
    begins, lines = text.lstrip()[:200], numbered_lines(text)
    if not lines:
        raise FormatError(path, f"is empty: it must be {READABLE}")
    if "ooTextFile" in begins or "TextGrid" in begins:
        return textgrid_timings(path, text, tier)
    if begins.startswith(("{", "[")):
        return json_timings(path, read_json_document(path), tier)
    if begins.startswith("<"):
        if "<rhubarbResult" not in text:
            raise FormatError(path, f"is XML, but not Rhubarb's: it must be {READABLE}")
        return rhubarb_from_xml(path, text)
    if is_rhubarb_tsv(lines):
        return rhubarb_from_tsv(path, lines)
    if has_no_heading(lines):
        return label_file(path, lines)
    return table_timings(path)
