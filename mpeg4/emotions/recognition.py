"""From FAPs back to emotions: Raouzaiou et al. 2002, section 5, equations (8) to (11).

A profile is a fuzzy class per FAP; the belief in it is the product of the observed FAPs' memberships (8); the belief in
an emotion is that in its best profile (9). The shape of the membership function (figure 6) is lost: `membership` is the
one that served the emotion best that fared worst on posed faces (docs/evidence.md).

A product has two weaknesses: one FAP that a face does not show kills a profile, and profiles of few FAPs are believed
more readily than those of many. The robust rule is its cure, and stands beside it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Bools, Floats
from ...errors import ParameterError
from ..standard import FAP_COUNT
from .archetypes import VARIANTS, archetype
from .expressions import expression
from .features import FEATURE_COUNT, faps_from_features
from .profile import ARCHETYPES, Archetype, Profile

# Half of the range's length is the paper's own spread. Faces differ in strength by more than the printed variants do,
# so a range is widened to this share of its centre, and to this many units where it is printed around 0. Chosen with
# the shape on posed faces (docs/evidence.md).
RELATIVE_WIDTH = 1.0
LEAST_WIDTH = 80.0  # FAP units

# By the paper's rule a FAP that was not seen speaks neither for nor against a profile: it counts as one width off the
# centre. Left out instead, it would favour the profiles that ask for what cannot be seen.
UNSEEN_MEMBERSHIP = 0.5

# With less than this share of its FAPs seen, a profile is not judged at all: one lucky FAP is no evidence.
LEAST_SEEN = 0.5

# What a membership is taken for at least by the robust rule, so that one FAP does not decide alone.
LEAST_MEMBERSHIP = 1e-6


class Rule(StrEnum):
    """How memberships of FAPs become the belief in a profile.

    paper : their product, equation (8).
    robust : their geometric mean, FAPs that were not seen skipped: profiles of few and of many FAPs are judged alike.
    """

    PAPER = "paper"
    ROBUST = "robust"


@dataclass(frozen=True, eq=False)
class _Class:
    """What recognition works on: FAP indices, centres and widths of one profile, (k,) each."""

    indices: tuple[int, ...]
    centres: Floats
    widths: Floats

    def memberships(self, values: Floats) -> Floats:
        """(k,) memberships of a frame (68,); NaN where not seen."""
        asked = values[list(self.indices)]
        found: Floats = np.where(np.isnan(asked), np.nan, membership(asked, self.centres, self.widths))
        return found


class Beliefs(dict[Archetype, float]):
    """Archetype -> belief in [0, 1].

    Attributes
    ----------
    profiles : archetype -> variant -> belief in that profile of Table 5.
    decisive : FAP number -> how much it speaks for the best emotion's best profile against the runner-up's: the
        logarithm of the ratio of the memberships (1 where a profile does not ask for it), the weightiest first.
    """

    def __init__(
        self, profiles: Mapping[Archetype, Mapping[int, float]], decisive: Mapping[int, float] | None = None
    ) -> None:
        super().__init__({name: max(of_variants.values()) for name, of_variants in profiles.items()})
        self.profiles: dict[Archetype, dict[int, float]] = {name: dict(part) for name, part in profiles.items()}
        self.decisive: Mapping[int, float] = MappingProxyType(dict(decisive or {}))

    @property
    def best(self) -> Archetype | None:
        """The emotion of the largest belief (11); None where nothing is believed at all."""
        name = max(self, key=self.__getitem__)
        return name if self[name] > 0.0 else None

    @property
    def best_profile(self) -> Profile | None:
        """The profile of Table 5 that decided for the best emotion, in MPEG-4 signs; None where nothing is believed."""
        if self.best is None:
            return None
        variants = self.profiles[self.best]
        return archetype(self.best, max(variants, key=variants.__getitem__))


def membership(values: Floats, centres: Floats, widths: Floats) -> Floats:
    """Membership in fuzzy classes: 1 at the centre, 1/2 one width away, a normal curve.

    Parameters
    ----------
    values, centres, widths : arrays of one shape, in FAP units; widths > 0.

    Returns
    -------
    Memberships in [0, 1], of the same shape.
    """
    return np.asarray(np.exp2(-(((values - centres) / widths) ** 2)), dtype=np.float64)


def recognise(frame: ArrayLike, *, rule: str | Rule = Rule.PAPER) -> Beliefs:
    """Beliefs that a FAP frame shows each archetypal emotion: equations (8) and (9).

    Parameters
    ----------
    frame : (68,) FAPs in FAP units and MPEG-4 signs, index = FAP number - 1; NaN where not observed, which by the
        paper's rule counts as a membership of 1/2. A profile of which less than half is observed has the belief 0.
    rule : "paper" (default) or "robust"; see `Rule`.

    Returns
    -------
    Archetype -> belief; its ``profiles`` gives each variant's belief, its ``best`` the decision of equation (11), its
    ``decisive`` the FAPs that made it.

    Raises
    ------
    ParameterError
        When the frame has another shape or infinite values, or there is no such rule.

    Examples
    --------
    >>> beliefs = api.recognise(api.archetype("surprise").frame())
    >>> print(beliefs.best)
    surprise
    """
    return _beliefs(_checked(frame), np.ones(FAP_COUNT, dtype=np.bool_), _rule(rule))


def recognise_words(frame: ArrayLike, words: Iterable[str], *, rule: str | Rule = Rule.ROBUST) -> dict[str, float]:
    """Beliefs that a FAP frame shows each of some emotion words, intermediate ones too, by the profiles of section 4.

    Parameters
    ----------
    frame : as for `recognise`.
    words : emotion words; a neutral one is left out. Profiles of one category are alike but for their strength.
    rule : "robust" (default), because profiles between archetypes ask for many more FAPs than archetypes; or "paper".

    Returns
    -------
    Word -> belief in [0, 1], the most believed first.

    Raises
    ------
    ParameterError
        As `recognise`, and for an unknown word.

    Examples
    --------
    >>> beliefs = api.recognise_words(api.expression("terrified").frame(), ["terrified", "joy", "sad"])
    >>> next(iter(beliefs))
    'terrified'
    """
    values, chosen, everything = _checked(frame), _rule(rule), np.ones(FAP_COUNT, dtype=np.bool_)
    profiles = {word: expression(word) for word in words}
    beliefs = {
        word: _belief(_class(profile), values, everything, chosen)
        for word, profile in profiles.items()
        if profile.ranges
    }
    return dict(sorted(beliefs.items(), key=lambda item: -item[1]))


def shown_strength(frame: ArrayLike, profile: Profile) -> float:
    """How strongly a frame shows a profile: 0 not at all, 1 as the profile asks in the middle of its ranges.

    Beliefs tell what an expression is most like, and that is something on a resting face, too; this tells whether there
    is an expression. It is the share of the profile that comes closest to the frame (least squares), never below 0.

    Parameters
    ----------
    frame : as for `recognise`. FAPs that were not observed, or that the profile leaves alone, do not count.

    Raises
    ------
    ParameterError
        When the frame has another shape or infinite values.

    Examples
    --------
    >>> joy = api.archetype("joy")
    >>> round(api.shown_strength(joy.frame(), joy), 6)
    1.0
    >>> round(api.shown_strength(0.5 * joy.frame(), joy), 6)
    0.5
    """
    values, centres = _checked(frame), profile.frame()
    counted = ~np.isnan(values) & ~np.isnan(centres)
    wanted = centres[counted]
    size = float(wanted @ wanted)
    return max(0.0, float(values[counted] @ wanted) / size) if size > 0.0 else 0.0


def recognise_features(features: ArrayLike, *, rule: str | Rule = Rule.PAPER) -> Beliefs:
    """Beliefs from the 15 features of Table 3.

    Parameters
    ----------
    features : (15,) as printed in the table, in FAP units; NaN where unknown. Profiles are judged by the FAPs that
        features can show at all, so that a smile is not held against them for its unmeasured corners.
    rule : as for `recognise`.

    Returns
    -------
    As `recognise`.

    Raises
    ------
    ParameterError
        When there are not 15 finite-or-NaN numbers, or there is no such rule.

    Examples
    --------
    >>> face = api.default_face()
    >>> surprised = face.pose(api.archetype("surprise").frame(), drive="exact")
    >>> print(api.recognise_features(face.features(surprised.positions)).best)
    surprise
    """
    return _beliefs(faps_from_features(features), _shown_by_features(), _rule(rule))


def _checked(frame: ArrayLike) -> Floats:
    """A frame (68,) without infinite values."""
    values = np.asarray(frame, dtype=np.float64)
    if values.shape != (FAP_COUNT,) or np.isinf(values).any():
        raise ParameterError("frame", f"must be {FAP_COUNT} numbers (NaN where unknown)", values.shape)
    return values


def _rule(rule: str | Rule) -> Rule:
    """The rule of that name."""
    try:
        return Rule(rule)
    except ValueError:
        raise ParameterError("rule", f"must be one of {', '.join(Rule)}", rule) from None


def _beliefs(values: Floats, visible: Bools, rule: Rule) -> Beliefs:
    """Equations (8) and (9) over the visible FAPs, (68,) each; NaN where a visible FAP was not seen."""
    beliefs: dict[Archetype, dict[int, float]] = {name: {} for name in ARCHETYPES}
    for (name, variant), fuzzy in _classes().items():
        beliefs[name][variant] = _belief(fuzzy, values, visible, rule)
    return Beliefs(beliefs, _decisive(beliefs, values, visible))


def _belief(fuzzy: _Class, values: Floats, visible: Bools, rule: Rule) -> float:
    """Belief in one profile."""
    judged = visible[list(fuzzy.indices)]
    memberships = fuzzy.memberships(values)[judged]
    seen = ~np.isnan(memberships)
    if not judged.any() or seen.sum() < LEAST_SEEN * judged.sum():
        return 0.0
    if rule is Rule.PAPER:
        return float(np.where(seen, memberships, UNSEEN_MEMBERSHIP).prod())
    return float(np.exp(np.log(np.maximum(memberships[seen], LEAST_MEMBERSHIP)).mean()))


def _decisive(beliefs: Mapping[Archetype, Mapping[int, float]], values: Floats, visible: Bools) -> dict[int, float]:
    """How much each FAP speaks for the best profile against the best one of the runner-up."""
    best_of = {name: max(part, key=part.__getitem__) for name, part in beliefs.items()}
    first, second, *_ = sorted(beliefs, key=lambda name: -beliefs[name][best_of[name]])
    logs = []
    for name in (first, second):
        fuzzy = _classes()[name, best_of[name]]
        logarithm = np.zeros(FAP_COUNT)
        logarithm[list(fuzzy.indices)] = np.log(
            np.maximum(np.nan_to_num(fuzzy.memberships(values), nan=1.0), LEAST_MEMBERSHIP)
        )
        logs.append(logarithm)
    speaks = np.where(visible & ~np.isnan(values), logs[0] - logs[1], 0.0)
    return {int(index) + 1: float(speaks[index]) for index in np.argsort(-np.abs(speaks)) if speaks[index] != 0.0}


def _shown_by_features() -> Bools:
    """(68,) the FAPs that some feature shows."""
    return ~np.isnan(faps_from_features(np.zeros(FEATURE_COUNT)))


@cache
def _classes() -> Mapping[tuple[Archetype, int], _Class]:
    """The fuzzy classes of all profiles of Table 5, in MPEG-4 signs, by emotion and variant."""
    found = {(name, variant): _class(archetype(name, variant)) for name in ARCHETYPES for variant in VARIANTS[name]}
    return MappingProxyType(found)


def _class(profile: Profile) -> _Class:
    """The fuzzy class of one profile."""
    lows, highs = (np.array(ends) for ends in zip(*profile.ranges.values(), strict=True))
    centres = (lows + highs) / 2.0
    widths = np.maximum(np.maximum((highs - lows) / 2.0, RELATIVE_WIDTH * np.abs(centres)), LEAST_WIDTH)
    return _Class(tuple(number - 1 for number in profile.ranges), centres, widths)
