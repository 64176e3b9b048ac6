"""Emotion presets: TOML files of words that a user may copy, edit and add to. Their format is in docs/formats.md.

One file holds any number of words, each a table. A word of the paper's Table 6, and an archetype's own name, take
activation, angle and category from the paper unless the preset says otherwise; a new word brings its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from types import MappingProxyType

from ...errors import FormatError, ParameterError
from ...resources import PRESETS
from ...tables import TomlTable, read_toml
from .archetypes import BASE_WORDS, VARIANTS
from .bearing import read_bearing
from .profile import ARCHETYPES, Archetype
from .prototypes import Prototype, read_prototype
from .wheel import ACTIVATION_MAX, ACTIVATION_MIN, position
from .words import TABLE_WORDS, LazyWords, Word

EMOTION_PRESETS = PRESETS / "emotions"
"""The presets that come with Risorius."""

KEYS = (
    *("activation", "evaluation", "angle", "category", "neighbours", "variants"),
    *("shows", "bearing", "neutral", "synonyms", "reason", "source"),
)


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

    Examples
    --------
    >>> text = '[wistful]\\nactivation = 2.4\\nangle = 95.0\\nneighbours = ["joy", "sadness"]\\n'
    >>> _ = open("mine.toml", "w").write(text + 'reason = "a weak smile"\\nsource = "our own choice"\\n')
    >>> words = api.load_emotions(["mine.toml"])
    >>> api.expression("wistful", words=words).activation
    2.4
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
    document = read_toml(path)
    return {name: _word(name, document.table(name)) for name in document}


def _word(name: str, table: TomlTable) -> Word:
    """One word, checked."""
    table.only(*KEYS)
    known = _known(name)
    neutral = table.flag("neutral", known.neutral if known else False)
    category = table.choice("category", Archetype) if "category" in table else (known.category if known else None)
    angle = _number(table, "angle", 0.0, 360.0, known.angle if known else None)
    activation = _number(table, "activation", ACTIVATION_MIN, ACTIVATION_MAX, known.activation if known else None)
    if not neutral and activation is None:
        table.number("activation", least=ACTIVATION_MIN, most=ACTIVATION_MAX)  # refuses it: it is missing
    if not neutral and category is None and angle is None and "neighbours" not in table:
        raise table.refuse("is missing: it must be given unless the word has an angle (or is neutral)", "category")
    return table.made(
        lambda: Word(
            name=name,
            activation=activation,
            evaluation=_number(table, "evaluation", 1.0, 7.0, known.evaluation if known else None),
            angle=angle,
            category=category,
            neighbours=_neighbours(table, category, angle),
            variants=_variants(table),
            shows=_shows(name, table, activation),
            bearing=read_bearing(table.table("bearing")) if "bearing" in table else None,
            neutral=neutral,
            synonyms=tuple(table.texts("synonyms")) if "synonyms" in table else (),
            reason=_text(table, "reason"),
            source=_text(table, "source") if known is None or "source" in table else known.source,
        )
    )


def _known(name: str) -> Word | None:
    """What the paper says of this word, or of the archetype of this name."""
    if name in ARCHETYPES:
        base = TABLE_WORDS[BASE_WORDS[Archetype(name)].word]
        return Word(name, base.activation, base.evaluation, base.angle, base.category, source=base.source)
    return TABLE_WORDS.get(name)


def _number(table: TomlTable, key: str, least: float, most: float, known: float | None) -> float | None:
    """A number inside its bounds; what is known where the table is silent."""
    return table.number(key, least=least, most=most) if key in table else known


def _text(table: TomlTable, key: str) -> str:
    """A text in one line."""
    return " ".join(table.text(key).split())


def _neighbours(
    table: TomlTable, category: Archetype | None, angle: float | None
) -> tuple[Archetype, Archetype] | None:
    """Two different archetypes whose shorter arc holds the word's angle, or nothing."""
    if "neighbours" not in table:
        return None
    names = table.texts("neighbours")
    if len(names) != 2 or any(name not in ARCHETYPES for name in names):
        raise table.refuse(f"must be two of {', '.join(ARCHETYPES)}, but it is {names!r}", "neighbours")
    if names[0] == names[1] or category is not None or angle is None:
        raise table.refuse("must be two different archetypes, with an angle and without a category", "neighbours")
    first, second = Archetype(names[0]), Archetype(names[1])
    try:
        position(angle, BASE_WORDS[first].angle, BASE_WORDS[second].angle)
    except ParameterError as error:
        raise table.refuse(str(error), "angle") from error
    return first, second


def _shows(name: str, table: TomlTable, activation: float | None) -> Prototype | None:
    """The action units of a word that has some of its own."""
    if "shows" not in table:
        return None
    if activation is None:
        raise table.refuse("must not be given for a neutral word", "shows")
    return read_prototype(table.table("shows"), name, "shows", activation)


def _variants(table: TomlTable) -> dict[Archetype, int]:
    """Archetype -> an existing variant."""
    variants = table.table("variants", optional=True)
    found = {}
    for name in variants:
        if name not in ARCHETYPES:
            raise variants.refuse(f"must name archetypes ({', '.join(ARCHETYPES)})", name)
        allowed, number = VARIANTS[Archetype(name)], variants.integer(name)
        if number not in allowed:
            raise variants.refuse(f"must be one of the variants {', '.join(map(str, allowed))}", name)
        found[Archetype(name)] = number
    return found
