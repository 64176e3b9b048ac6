"""JSON of sounds in time: by the Montreal Forced Aligner, Gentle, Amazon Polly, and as plain lists.

Sources: Montreal Forced Aligner 3, user guide, "Output formats"; Gentle's README (phones of a word with durations);
Amazon Polly, developer guide, "Speech marks" (milliseconds, visemes in its own letters, which X-SAMPA holds).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ...errors import FormatError
from ...tables import is_number
from .labels import Label, Timings, viseme_number
from .rhubarb import is_rhubarb_json, rhubarb_from_json
from .tabular import DURATIONS, ENDS, SOUNDS, STARTS, VISEMES, WORDS, place_of, seconds_in, unit_of
from .textgrid import Tier, tier_timings

#: Under which keys a plain document holds its lists.
LISTS = ("phonemes", "phones", "sounds", "segments", "visemes", "timings", "items", "alignment")
#: What Kaldi appends to a sound: whether it begins, is inside, ends or is a word.
PLACES_IN_WORD = ("_B", "_I", "_E", "_S")


def json_timings(path: Path, document: object, tier: str | None = None) -> Timings:
    """The sounds of a document.

    Raises
    ------
    FormatError : it holds none, or an entry lacks a time; names the entry.
    """
    if isinstance(document, dict):
        if is_rhubarb_json(document):
            return rhubarb_from_json(path, document)
        if isinstance(document.get("tiers"), dict):
            return _from_tiers(path, document, tier)
        if isinstance(document.get("words"), list) and any("phones" in _object(word) for word in document["words"]):
            return _from_gentle(path, document["words"])
        for name in LISTS:
            if isinstance(document.get(name), list) and document[name]:
                words = document.get("words")
                return _listed(
                    path, document[name], name, words if isinstance(words, list) else [], document.get("duration")
                )
        if isinstance(document.get("words") or document.get("word_segments"), list):
            raise FormatError(path, "has words but no sounds: align them with a forced aligner first")
    if isinstance(document, list) and document:
        if all("time" in _object(entry) and "type" in _object(entry) for entry in document):
            return _from_marks(path, document)
        return _listed(path, document, "", [], None)
    raise FormatError(path, f"holds no sounds in time: it needs a list under one of {', '.join(LISTS)}")


def _object(entry: object) -> Mapping[str, Any]:
    """An entry, empty where it is none."""
    return entry if isinstance(entry, dict) else {}


def _from_tiers(path: Path, document: Mapping[str, Any], tier: str | None) -> Timings:
    """The Montreal Forced Aligner's JSON."""
    tiers = []
    for name, held in document["tiers"].items():
        entries = held.get("entries") if isinstance(held, dict) else None
        if not isinstance(entries, list):
            raise FormatError(path, "must have a list of entries", key=f"tiers.{name}")
        labels = []
        for place, entry in enumerate(entries):
            where = f"entry {place} of tier {name}"
            if not isinstance(entry, list) or len(entry) != 3:
                raise FormatError(path, f"{where}: must be a start, an end and a text")
            labels.append(
                Label(_seconds(path, where, entry[0]), _seconds(path, where, entry[1]), str(entry[2]).strip(), where)
            )
        tiers.append(Tier(name, labels))
    end = document.get("end")
    return tier_timings(path, tiers, tier, None if end is None else _seconds(path, "end", end))


def _from_gentle(path: Path, words: Sequence[object]) -> Timings:
    """Words with their phones one after another; a word that was not found in the sound has no time."""
    sounds, spoken, missing = [], [], []
    for number, entry in enumerate(words):
        word, where = _object(entry), f"words[{number}]"
        text = str(word.get("word", ""))
        if "start" not in word or not isinstance(word.get("phones"), list):
            missing.append(text)
            continue
        start = at = _seconds(path, f"{where}.start", word["start"])
        for place, phone in enumerate(word["phones"]):
            length = _seconds(path, f"{where}.phones[{place}].duration", _object(phone).get("duration"))
            name = str(_object(phone).get("phone", ""))
            sounds.append(
                Label(
                    at,
                    at + length,
                    name.removesuffix(name[-2:]) if name.endswith(PLACES_IN_WORD) else name,
                    f"{where}.phones[{place}]",
                )
            )
            at += length
        spoken.append(Label(start, at, text, where))
    said = (f"not aligned, so not spoken: {', '.join(missing)}",) if missing else ()
    return Timings(path, sounds, spoken, assumed=said)


def _from_marks(path: Path, marks: Sequence[Mapping[str, Any]]) -> Timings:
    """Speech marks: each viseme lasts to the next one, times are milliseconds."""
    visemes = [(number, mark) for number, mark in enumerate(marks) if mark["type"] == "viseme"]
    if not visemes:
        raise FormatError(path, "has speech marks but none of the type viseme: ask the service for those, too")
    times = [_seconds(path, f"line {number + 1}", mark["time"]) / 1000.0 for number, mark in visemes]
    ends = [*times[1:], times[-1]]
    sounds = [
        Label(start, end, str(mark.get("value", "")), f"line {number + 1}")
        for start, end, (number, mark) in zip(times, ends, visemes, strict=True)
    ]
    spoken = [mark for mark in marks if mark["type"] == "word"]
    begun = [_seconds(path, "word", mark["time"]) / 1000.0 for mark in spoken]
    words = [
        Label(start, end, str(mark.get("value", "")), "word")
        for start, end, mark in zip(begun, [*begun, times[-1]][1:], spoken, strict=True)
    ]
    return Timings(path, sounds, words, times[-1])


def _listed(path: Path, entries: Sequence[object], name: str, words: Sequence[object], duration: object) -> Timings:
    """A plain list of objects with start, end or duration, and a sound or viseme."""
    labels, unit = _labels(path, entries, name, (*SOUNDS, *VISEMES))
    keys = list(_object(entries[0]))
    unit, said = (unit, ()) if unit is not None else _guessed(labels)
    spoken, _ = _labels(path, words, "words", (*WORDS, *SOUNDS)) if words else ([], None)
    labels, spoken = (
        [replace(mark, start=mark.start * unit, end=mark.end * unit) for mark in some] for some in (labels, spoken)
    )
    visemes_alone = place_of(keys, SOUNDS) is None and all(viseme_number(mark.text) for mark in labels)
    length = None if duration is None else _seconds(path, "duration", duration) * unit
    return Timings(path, labels, spoken, length, read=viseme_number if visemes_alone else None, assumed=said)


def _guessed(labels: Sequence[Label]) -> tuple[float, tuple[str, ...]]:
    """The unit of times by the lengths of sounds."""
    unit, told = seconds_in([label.end - label.start for label in labels])
    return unit, (f"times are read as {told}",) if told else ()


def _labels(path: Path, entries: Sequence[object], name: str, texts: Sequence[str]) -> tuple[list[Label], float | None]:
    """Entries as marks in their own unit, and the unit where a key says it; one without an end lasts to the next."""
    found, open_ends, unit = [], [], None
    for number, entry in enumerate(entries):
        where, held = f"{name}[{number}]", _object(entry)
        keys = list(held)
        start, end, length, text = (place_of(keys, names) for names in (STARTS, ENDS, DURATIONS, texts))
        if start is None or text is None:
            raise FormatError(
                path, f"{where}: must have start, end and phoneme or viseme, but it has {', '.join(keys) or 'nothing'}"
            )
        unit = unit_of(keys[start])
        begun = _seconds(path, f"{where}.{keys[start]}", held[keys[start]])
        if end is not None:
            last = _seconds(path, f"{where}.{keys[end]}", held[keys[end]])
        else:
            last = begun if length is None else begun + _seconds(path, f"{where}.{keys[length]}", held[keys[length]])
            open_ends += [number] if length is None else []
        found.append(Label(begun, last, str(held[keys[text]]).strip(), where))
    for number in open_ends:
        if number + 1 < len(found):
            found[number] = replace(found[number], end=found[number + 1].start)
    return found, unit


def _seconds(path: Path, where: str, value: object) -> float:
    """A number."""
    if not is_number(value):
        raise FormatError(path, f"{where}: must be a number, but it is {value!r}")
    return float(value)
