"""The high-level FAPs: 1 (viseme) and 2 (expression), their sub-fields, and what they expand to.

The standard leaves both to the decoder. An expression is the default variant of its archetype; a viseme's shape is a
row of ``data/viseme_shapes.csv``.

Source: ISO/IEC 14496-2 by way of public readers (Xface, Visage): a viseme cross-fades to a second one, an expression
adds a second one, and an explicit low-level FAP overrides both.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError
from ..resources import STANDARD
from ..tables import read_csv
from .emotions.archetypes import archetype
from .emotions.expressions import default_variant
from .emotions.profile import ARCHETYPES, Archetype
from .standard import FAP_COUNT

FULL = 63
"""Blend and intensity at full strength."""


@dataclass(frozen=True)
class Viseme:
    """A viseme of FAP 1: number 0..14 (0 is none), its phonemes and example words."""

    number: int
    phonemes: tuple[str, ...]
    examples: tuple[str, ...]


@dataclass(frozen=True)
class Expression:
    """An expression of FAP 2: code 0..6 (0 is none), its archetype, and what the standard's face does."""

    code: int
    archetype: Archetype | None
    description: str


VISEMES: Mapping[int, Viseme] = MappingProxyType(
    {
        row.integer("number"): Viseme(row.integer("number"), row.texts("phonemes"), row.texts("examples"))
        for row in read_csv(STANDARD / "visemes.csv")
    }
)
"""Visemes by number: 0 for none and the standard's 14."""

EXPRESSIONS: Mapping[int, Expression] = MappingProxyType(
    {
        row.integer("code"): Expression(
            row.integer("code"),
            None if row.text("name") == "none" else row.choice("name", ARCHETYPES),
            row.text("description"),
        )
        for row in read_csv(STANDARD / "expressions.csv")
    }
)
"""Expressions by code: 0 for none and the standard's 6."""


def _viseme_shapes() -> Mapping[int, Floats]:
    """The rows of viseme_shapes.csv as frames; a heading of two numbers gives both FAPs the same value."""
    shapes = {}
    for row in read_csv(STANDARD / "viseme_shapes.csv"):
        frame = np.full(FAP_COUNT, np.nan)
        for heading in row:
            if heading not in ("viseme", "reason") and heading in row:
                frame[[int(number) - 1 for number in heading.split()]] = row.number(heading)
        frame.flags.writeable = False
        shapes[row.integer("viseme")] = frame
    return MappingProxyType(shapes)


VISEME_SHAPES: Mapping[int, Floats] = _viseme_shapes()
"""Viseme number 1..14 -> (68,) FAPs of its mouth, NaN where silent; read-only."""


def _check(name: str, value: int, top: int) -> None:
    """A whole number in 0..top."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or not 0 <= value <= top:
        raise ParameterError(name, f"must be a whole number in 0..{top}", value)


@dataclass(frozen=True)
class VisemeField:
    """The value of FAP 1: two visemes and their blend.

    Attributes
    ----------
    select1, select2 : viseme numbers 0..14.
    blend : 0..63; 63 is the first viseme alone.
    define : 1 where the mouth FAPs sent along define the viseme's shape, else 0.
    """

    select1: int
    select2: int = 0
    blend: int = FULL
    define: int = 0

    def __post_init__(self) -> None:
        """Check every sub-field."""
        for name, value, top in (
            ("viseme_select1", self.select1, 14),
            ("viseme_select2", self.select2, 14),
            ("viseme_blend", self.blend, FULL),
            ("viseme_def", self.define, 1),
        ):
            _check(name, value, top)

    @property
    def values(self) -> tuple[int, int, int, int]:
        """The sub-fields in file order."""
        return self.select1, self.select2, self.blend, self.define


@dataclass(frozen=True)
class ExpressionField:
    """The value of FAP 2: two expressions with their intensities.

    Attributes
    ----------
    select1, select2 : expression codes 0..6.
    intensity1, intensity2 : 0..63.
    init_face : 1 where the neutral face may be changed before FAPs apply, else 0.
    define : 1 where the FAPs sent along define the expression, else 0.
    """

    select1: int
    intensity1: int = FULL
    select2: int = 0
    intensity2: int = 0
    init_face: int = 0
    define: int = 0

    def __post_init__(self) -> None:
        """Check every sub-field."""
        for name, value, top in (
            ("expression_select1", self.select1, 6),
            ("expression_intensity1", self.intensity1, FULL),
            ("expression_select2", self.select2, 6),
            ("expression_intensity2", self.intensity2, FULL),
            ("init_face", self.init_face, 1),
            ("expression_def", self.define, 1),
        ):
            _check(name, value, top)

    @property
    def values(self) -> tuple[int, int, int, int, int, int]:
        """The sub-fields in file order."""
        return self.select1, self.intensity1, self.select2, self.intensity2, self.init_face, self.define


def expression_frame(field: ExpressionField) -> Floats:
    """The FAPs an expression value stands for: e1 * intensity1/63 + e2 * intensity2/63.

    Each expression is the archetype's profile of its preset, at its range midpoints.

    Returns
    -------
    (68,) float64, FAP units; NaN where neither expression asks.

    Examples
    --------
    >>> frame = api.expression_frame(api.ExpressionField(select1=1, intensity1=63))  # all of joy
    >>> print(api.recognise(frame).best)
    joy
    """
    frames = []
    for code, intensity in ((field.select1, field.intensity1), (field.select2, field.intensity2)):
        emotion = EXPRESSIONS[code].archetype
        if emotion is not None:
            frames.append(archetype(emotion, default_variant(emotion)).frame() * (intensity / FULL))
    return _sum(frames)


def viseme_frame(field: VisemeField, shapes: Mapping[int, Floats] = VISEME_SHAPES) -> Floats:
    """The FAPs a viseme value stands for: v1 * blend/63 + v2 * (1 - blend/63).

    Parameters
    ----------
    field : the value of FAP 1.
    shapes : viseme number -> (68,) FAPs, NaN where silent; viseme 0 is the neutral mouth and needs none. Give your own
        to replace those of the table.

    Returns
    -------
    (68,) float64, FAP units; NaN where neither viseme asks.

    Raises
    ------
    ParameterError
        When a viseme in use has no shape.

    Examples
    --------
    >>> frame = api.viseme_frame(api.VisemeField(select1=10))  # "A" as in "car"
    >>> bool(frame[api.fap("open_jaw").number - 1] > 0.0)
    True
    """
    frames = []
    for number, weight in ((field.select1, field.blend / FULL), (field.select2, 1.0 - field.blend / FULL)):
        if number == 0 or weight == 0.0:
            continue
        if number not in shapes:
            raise ParameterError("viseme shapes", f"must contain viseme {number} ({_names(number)})", sorted(shapes))
        frames.append(np.asarray(shapes[number], dtype=np.float64) * weight)
    return _sum(frames)


def expand(low_level: Floats, *high_level: Floats) -> Floats:
    """Low-level FAPs over what high-level ones expand to: an explicit value overrides, the rest adds up.

    Parameters
    ----------
    low_level : (68,) explicit FAPs, NaN where there is none.
    high_level : any number of (68,) expansions.
    """
    return np.where(np.isnan(low_level), _sum(list(high_level)), low_level)


def _sum(frames: list[Floats]) -> Floats:
    """Sum that is silent only where every frame is."""
    stack = np.array([np.full(FAP_COUNT, np.nan), *frames])
    silent = np.isnan(stack).all(axis=0)
    return np.where(silent, np.nan, np.nansum(stack, axis=0))


def _names(number: int) -> str:
    return " ".join(VISEMES[number].phonemes)
