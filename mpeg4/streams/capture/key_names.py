"""Which shape keys to make, under which names: the presets of presets/capture/keys/, or a file of the user's own.

A row ``[keys.NAME]`` is made of blend shapes (``shapes = { jawOpen = 0.5 }``), is a viseme of the standard
(``viseme = 10``), or brings FAPs (``faps = { 3 = 400 }``) or muscles (``contractions = { risorius_l = 0.5 }``) of its
own; or the natural expression of an archetypal emotion (``emotion = "joy"``), or nothing (``rest = true``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from ....errors import FormatError
from ....tables import TomlTable, read_toml
from ...emotions.archetypes import archetype
from ...emotions.expressions import default_variant
from ...emotions.profile import Archetype
from ...high_level import VISEME_SHAPES
from .shapes import CAPTURE_PRESETS, CaptureShape, fap_frame, load_shapes, read_contractions

KEY_PRESETS = CAPTURE_PRESETS / "keys"
ROW_KEYS = ("shapes", "viseme", "emotion", "rest", "faps", "contractions")


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

    Several presets, with commas between ("arkit,oculus_visemes"), are put together, for engines that ask for several.

    Raises
    ------
    FormatError : no such preset or file, a row that breaks a rule, or one name with two meanings: names the key.

    Examples
    --------
    >>> len(api.load_key_names("arkit")), len(api.load_key_names("oculus_visemes"))
    (52, 15)
    >>> len(api.load_key_names("arkit,oculus_visemes"))
    67
    """
    if isinstance(preset, str) and "," in preset and not Path(preset).exists():
        return _together([part.strip() for part in preset.split(",") if part.strip()])
    return _one_preset(preset)


def _together(presets: Sequence[str]) -> Mapping[str, KeyShape]:
    """The keys of several presets; a name that two of them have must mean the same."""
    keys: dict[str, KeyShape] = {}
    for preset in presets:
        for name, key in _one_preset(preset).items():
            if name in keys and not _is_same(keys[name], key):
                raise FormatError(preset, "means something else in an earlier preset: leave one of them out", key=name)
            keys[name] = key
    return MappingProxyType(keys)


def _is_same(one: KeyShape, other: KeyShape) -> bool:
    """Whether two keys are made of the same shapes."""
    parts = [[(shape.name, share) for shape, share in key.parts] for key in (one, other)]
    return parts[0] == parts[1] and one.natural == other.natural


def _one_preset(preset: str | Path) -> Mapping[str, KeyShape]:
    """See `load_key_names`."""
    shapes = load_shapes()
    if str(preset) == "arkit":
        return MappingProxyType({name: KeyShape(name, ((shape, 1.0),)) for name, shape in shapes.items()})
    bundled = str(preset) in key_preset_names()
    path = KEY_PRESETS / f"{preset}.toml" if bundled else Path(preset)
    if not bundled and path.suffix.lower() != ".toml":
        raise FormatError(path, f"is not a preset of key names: use {', '.join(key_preset_names())}, or a .toml file")
    rows = read_toml(path).tables("keys")
    return MappingProxyType({name: _key(name, row, shapes) for name, row in rows.items()})


def _key(name: str, row: TomlTable, shapes: Mapping[str, CaptureShape]) -> KeyShape:
    """One row."""
    row.only(*ROW_KEYS)
    if "viseme" in row:
        viseme = row.integer("viseme", least=0, most=max(VISEME_SHAPES))
        silence = viseme == 0
        part = () if silence else ((CaptureShape(name, VISEME_SHAPES[viseme], {}, "viseme_shapes.csv"), 1.0),)
        return KeyShape(name, part, natural=True)
    if "emotion" in row:
        emotion = row.choice("emotion", Archetype)
        frame = archetype(emotion, default_variant(emotion)).frame()
        return KeyShape(name, ((CaptureShape(f"emotion {emotion}", frame, {}, "archetypes"), 1.0),), natural=True)
    if "rest" in row:
        return KeyShape(name, ())
    if "shapes" in row:
        return KeyShape(name, _parts(row.table("shapes"), shapes))
    if "faps" not in row and "contractions" not in row:
        raise row.refuse(f"must have one of {', '.join(ROW_KEYS)}")
    own = CaptureShape(name, fap_frame(row), read_contractions(row), str(row.path))
    return KeyShape(name, ((own, 1.0),))


def _parts(table: TomlTable, shapes: Mapping[str, CaptureShape]) -> tuple[tuple[CaptureShape, float], ...]:
    """Blend shapes with their shares."""
    if not table.cells:
        raise table.refuse("must be a table of blend shape = share")
    for name in table:
        if name not in shapes:
            raise table.refuse("is not a blend shape of arkit.toml", name)
    return tuple((shapes[name], table.number(name, above=0.0, most=2.0)) for name in table)
