"""Named blend shapes as FAPs: the table of presets/capture/arkit.toml, read both ways.

A captured score times a shape's FAPs is a frame; a face posed with a shape's FAPs is a shape key.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

import numpy as np

from ....arrays import Floats
from ....resources import PRESETS
from ....tables import TomlTable, read_toml
from ...standard import FAP_COUNT, FAPS, Motion

CAPTURE_PRESETS = PRESETS / "capture"
"""The mapping tables that come with Risorius."""

SHAPE_KEYS = ("mirror", "faps", "contractions", "over", "source")
SIDEWAYS = {Motion.LEFT: Motion.RIGHT, Motion.RIGHT: Motion.LEFT}


@dataclass(frozen=True, eq=False)
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
        """The other side's shape.

        Examples
        --------
        >>> left = api.load_shapes()["mouthSmileLeft"]
        >>> right = left.mirrored("mouthSmileRight")
        >>> bool(right.frame[13 - 1] == left.frame[12 - 1])  # the corners of the lips
        True
        """
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

    Examples
    --------
    >>> "jawOpen" in api.load_shapes()
    True
    """
    return _load(Path(path))


@lru_cache(maxsize=8)
def _load(path: Path) -> Mapping[str, CaptureShape]:
    """See `load_shapes`."""
    shapes: dict[str, CaptureShape] = {}
    for name, row in read_toml(path).tables("shapes").items():
        row.only(*SHAPE_KEYS)
        if "over" in row and row.text("over") not in shapes:
            raise row.refuse(f"must be a shape that is defined above, but it is {row.text('over')!r}", "over")
        over = row.text("over") if "over" in row else None
        shape = CaptureShape(name, fap_frame(row), read_contractions(row), row.text("source"), over)
        shapes[name] = shape
        if "mirror" in row:
            shapes[row.text("mirror")] = shape.mirrored(row.text("mirror"))
    return MappingProxyType(shapes)


def fap_frame(row: TomlTable) -> Floats:
    """(68,) frame of a row's table faps = {FAP number = value}; NaN where it says nothing. Read-only.

    Raises
    ------
    FormatError : something else than FAP numbers 3 to 68 with numbers.
    """
    faps = row.table("faps", optional=True)
    frame = np.full(FAP_COUNT, np.nan)
    for number in faps:
        if not (number.isdecimal() and len(number) <= 2 and 3 <= int(number) <= FAP_COUNT):
            raise row.refuse(f"must name FAPs 3 to {FAP_COUNT}, but it contains {number!r}", "faps")
        frame[int(number) - 1] = faps.number(number)
    frame.flags.writeable = False
    return frame


def read_contractions(row: TomlTable) -> dict[str, float]:
    """The row's muscles, each 0..1."""
    table = row.table("contractions", optional=True)
    return {muscle: table.number(muscle, least=0.0, most=1.0) for muscle in table}
