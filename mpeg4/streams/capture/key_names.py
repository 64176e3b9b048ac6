"""Which shape keys to make, under which names: the presets of presets/capture/keys/, or a file of the user's own.

A row ``[keys.NAME]`` is made of blend shapes (``shapes = { jawOpen = 0.5 }``), is a viseme of the standard
(``viseme = 10``), or brings FAPs (``faps = { 3 = 400 }``) or muscles (``contractions = { risorius_l = 0.5 }``) of its
own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ....errors import FormatError
from ...high_level import VISEME_SHAPES
from .preset import CAPTURE_PRESETS, read_preset
from .shapes import CaptureShape, fap_frame, load_shapes, read_contractions

KEY_PRESETS = CAPTURE_PRESETS / "keys"
ROW_KEYS = ("shapes", "viseme", "faps", "contractions")


@dataclass(frozen=True)
class KeyShape:
    """One shape key that is asked for.

    Attributes
    ----------
    name : of the key.
    parts : shapes with their shares, whose displacements add up.
    natural : a request to the face (a viseme) rather than a measured motion: anatomy completes it.
    """

    name: str
    parts: tuple[tuple[CaptureShape, float], ...]
    natural: bool = False


def key_preset_names() -> tuple[str, ...]:
    """The presets that come with Risorius."""
    return ("arkit", *sorted(path.stem for path in KEY_PRESETS.glob("*.toml")))


def load_key_names(preset: str | Path = "arkit") -> Mapping[str, KeyShape]:
    """The keys of a preset by name: "arkit" (the 52 by their own names), another that comes along, or a TOML file.

    Raises
    ------
    FormatError : no such preset or file, or a row that breaks a rule: names the key.
    """
    shapes = load_shapes()
    if str(preset) == "arkit":
        return MappingProxyType({name: KeyShape(name, ((shape, 1.0),)) for name, shape in shapes.items()})
    bundled = str(preset) in key_preset_names()
    path = KEY_PRESETS / f"{preset}.toml" if bundled else Path(preset)
    if not bundled and path.suffix.lower() != ".toml":
        raise FormatError(path, f"is no preset of key names: use {', '.join(key_preset_names())}, or a .toml file")
    return MappingProxyType({name: _key(path, name, row, shapes) for name, row in read_preset(path, "keys").items()})


def _key(path: Path, name: str, row: Mapping[str, Any], shapes: Mapping[str, CaptureShape]) -> KeyShape:
    """One row."""
    key = f"keys.{name}"
    unknown = [entry for entry in row if entry not in ROW_KEYS]
    if unknown:
        raise FormatError(path, f"is no entry of a key: use {', '.join(ROW_KEYS)}", key=f"{key}.{unknown[0]}")
    if "viseme" in row:
        viseme = row["viseme"]
        if isinstance(viseme, bool) or not isinstance(viseme, int) or not 0 <= viseme <= max(VISEME_SHAPES):
            problem = f"must be a viseme of the standard, 0 (silence) to {max(VISEME_SHAPES)}, but it is {viseme!r}"
            raise FormatError(path, problem, key=f"{key}.viseme")
        still = viseme == 0
        part = () if still else ((CaptureShape(name, VISEME_SHAPES[viseme], {}, "viseme_shapes.csv"), 1.0),)
        return KeyShape(name, part, natural=True)
    if "shapes" in row:
        return KeyShape(name, _parts(path, key, row["shapes"], shapes))
    if "faps" not in row and "contractions" not in row:
        raise FormatError(path, f"must have one of {', '.join(ROW_KEYS)}", key=key)
    frame, contractions = fap_frame(path, key, row.get("faps", {})), read_contractions(path, key, row)
    return KeyShape(name, ((CaptureShape(name, frame, contractions, str(path)), 1.0),))


def _parts(
    path: Path, key: str, table: object, shapes: Mapping[str, CaptureShape]
) -> tuple[tuple[CaptureShape, float], ...]:
    """Blend shapes with their shares."""
    if not isinstance(table, dict) or not table:
        raise FormatError(path, "must be a table of blend shape = share", key=f"{key}.shapes")
    parts = []
    for shape, share in table.items():
        if shape not in shapes:
            raise FormatError(path, "is no blend shape of arkit.toml", key=f"{key}.shapes.{shape}")
        if isinstance(share, bool) or not isinstance(share, int | float) or not 0.0 < share <= 2.0:
            raise FormatError(
                path, f"must be a share above 0, up to 2, but it is {share!r}", key=f"{key}.shapes.{shape}"
            )
        parts.append((shapes[shape], float(share)))
    return tuple(parts)
