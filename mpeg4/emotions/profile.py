"""A profile: the FAPs of one expression and the range in which each may vary.

Source: Raouzaiou et al. 2002, sections 2 (what a profile is), 3.3 and 4.1.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ..standard import FAP_COUNT, FAPS, LIP_TWINS, PAIRS
from .wheel import check_activation, check_angle

if TYPE_CHECKING:
    from .bearing import Bearing
    from .prototypes import Prototype

Range: TypeAlias = tuple[float, float]


class Archetype(StrEnum):
    """The six archetypal emotions, in the order of FAP 2 (code 1..6)."""

    JOY = "joy"
    SADNESS = "sadness"
    ANGER = "anger"
    FEAR = "fear"
    DISGUST = "disgust"
    SURPRISE = "surprise"


ARCHETYPES: tuple[Archetype, ...] = tuple(Archetype)
"""The archetypes in the order of FAP 2; the columns of `emotion_weights`."""


class Signs(StrEnum):
    """Whose signs a profile is in: MPEG-4's throughout, or the paper's as printed."""

    MPEG4 = "mpeg4"
    PAPER = "paper"


def check_archetype(name: str) -> Archetype:
    """The archetype of this name.

    Raises
    ------
    ParameterError
        When it is none of the six.
    """
    try:
        return Archetype(name)
    except ValueError:
        raise ParameterError("archetype", f"must be one of {', '.join(ARCHETYPES)}", name) from None


def check_signs(signs: str) -> Signs:
    """The sign convention of this name; ParameterError when there is none."""
    try:
        return Signs(signs)
    except ValueError:
        raise ParameterError("signs", f"must be one of {', '.join(Signs)}", signs) from None


#: The way of showing an archetype that is its profile alone, as the paper prints it.
AS_PRINTED = "paper"


class Feeling(dict[Archetype, float]):
    """Archetype -> share of it in an expression, and how strongly it is felt. Equal to any mapping of the same shares.

    Attributes
    ----------
    activation : Whissell's, 1..7; None: each archetype's own.
    strength : how much of it shows, 0..1: less while it comes and goes.
    prototypes : archetype -> which of the ways of showing it (presets/prototypes.toml), or "paper": as its
        profile says and no otherwise. Others as usual.
    shows : what a word shows that has action units of its own, instead of shares of the archetypes' prototypes.
    """

    def __init__(
        self,
        shares: Mapping[Archetype, float] | Mapping[str, float],
        *,
        activation: float | None = None,
        strength: float = 1.0,
        prototypes: Mapping[Archetype, str] | Mapping[str, str] | None = None,
        shows: Prototype | None = None,
    ) -> None:
        super().__init__({check_archetype(name): float(share) for name, share in shares.items()})
        self.activation = None if activation is None else check_activation(activation)
        self.strength = strength
        self.prototypes: Mapping[str, str] = {str(name): way for name, way in (prototypes or {}).items()}
        self.shows = shows

    @classmethod
    def of(cls, shares: Mapping[Archetype, float] | Mapping[str, float]) -> Feeling:
        """Shares as they are felt; those without an activation at each archetype's own."""
        return shares if isinstance(shares, cls) else cls(shares)

    def faded(self, share: float) -> Feeling:
        """The same as a share 0..1 of it shows, while it comes or goes."""
        return Feeling(
            self,
            activation=self.activation,
            strength=share * self.strength,
            prototypes=self.prototypes,
            shows=self.shows,
        )


@dataclass(frozen=True)
class Profile:
    """An expression as ranges of FAPs.

    Attributes
    ----------
    ranges : FAP number -> (low, high), low <= high, in FAP units (1024ths of the FAP's FAPU), sorted by number.
        A FAP that is not in it is silent: the profile makes no statement, which is not the same as zero.
        It is the profile's own copy; treat it as read-only.
    activation : Whissell's activation, 1..7, at which the ranges hold.
    angle : direction on the wheel in degrees, [0, 360).
    weights : archetype -> share of it in this expression; sums to 1 (empty only for the neutral face). It knows the
        profile's activation and prototypes, so that `Face.pose(frame, emotion=profile.weights)` does.
    category : the archetype whose degree this is; None between archetypes and for the neutral face.
    word : the emotion word it was made for, if any.
    variants : archetype -> number of the Table 5 variant it was made from, where there is one.
    signs : the sign convention of the ranges. Faces and recognition expect MPEG-4's.
    prototypes : archetype -> the way in which a face shows it in the natural drive, where not the usual one; "paper" is
        as the ranges say and no otherwise.
    shows : action units by which a face shows the word in the natural drive, where they are not its archetypes'.
    bearing : where the word turns eyes and head in a performance.

    Raises
    ------
    ParameterError
        When a FAP number, a range, the activation, or the weights break their rule.
    """

    ranges: dict[int, Range]
    activation: float
    angle: float
    weights: Mapping[Archetype, float]
    category: Archetype | None = None
    word: str | None = None
    variants: Mapping[Archetype, int] = field(default_factory=dict)
    signs: Signs = Signs.MPEG4
    prototypes: Mapping[Archetype, str] = field(default_factory=dict)
    shows: Prototype | None = None
    bearing: Bearing | None = None

    def __post_init__(self) -> None:
        """Check and normalise every field."""
        checked: dict[int, Range] = {}
        for number in sorted(self.ranges):
            if number not in FAPS or FAPS[number].high_level:
                raise ParameterError("FAP number in a profile", f"must be in 3..{FAP_COUNT}", number)
            low, high = map(float, self.ranges[number])
            if not (math.isfinite(low) and math.isfinite(high) and low <= high):
                raise ParameterError(f"range of F{number}", "must be finite with low <= high", (low, high))
            checked[number] = (low, high)
        weights = {check_archetype(name): float(share) for name, share in self.weights.items()}
        if weights and (min(weights.values()) < 0.0 or abs(sum(weights.values()) - 1.0) > 1e-9):
            raise ParameterError("weights", "must be shares >= 0 that sum to 1", weights)
        if bool(checked) and not weights:
            raise ParameterError("weights", "must name at least one archetype unless the profile is empty", weights)
        normalised = {
            "ranges": checked,
            "activation": check_activation(self.activation),
            "angle": check_angle(self.angle),
            "weights": Feeling(weights, activation=self.activation, prototypes=self.prototypes, shows=self.shows),
            "category": None if self.category is None else check_archetype(self.category),
            "variants": {check_archetype(name): int(number) for name, number in self.variants.items()},
            "signs": check_signs(self.signs),
            "prototypes": {check_archetype(name): way for name, way in self.prototypes.items()},
        }
        for name, value in normalised.items():
            object.__setattr__(self, name, value)

    @property
    def variant(self) -> int | None:
        """Number of the Table 5 variant, where the profile is made from exactly one."""
        return next(iter(self.variants.values())) if len(self.variants) == 1 else None

    @property
    def neutral(self) -> bool:
        """True where the profile asks for nothing."""
        return not self.ranges

    def scaled(self, activation: float) -> Profile:
        """The same expression at another activation: section 4.1, Rule 2, X_I = (a_I / a_A) X_A.

        Raises
        ------
        ParameterError
            When the activation is off the scale.

        Examples
        --------
        >>> joy = api.expression("joy", activation=3.0)
        >>> joy.scaled(6.0).ranges[12][0] / joy.ranges[12][0]
        2.0
        """
        wanted, own = check_activation(activation), self.activation
        if wanted == own:
            return self  # x * a / a is not x in every last digit
        ranges = {number: (low * wanted / own, high * wanted / own) for number, (low, high) in self.ranges.items()}
        return replace(self, ranges=ranges, activation=wanted)

    def named(self, word: str | None) -> Profile:
        """The same profile under an emotion word.

        Examples
        --------
        >>> api.archetype("joy").named("blissful").word
        'blissful'
        """
        return replace(self, word=word)

    def frame(self, rng: np.random.Generator | int | None = None, *, asymmetry: float = 0.0) -> Floats:
        """One FAP frame out of the ranges.

        Parameters
        ----------
        rng : None takes every range's midpoint. A generator, or a seed for one, draws uniformly inside each range:
            the paper's fuzziness against robot-like faces (section 4.1). One draw takes the same amount from the
            generator whatever the profile, so one seed gives related words related faces.
        asymmetry : 0 draws left and right together (and the inner with the outer contour of a lip, which is one
            lip); 1 draws left and right independently; between, a mixture. Midpoints ignore it.

        Returns
        -------
        (68,) float64, FAP units, index = FAP number - 1; NaN where the profile is silent.

        Raises
        ------
        ParameterError
            When the asymmetry is outside 0..1.

        Examples
        --------
        >>> joy = api.expression("joy")
        >>> low, high = joy.ranges[12]  # raise_l_cornerlip
        >>> float(joy.frame()[12 - 1]) == (low + high) / 2
        True
        >>> bool(low <= joy.frame(7)[12 - 1] <= high)  # a draw with the seed 7
        True
        """
        if not 0.0 <= asymmetry <= 1.0:
            raise ParameterError("asymmetry", "must be in 0..1", asymmetry)
        place = np.full(FAP_COUNT, 0.5) if rng is None else _places(np.random.default_rng(rng), asymmetry)
        frame = np.full(FAP_COUNT, np.nan)
        for number, (low, high) in self.ranges.items():
            frame[number - 1] = low + place[number - 1] * (high - low)
        return frame


def _places(rng: np.random.Generator, asymmetry: float) -> Floats:
    """Relative place of each FAP in its range, (68,) in [0, 1): pairs tied as far as the asymmetry allows."""
    together, alone = rng.random((2, FAP_COUNT))
    for inner, outer in LIP_TWINS:
        together[outer - 1], alone[outer - 1] = together[inner - 1], alone[inner - 1]
    for left, right in PAIRS:
        together[right - 1] = (1.0 - asymmetry) * together[left - 1] + asymmetry * alone[right - 1]
    return np.asarray(together, dtype=np.float64)
