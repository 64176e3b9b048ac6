"""JSON whose entries are no frames: one for each score, a message for each score (VMC), or a curve for each shape."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ....tables import parsed_number
from .long_form import SCORES, by_frame
from .row_names import tells_the_frame, time_name
from .shape_names import shape_named

#: What the name of a score is called, where each is an entry of its own.
SCORE_NAMES = (
    "category_name", "categoryName", "displayName", "name", "shape", "blendshape", "blendShape", "blendShapeLocation",
    "blendShapeName", "blendshape_name", "shapeName", "target", "morphTarget", "curve", "key", "label",
)  # fmt: skip
#: What a message of VMC begins with; its names and scores; the end of a frame.
VMC, VMC_SCORE, VMC_END = "/VMC/Ext/", "/VMC/Ext/Blend/Val", "/VMC/Ext/Blend/Apply"
#: Names of a list of curves, of a curve's times and values, and of its keys.
CURVES, TIMES, VALUES, KEYS = ("curves", "tracks", "channels", "animations"), ("times", "time"), ("values",), ("keys",)

Frames = list[tuple[float | None, Any]]


def category(entry: Any) -> tuple[str, Any] | None:
    """The name and the score of an entry that is one of both: an object of them, or a pair; None where it is none."""
    if isinstance(entry, list) and len(entry) == 2 and isinstance(entry[0], str):
        return entry[0], entry[1]
    if not isinstance(entry, dict):
        return None
    name = next((entry[key] for key in SCORE_NAMES if isinstance(entry.get(key), str) and entry[key]), None)
    value = next((key for key in SCORES if key in entry), None)
    return None if name is None or value is None else (name, entry[value])


def frames_of_scores(document: list[Any]) -> Frames | None:
    """The frames of a list of scores or messages; None where it is none, or one of a single frame."""
    entries = _messages(document)
    found = [(entry, category(entry)) for entry in entries]
    if not found or any(score is None or not isinstance(entry, dict | list) for entry, score in found):
        return None
    about = [_about(entry) for entry, _ in found]
    names = [score[0] for _, score in found if score is not None]
    frames = by_frame((str(each) for each in about), names)
    if frames[-1] == 0 and not about[0]:
        return None
    gathered: list[dict[str, Any]] = [{} for _ in range(frames[-1] + 1)]
    for frame, each, (_, score) in zip(frames, about, found, strict=True):
        if score is not None:
            gathered[frame] |= each
            gathered[frame].setdefault("blendshapes", {})[score[0]] = score[1]
    return [(None, frame) for frame in gathered]


def _about(entry: Any) -> dict[str, Any]:
    """What an entry tells of its frame: when it is, and whose."""
    if not isinstance(entry, dict):
        return {}
    return {name: value for name, value in entry.items() if tells_the_frame(name)}


def _messages(document: list[Any]) -> list[Any]:
    """The scores of messages of VMC as entries; other entries as they are."""
    if not any(isinstance(entry, dict) and str(entry.get("address", "")).startswith(VMC) for entry in document):
        return document
    found, number = [], 0
    for entry in document:
        address = entry.get("address") if isinstance(entry, dict) else None
        said = [part.get("value") if isinstance(part, dict) else part for part in _said(entry)]
        if address == VMC_SCORE and len(said) >= 2:
            told = _about(entry)
            found.append({**(told or {"frame": number}), "name": said[0], "value": said[1]})
        number += address == VMC_END
    return found


def _said(entry: Any) -> Sequence[Any]:
    """The arguments of a message."""
    said: Any = next((entry[name] for name in ("args", "arguments", "values", "data") if name in entry), None)
    return said if isinstance(said, list) else []


def frames_of_curves(document: Mapping[str, Any]) -> Frames | None:
    """Frames at all times at which a curve has a key, each curve between its own; None where there are no curves."""
    listed = next((value for name, value in document.items() if name.lower() in CURVES and isinstance(value, list)), [])
    curves = dict(curve for entry in listed if (curve := _curve(entry)) is not None)
    if not any(shape_named(name) is not None for name in curves):
        return None
    times = np.unique(np.concatenate([at for at, _ in curves.values()]))
    rows = np.array([np.interp(times, at, values) for at, values in curves.values()]).T
    return [
        (None, {"time": float(time), "blendshapes": dict(zip(curves, row.tolist(), strict=True))})
        for time, row in zip(times, rows, strict=True)
    ]


def _curve(entry: Any) -> tuple[str, tuple[Any, Any]] | None:
    """The name, the times and the values of a curve; None where an entry is none."""
    if not isinstance(entry, dict):
        return None
    name = next((entry[key] for key in SCORE_NAMES if isinstance(entry.get(key), str) and entry[key]), None)
    keys = next((entry[key] for key in KEYS if isinstance(entry.get(key), list)), None)
    if keys is not None and all(isinstance(key, dict) for key in keys):
        at = [next((key[part] for part in key if time_name(part) is not None), None) for key in keys]
        values = [next((key[part] for part in SCORES if part in key), None) for key in keys]
    else:
        at = next((entry[key] for key in TIMES if isinstance(entry.get(key), list)), [])
        values = next((entry[key] for key in VALUES if isinstance(entry.get(key), list)), [])
    numbers = [parsed_number(str(each)) for each in (*at, *values)]
    if name is None or not at or len(at) != len(values) or None in numbers:
        return None
    order = np.argsort(np.array(numbers[: len(at)], dtype=np.float64), kind="stable")
    return name, (np.array(numbers[: len(at)], dtype=np.float64)[order], np.array(numbers[len(at) :])[order])
