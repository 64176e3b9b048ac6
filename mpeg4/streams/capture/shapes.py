"""Named blend shapes as FAPs: the table of presets/capture/arkit.toml, read both ways.

A captured score times a shape's FAPs is a frame; a face posed with a shape's FAPs is a shape key.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from ....arrays import Floats
from ....errors import FormatError
from ...standard import FAP_COUNT, FAPS, Motion
from .preset import CAPTURE_PRESETS, read_preset

SHAPE_KEYS = ("mirror", "faps", "contractions", "over", "source")
SIDEWAYS = {Motion.LEFT: Motion.RIGHT, Motion.RIGHT: Motion.LEFT}


@dataclass(frozen=True)
class CaptureShape:
    """One blend shape at full strength.

    Attributes
    ----------
    name : as the tracker names it ("jawOpen").
    frame : (68,) FAPs in FAP units; NaN where the shape says nothing. Read-only.
    contractions : muscle name -> 0..1, where the shape is made of muscles; empty where its FAPs make it.
    over : the shape that this one corrects, and is added to; None where it stands alone.
    source : where the figures are from.
    """

    name: str
    frame: Floats
    contractions: Mapping[str, float]
    source: str
    over: str | None = None

    def mirrored(self, name: str) -> CaptureShape:
        """The other side's shape."""
        frame = np.full(FAP_COUNT, np.nan)
        for number in np.flatnonzero(~np.isnan(self.frame)) + 1:
            fap = FAPS[int(number)]
            twin = FAPS[fap.mirror or fap.number]
            same = fap.motion is not None and SIDEWAYS.get(fap.motion, fap.motion) is twin.motion
            frame[twin.number - 1] = self.frame[number - 1] * (1.0 if same else -1.0)
        frame.flags.writeable = False
        contractions = {_other_side(muscle): value for muscle, value in self.contractions.items()}
        return CaptureShape(name, frame, contractions, self.source, self.over)


def _other_side(muscle: str) -> str:
    """A muscle's twin: "risorius_l" -> "risorius_r"."""
    return muscle[:-1] + {"l": "r", "r": "l"}[muscle[-1]] if muscle.endswith(("_l", "_r")) else muscle


def load_shapes(path: str | Path = CAPTURE_PRESETS / "arkit.toml") -> Mapping[str, CaptureShape]:
    """Shapes by name, mirrored ones after those that they mirror.

    Raises
    ------
    FormatError : names the file, the key and the rule.
    """
    return _load(Path(path))


@lru_cache(maxsize=8)
def _load(path: Path) -> Mapping[str, CaptureShape]:
    """See `load_shapes`."""
    shapes: dict[str, CaptureShape] = {}
    for name, row in read_preset(path, "shapes").items():
        for key in row:
            if key not in SHAPE_KEYS:
                raise FormatError(
                    path, f"is no key of a shape: use {', '.join(SHAPE_KEYS)}", key=f"shapes.{name}.{key}"
                )
        key = f"shapes.{name}"
        if not isinstance(row.get("source"), str):
            raise FormatError(path, "must be text that says where the figures are from", key=f"{key}.source")
        over = row.get("over")
        if over is not None and over not in shapes:
            raise FormatError(path, f"must be a shape that stands above, but it is {over!r}", key=f"{key}.over")
        frame = fap_frame(path, key, row.get("faps", {}))
        shape = CaptureShape(name, frame, read_contractions(path, key, row), row["source"], over)
        shapes[name] = shape
        if "mirror" in row:
            shapes[str(row["mirror"])] = shape.mirrored(str(row["mirror"]))
    return MappingProxyType(shapes)


def fap_frame(path: Path, key: str, faps: object) -> Floats:
    """(68,) frame of a table {FAP number = value}; NaN where it says nothing.

    Raises
    ------
    FormatError : something else than FAP numbers 3 to 68 with numbers.
    """
    if not isinstance(faps, dict):
        raise FormatError(path, "must be a table of FAP number = value", key=f"{key}.faps")
    frame = np.full(FAP_COUNT, np.nan)
    for number, value in faps.items():
        if not (number.isdecimal() and 3 <= int(number) <= FAP_COUNT):
            raise FormatError(path, f"must name FAPs 3 to {FAP_COUNT}, but there is {number!r}", key=f"{key}.faps")
        frame[int(number) - 1] = _number(path, f"{key}.faps.{number}", value)
    frame.flags.writeable = False
    return frame


def read_contractions(path: Path, key: str, row: Mapping[str, Any]) -> dict[str, float]:
    """The row's muscles, each 0..1."""
    table = row.get("contractions", {})
    if not isinstance(table, dict):
        raise FormatError(path, "must be a table of muscle = contraction", key=f"{key}.contractions")
    values = {muscle: _number(path, f"{key}.contractions.{muscle}", value) for muscle, value in table.items()}
    for muscle, value in values.items():
        if not 0.0 <= value <= 1.0:
            raise FormatError(path, f"must lie in 0..1, but it is {value!r}", key=f"{key}.contractions.{muscle}")
    return values


def _number(path: Path, key: str, value: object) -> float:
    """A finite number."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise FormatError(path, f"must be a number, but it is {value!r}", key=key)
    return float(value)
