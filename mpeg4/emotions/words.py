"""Emotion words: what the paper's Table 6 and the presets say of a word, and the words by name.

Source: Raouzaiou et al. 2002, sections 4.1, 6.1, 6.2 and Table 6; presets/emotions for everything else.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

from ...errors import ParameterError
from ...resources import STANDARD
from ...tables import read_csv
from .archetypes import VARIANTS
from .bearing import Bearing
from .profile import Archetype, check_archetype
from .prototypes import Prototype
from .wheel import check_activation, check_angle


@dataclass(frozen=True)
class Word:
    """An emotion word.

    Attributes
    ----------
    name : the word.
    activation : Whissell's activation, 1..7; None for a neutral word.
    evaluation : Whissell's evaluation, 1..7, where known.
    angle : Plutchik's angle in degrees, where known.
    category : the archetype whose degree the word is; it wins over the angle ("worried" has 126 degrees and is a
        degree of fear). None where the word lies between archetypes.
    neighbours : the two archetypes it lies between, where they are not those of its angle.
    variants : archetype -> variant of Table 5 that shows this word best; others take the archetype's own default.
    shows : action units by which the natural drive shows it, where they are not its archetypes'.
    bearing : where it turns eyes and head in a performance.
    neutral : True where the word is no expression at all (the neutral face).
    synonyms : what others call it, to suggest this word where one of them is asked for.
    reason : why these figures and variants.
    source : where they are from.
    """

    name: str
    activation: float | None
    evaluation: float | None = None
    angle: float | None = None
    category: Archetype | None = None
    neighbours: tuple[Archetype, Archetype] | None = None
    variants: Mapping[Archetype, int] = field(default_factory=dict)
    shows: Prototype | None = None
    bearing: Bearing | None = None
    neutral: bool = False
    synonyms: tuple[str, ...] = ()
    reason: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        """Check the figures and that the word says where it lies."""
        if self.neutral:
            return
        check_activation(self.activation, f"activation of {self.name}")
        if self.category is not None:
            check_archetype(self.category)
        elif self.angle is None:
            raise ParameterError(f"word {self.name}", "must have a category or an angle (or be neutral)", None)
        if self.angle is not None:
            check_angle(self.angle)
        for name, number in self.variants.items():
            if number not in VARIANTS[check_archetype(name)]:
                allowed = ", ".join(map(str, VARIANTS[name]))
                raise ParameterError(f"variant of {name}", f"must be one of {allowed}", number)


def _read_table_words() -> dict[str, Word]:
    """Table 6 as printed, with the categories the paper gives or that lie close enough to read in."""
    words = {}
    for row in read_csv(STANDARD / "words.csv"):
        name = row.text("word")
        activation, evaluation = (row.number(key) if key in row else None for key in ("activation", "evaluation"))
        words[name] = Word(
            name=name,
            activation=activation,
            evaluation=evaluation,
            angle=row.number("angle"),
            category=row.choice("category", Archetype) if "category" in row else None,
            neutral=activation is None,
            source=f"Raouzaiou et al. 2002, Table 6; {row.text('category_source', '')}".rstrip("; "),
        )
    return words


TABLE_WORDS: Mapping[str, Word] = _read_table_words()
"""The 14 words of Table 6 without any preset."""


class LazyWords(Mapping[str, Word]):
    """Words by name, read when first asked for: a damaged preset must not stop the whole package from loading."""

    def __init__(self, read: Callable[[], Mapping[str, Word]]) -> None:
        self._read = read
        self._words: Mapping[str, Word] | None = None

    def _loaded(self) -> Mapping[str, Word]:
        if self._words is None:
            self._words = self._read()
        return self._words

    def __getitem__(self, name: str) -> Word:
        """The word of this name; KeyError where there is none."""
        return self._loaded()[name]

    def __iter__(self) -> Iterator[str]:
        """Names in the order of the presets."""
        return iter(self._loaded())

    def __len__(self) -> int:
        """How many words there are."""
        return len(self._loaded())

    def __repr__(self) -> str:
        """The names."""
        return f"LazyWords({', '.join(self)})"
