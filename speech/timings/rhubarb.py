"""Mouth shapes in time by Rhubarb Lip Sync, in its three formats.

Source: Rhubarb Lip Sync 1.13, README, "Output formats".
"""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...errors import FormatError
from ...tables import is_number, parsed_number
from .labels import Label, Timings, mouth_shape


def is_rhubarb_json(document: object) -> bool:
    """Whether JSON is Rhubarb's."""
    return isinstance(document, dict) and isinstance(document.get("mouthCues"), list)


def rhubarb_from_json(path: Path, document: Mapping[str, Any]) -> Timings:
    """Its JSON; FormatError names the cue."""
    cues = [
        _cue(path, f"mouthCues[{number}]", cue) if isinstance(cue, dict) else _refuse(path, f"mouthCues[{number}]")
        for number, cue in enumerate(document["mouthCues"])
    ]
    stated = document.get("metadata")
    length: object = stated.get("duration") if isinstance(stated, dict) else None
    return _timings(path, cues, None if length is None else _seconds(path, "metadata.duration", length))


def rhubarb_from_xml(path: Path, text: str) -> Timings:
    """Its XML; FormatError names the cue."""
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise FormatError(path, "declares a document type, which no Rhubarb file has: export it again")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise FormatError(path, f"is not valid XML ({error}): is the file cut off?", line=error.position[0]) from error
    cues = [
        _cue(path, f"mouthCue {number}", {**cue.attrib, "value": cue.text or ""})
        for number, cue in enumerate(root.iter("mouthCue"), 1)
    ]
    length = root.findtext("metadata/duration")
    return _timings(path, cues, None if length is None else _seconds(path, "duration", length))


def is_rhubarb_tsv(lines: list[tuple[int, str]]) -> bool:
    """Whether every line is a time, a tab and a mouth shape."""
    cells = [line.split("\t") for _, line in lines]
    return len(cells) > 1 and all(
        len(row) == 2 and parsed_number(row[0].strip()) is not None and mouth_shape(row[1]) is not None for row in cells
    )


def rhubarb_from_tsv(path: Path, lines: list[tuple[int, str]]) -> Timings:
    """Its TSV: when each shape begins; the last one ends the whole."""
    cells = [line.split("\t") for _, line in lines]
    times = [_seconds(path, f"line {number}", row[0]) for (number, _), row in zip(lines, cells, strict=True)]
    cues = [
        Label(start, end, row[1].strip(), f"line {number}")
        for (number, _), row, start, end in zip(lines[:-1], cells[:-1], times[:-1], times[1:], strict=True)
    ]
    return _timings(path, cues, times[-1])


def _timings(path: Path, cues: list[Label], duration: float | None) -> Timings:
    """Cues as timings; X is a pause."""
    spoken = [cue for cue in cues if cue.text.upper() != "X"]
    if not spoken:
        raise FormatError(path, "says nothing: it has no mouth shape but X")
    for cue in spoken:
        if mouth_shape(cue.text) is None:
            raise FormatError(path, f"{cue.where}: {cue.text!r} is no mouth shape of A to H and X")
    return Timings(path, spoken, (), duration, read=mouth_shape)


def _cue(path: Path, where: str, cue: Mapping[str, object]) -> Label:
    """One cue."""
    start, end = (_seconds(path, f"{where}.{name}", cue.get(name)) for name in ("start", "end"))
    return Label(start, end, str(cue.get("value", "")).strip(), where)


def _seconds(path: Path, where: str, value: object) -> float:
    """A time; Rhubarb writes texts or numbers."""
    found: object = parsed_number(value.strip()) if isinstance(value, str) else value
    if not is_number(found):
        raise FormatError(path, f"{where}: must be a number of seconds, but it is {value!r}")
    return float(found)


def _refuse(path: Path, where: str) -> Label:
    """What is no cue."""
    raise FormatError(path, f"{where}: must have start, end and value")
