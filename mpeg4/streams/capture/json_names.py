"""JSON that has the names of its scores once, and rows of numbers: Audio2Face, and recorders that save space."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from .row_names import plain_name, tells_of_a_row
from .shape_names import shape_named

#: Names of what is said of a whole recording.
ABOUT = ("meta", "metadata", "info", "header", "heading", "video", "camera", "capture", "settings", "config", "source")

Frames = list[tuple[float | None, Any]]


def names_beside(document: Mapping[str, Any]) -> list[str]:
    """The list of names of blend shapes that an object has, or what is said of the recording in it; else empty."""
    for name, value in document.items():
        if isinstance(value, list) and _are_names(value):
            return value
        if isinstance(value, dict) and plain_name(name) in ABOUT and (found := names_beside(value)):
            return found
    return []


def _are_names(values: Sequence[Any]) -> bool:
    """Whether values are texts, blend shapes among them."""
    texts = [value for value in values if isinstance(value, str)]
    return 0 < len(texts) == len(values) and any(shape_named(text) is not None for text in texts)


def with_names(frames: Frames | None, names: Sequence[str]) -> Frames | None:
    """Frames whose scores are rows of numbers, with the names that the file has for them."""
    if frames is None or not names:
        return frames
    return [(number, _named(held, names)) for number, held in frames]


def _named(held: Any, names: Sequence[str]) -> Any:
    """One such frame; any other as it is."""
    if _is_row(held, len(names)):
        return row_by_name(names, held)
    if not isinstance(held, dict):
        return held
    rows = {name: value for name, value in held.items() if _is_row(value, len(names))}
    return {**held, **{name: dict(zip(names, row, strict=True)) for name, row in rows.items()}}


def _is_row(value: Any, count: int) -> bool:
    """Whether a value is a list of so many plain values."""
    return isinstance(value, list) and len(value) == count and not any(isinstance(v, list | dict | str) for v in value)


def row_by_name(names: Sequence[str], row: Sequence[Any]) -> dict[str, Any]:
    """The entries of a row of a matrix: what tells of the row by its name, all others as blend shapes."""
    named = dict(zip(names, row, strict=True)) if row else {}
    about = {name: value for name, value in named.items() if tells_of_a_row(name)}
    return {**about, "blendshapes": {name: value for name, value in named.items() if name not in about}}
