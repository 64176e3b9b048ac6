"""Emotion presets: TOML files of words that a user may copy, edit and add to. Their format is in docs/formats.md.

One file holds any number of words, each a table. A word of the paper's Table 6, and an archetype's own name, take
activation, angle and category from the paper unless the preset says otherwise; a new word brings its own.
"""

from __future__ import annotations

import difflib
import re
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import MappingProxyType

from ...errors import FormatError, ParameterError
from ...resources import PRESETS
from .archetypes import BASE_WORDS, VARIANTS
from .profile import ARCHETYPES, Archetype
from .wheel import ACTIVATION_MAX, ACTIVATION_MIN, position
from .words import TABLE_WORDS, LazyWords, Word

EMOTION_PRESETS = PRESETS / "emotions"
"""The presets that come with Risorius."""

KEYS = ("activation", "evaluation", "angle", "category", "neighbours", "variants", "neutral", "reason", "source")


def load_emotions(paths: Iterable[str | Path] = (), *, bundled: bool = True) -> Mapping[str, Word]:
    """Emotion words out of preset files.

    Parameters
    ----------
    paths : TOML files, or folders of them (read in the order of their names); a word in a later file replaces the
        same word of an earlier one.
    bundled : begin with the presets that come with Risorius.

    Returns
    -------
    Word name -> Word.

    Raises
    ------
    FormatError
        Names the file, the key and the rule it breaks.
    """
    words: dict[str, Word] = {}
    for path in ([EMOTION_PRESETS] if bundled else []) + [Path(path) for path in paths]:
        for file in _files(path):
            words.update(_read_file(file))
    return MappingProxyType(words)


WORDS: Mapping[str, Word] = LazyWords(load_emotions)
"""The words that come with Risorius: Table 6, the archetypes' names, and the project's own additions."""


def _files(path: Path) -> list[Path]:
    """The file itself, or the presets of a folder."""
    if path.is_dir():
        return sorted(path.glob("*.toml"))
    if not path.is_file():
        raise FormatError(path, "does not exist: give a .toml file or a folder of them")
    return [path]


def _read_file(path: Path) -> dict[str, Word]:
    """All words of one file."""
    try:
        document = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise FormatError(path, f"cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise FormatError(path, "is not UTF-8 text: save it as UTF-8", offset=error.start) from error
    except tomllib.TOMLDecodeError as error:
        line = re.search(r"at line (\d+)", str(error))
        problem = f"is not valid TOML: {error}"
        raise FormatError(path, problem, line=int(line.group(1)) if line else None) from error
    return {name: _Entry(path, name, table).word() for name, table in document.items()}


class _Entry:
    """One word's table while it is checked: every refusal names file, key and rule."""

    def __init__(self, path: Path, name: str, table: object) -> None:
        self.path, self.name = path, name
        if not isinstance(table, dict):
            raise FormatError(path, "must be a table: begin it with [word] in brackets", key=name)
        self.table: dict[str, object] = table

    def refuse(self, key: str, rule: str) -> FormatError:
        """The error for one key; says what stands there."""
        value = self.table.get(key, "missing")
        return FormatError(self.path, f"{rule}, but it is {value!r}", key=f"{self.name}.{key}")

    def word(self) -> Word:
        """The checked word."""
        for key in self.table:
            if key not in KEYS:
                near = difflib.get_close_matches(key, KEYS, n=1)
                hint = f"did you mean {near[0]}?" if near else f"known keys are {', '.join(KEYS)}"
                raise FormatError(self.path, f"is not a key of an emotion; {hint}", key=f"{self.name}.{key}")
        known = self.known()
        neutral = self.flag("neutral", known.neutral if known else False)
        category = self.archetype("category") or (known.category if known else None)
        angle = self.number("angle", 0.0, 360.0, known.angle if known else None)
        activation = self.number("activation", ACTIVATION_MIN, ACTIVATION_MAX, known.activation if known else None)
        if not neutral and activation is None:
            raise self.refuse("activation", f"must be a number from {ACTIVATION_MIN:g} to {ACTIVATION_MAX:g}")
        if not neutral and category is None and angle is None and "neighbours" not in self.table:
            raise self.refuse("category", "must be given unless the word has an angle (or is neutral)")
        try:
            return Word(
                name=self.name,
                activation=activation,
                evaluation=self.number("evaluation", 1.0, 7.0, known.evaluation if known else None),
                angle=angle,
                category=category,
                neighbours=self.neighbours(category, angle),
                variants=self.variants(),
                neutral=neutral,
                reason=self.text("reason"),
                source=self.text("source") if known is None or "source" in self.table else known.source,
            )
        except ParameterError as error:
            raise FormatError(self.path, str(error), key=self.name) from error

    def known(self) -> Word | None:
        """What the paper says of this word, or of the archetype of this name."""
        if self.name in ARCHETYPES:
            base = TABLE_WORDS[BASE_WORDS[Archetype(self.name)].word]
            return Word(self.name, base.activation, base.evaluation, base.angle, base.category, source=base.source)
        return TABLE_WORDS.get(self.name)

    def number(self, key: str, low: float, high: float, default: float | None) -> float | None:
        """A number inside its bounds."""
        if key not in self.table:
            return default
        value = self.table[key]
        if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
            raise self.refuse(key, f"must be a number from {low:g} to {high:g}")
        return float(value)

    def flag(self, key: str, default: bool) -> bool:
        """true or false."""
        value = self.table.get(key, default)
        if not isinstance(value, bool):
            raise self.refuse(key, "must be true or false")
        return value

    def text(self, key: str) -> str:
        """A text that says something."""
        value = self.table.get(key)
        if not isinstance(value, str) or not value.strip():
            raise self.refuse(key, "must be a text: later readers want to know")
        return " ".join(value.split())

    def archetype(self, key: str) -> Archetype | None:
        """One of the six, or nothing."""
        if key not in self.table:
            return None
        if self.table[key] not in ARCHETYPES:
            raise self.refuse(key, f"must be one of {', '.join(ARCHETYPES)}")
        return Archetype(str(self.table[key]))

    def neighbours(self, category: Archetype | None, angle: float | None) -> tuple[Archetype, Archetype] | None:
        """Two different archetypes whose shorter arc holds the word's angle, or nothing."""
        if "neighbours" not in self.table:
            return None
        value = self.table["neighbours"]
        if not isinstance(value, list) or len(value) != 2 or any(name not in ARCHETYPES for name in value):
            raise self.refuse("neighbours", f"must be two of {', '.join(ARCHETYPES)}")
        if value[0] == value[1] or category is not None or angle is None:
            raise self.refuse("neighbours", "must be two different archetypes, with an angle and without a category")
        first, second = Archetype(value[0]), Archetype(value[1])
        try:
            position(angle, BASE_WORDS[first].angle, BASE_WORDS[second].angle)
        except ParameterError as error:
            raise FormatError(self.path, str(error), key=f"{self.name}.angle") from error
        return first, second

    def variants(self) -> dict[Archetype, int]:
        """Archetype -> an existing variant."""
        value = self.table.get("variants", {})
        if not isinstance(value, dict):
            raise self.refuse("variants", "must be a table such as { fear = 8 }")
        for name, number in value.items():
            if name not in ARCHETYPES:
                raise self.refuse("variants", f"must name archetypes ({', '.join(ARCHETYPES)})")
            if isinstance(number, bool) or number not in VARIANTS[Archetype(name)]:
                allowed = ", ".join(map(str, VARIANTS[Archetype(name)]))
                raise self.refuse("variants", f"must give {name} one of the variants {allowed}")
        return {Archetype(name): int(number) for name, number in value.items()}
