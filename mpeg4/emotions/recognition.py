"""From FAPs back to emotions: Raouzaiou et al. 2002, section 5, equations (8) to (11).

A profile is a fuzzy class per FAP (`fuzzy`); the belief in it is the product of the observed FAPs' memberships (8); the
belief in an emotion is that in its best profile (9). The robust rule (`robust`) stands beside it: it is for faces that
were measured.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from enum import StrEnum
from types import MappingProxyType
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Bools, Floats
from ...errors import ParameterError
from ..standard import FAP_COUNT, FAP_LIMIT
from .beside import known_classes, known_profile
from .expressions import expression
from .features import FEATURE_COUNT, faps_from_features
from .fuzzy import LEAST_MEMBERSHIP, LEAST_SEEN, FuzzyClass, archetype_classes
from .profile import ARCHETYPES, Archetype, Profile
from .robust import RobustRule, archetype_rule

# By the paper's rule a FAP that was not seen speaks neither for nor against a profile: it counts as one width off the
# centre. Left out instead, it would favour the profiles that ask for what cannot be seen.
UNSEEN_MEMBERSHIP = 0.5

#: The verdict of the robust rule on a face at rest.
NEUTRAL: Literal["neutral"] = "neutral"

#: What a face shows; None where nothing is believed.
Verdict: TypeAlias = Archetype | Literal["neutral"] | None


class Rule(StrEnum):
    """How memberships of FAPs become the belief in a profile.

    paper : their product, equation (8).
    robust : their geometric mean over all FAPs that were seen, those that a profile does not ask for by how little they
        move, each weighed by how sure it is; and the neutral face is a verdict. See `robust`.
    """

    PAPER = "paper"
    ROBUST = "robust"

    @classmethod
    def of(cls, name: str | Rule) -> Rule:
        """The rule of that name; ParameterError when there is none."""
        try:
            return cls(name)
        except ValueError:
            raise ParameterError("rule", f"must be one of {', '.join(cls)}", name) from None


class Beliefs(dict[Archetype, float]):
    """Archetype -> belief in [0, 1].

    Attributes
    ----------
    profiles : archetype -> variant -> belief in that profile of Table 5; by the robust rule also in those beside it,
        whose variants go on where the table ends (anger 5: with the mouth shut).
    neutral : belief that the face rests; None by the paper's rule, which does not ask, and where too little was seen.
    decisive : FAP number -> how much it speaks for the best emotion's best profile against the runner-up's: the
        logarithm of the ratio of the memberships (1 where a profile does not ask for it), the weightiest first.
    """

    def __init__(
        self,
        profiles: Mapping[Archetype, Mapping[int, float]],
        decisive: Mapping[int, float] | None = None,
        neutral: float | None = None,
    ) -> None:
        super().__init__({name: max(of_variants.values()) for name, of_variants in profiles.items()})
        self.profiles: dict[Archetype, dict[int, float]] = {name: dict(part) for name, part in profiles.items()}
        self.decisive: Mapping[int, float] = MappingProxyType(dict(decisive or {}))
        self.neutral = neutral

    @property
    def best(self) -> Verdict:
        """The emotion of the largest belief (11), or "neutral" where that is believed no less; None where nothing is
        believed at all."""
        name = max(self, key=self.__getitem__)
        if self.neutral is not None and self.neutral >= self[name]:
            return NEUTRAL
        return name if self[name] > 0.0 else None

    @property
    def best_profile(self) -> Profile | None:
        """The profile that decided for the best emotion, in MPEG-4 signs; None where there is none."""
        best = self.best
        if best is None or best == NEUTRAL:
            return None
        variants = self.profiles[best]
        return known_profile(best, max(variants, key=variants.__getitem__))


def recognise(
    frame: ArrayLike,
    *,
    rule: str | Rule = Rule.PAPER,
    confidence: ArrayLike | None = None,
    doubt: ArrayLike | None = None,
) -> Beliefs:
    """Beliefs that a FAP frame shows each archetypal emotion: equations (8) and (9).

    Parameters
    ----------
    frame : (68,) FAPs in FAP units and MPEG-4 signs, index = FAP number - 1; NaN where not observed, which by the
        paper's rule counts as a membership of 1/2. A profile of which less than half is observed has the belief 0.
    rule : "paper" (default) or "robust"; see `Rule`.
    confidence : (68,) how sure each value is, 0..1, for the robust rule; by default all are equally sure.
    doubt : (68, m) FAP units, for the robust rule: how the FAPs would change with the neutral face, were it wrong by
        one standard deviation in each of m independent ways (`Track.doubt`); by default it is right.

    Returns
    -------
    Archetype -> belief; its ``profiles`` gives each variant's belief, its ``neutral`` that in a face at rest (robust
    rule), its ``best`` the decision of equation (11), its ``decisive`` the FAPs that made it.

    Raises
    ------
    ParameterError
        When the frame has another shape or infinite values, there is no such rule, confidence or doubt are not as
        above, or the paper's rule is given them.

    Examples
    --------
    >>> beliefs = api.recognise(api.archetype("surprise").frame())
    >>> print(beliefs.best)
    surprise
    >>> print(api.recognise(np.zeros(68), rule="robust").best)
    neutral
    """
    values, chosen = _checked(frame), Rule.of(rule)
    sure, modes = checked_weights(chosen, confidence, doubt, (FAP_COUNT,))
    return _beliefs(values, None, chosen, sure, modes)


def recognise_words(frame: ArrayLike, words: Iterable[str], *, rule: str | Rule = Rule.ROBUST) -> dict[str, float]:
    """Beliefs that a FAP frame shows each of some emotion words, intermediate ones too, by the profiles of section 4.

    Parameters
    ----------
    frame : as for `recognise`.
    words : emotion words; a neutral one is left out. Profiles of one category are alike but for their strength, so that
        the robust rule takes each at its own.
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
    values, chosen = _checked(frame), Rule.of(rule)
    profiles = {word: expression(word) for word in words}
    classes = {word: FuzzyClass.of(profile) for word, profile in profiles.items() if profile.ranges}
    if not classes:
        return {}
    if chosen is Rule.ROBUST:
        found = RobustRule.of(list(classes.values()), (1.0,)).judge(values[None]).beliefs[0].tolist()
    else:
        found = [_product(fuzzy, values, np.ones(FAP_COUNT, dtype=np.bool_)) for fuzzy in classes.values()]
    return dict(sorted(zip(classes, found, strict=True), key=lambda item: -item[1]))


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
    return _beliefs(faps_from_features(features), _shown_by_features(), Rule.of(rule))


def _checked(frame: ArrayLike) -> Floats:
    """A frame (68,) without infinite values."""
    values = np.asarray(frame, dtype=np.float64)
    if values.shape != (FAP_COUNT,) or (np.abs(values) > FAP_LIMIT).any():
        raise ParameterError(
            "frame", f"must be {FAP_COUNT} numbers within ±{FAP_LIMIT:g} (NaN where unknown)", values.shape
        )
    return values


def checked_weights(
    rule: Rule, confidence: ArrayLike | None, doubt: ArrayLike | None, shape: tuple[int, ...]
) -> tuple[Floats | None, Floats | None]:
    """Confidence of a shape and doubt (68, m), each as it was given or None.

    Raises
    ------
    ParameterError : as `recognise`.
    """
    if rule is Rule.PAPER and (confidence is not None or doubt is not None):
        given = "doubt" if confidence is None else "confidence"
        raise ParameterError(given, 'needs the rule "robust": the paper\'s rule weighs nothing', rule)
    sure = None if confidence is None else np.asarray(confidence, dtype=np.float64)
    if sure is not None and (sure.shape != shape or not ((sure >= 0.0) & (sure <= 1.0)).all()):
        raise ParameterError("confidence", f"must have the shape {shape} of the FAPs, in 0..1", sure.shape)
    modes = None if doubt is None else np.asarray(doubt, dtype=np.float64)
    if modes is not None and (modes.ndim != 2 or len(modes) != FAP_COUNT or not np.isfinite(modes).all()):
        raise ParameterError("doubt", f"must be finite and have the shape ({FAP_COUNT}, m)", modes.shape)
    return sure, modes


def _beliefs(
    values: Floats, visible: Bools | None, rule: Rule, confidence: Floats | None = None, doubt: Floats | None = None
) -> Beliefs:
    """Equations (8) and (9) over the visible FAPs, (68,) each; NaN where a visible FAP was not seen."""
    if rule is Rule.ROBUST:
        return _robust(values, visible, confidence, doubt)
    shown = np.ones(FAP_COUNT, dtype=np.bool_) if visible is None else visible
    classes = archetype_classes()
    beliefs = _by_archetype(classes, [_product(fuzzy, values, shown) for fuzzy in classes.values()])
    against = {key: np.zeros(FAP_COUNT) for key in classes}
    for key, fuzzy in classes.items():
        members = np.maximum(np.nan_to_num(fuzzy.memberships(values), nan=1.0), LEAST_MEMBERSHIP)
        against[key][list(fuzzy.indices)] = -np.log(members)
    return Beliefs(beliefs, _decisive(beliefs, against, shown & ~np.isnan(values)))


def _robust(values: Floats, visible: Bools | None, confidence: Floats | None, doubt: Floats | None) -> Beliefs:
    """Beliefs by the robust rule; `values`, `visible`, `confidence` (68,), `doubt` (68, m)."""
    sure = None if confidence is None else confidence[None]
    judged = archetype_rule().judge(values[None], visible=visible, confidence=sure, doubt=doubt)
    beliefs = _by_archetype(known_classes(), judged.beliefs[0].tolist())
    against = dict(zip(known_classes(), judged.against[0] * np.log(2.0), strict=True))
    rest = float(judged.neutral[0])
    return Beliefs(beliefs, _decisive(beliefs, against, ~np.isnan(values)), None if np.isnan(rest) else rest)


def _by_archetype(
    classes: Iterable[tuple[Archetype, int]], found: Iterable[float]
) -> dict[Archetype, dict[int, float]]:
    """Beliefs in profiles by emotion and variant."""
    beliefs: dict[Archetype, dict[int, float]] = {name: {} for name in ARCHETYPES}
    for (name, variant), belief in zip(classes, found, strict=True):
        beliefs[name][variant] = belief
    return beliefs


def _product(fuzzy: FuzzyClass, values: Floats, visible: Bools) -> float:
    """Belief in one profile by the paper's rule."""
    judged = visible[list(fuzzy.indices)]
    memberships = fuzzy.memberships(values)[judged]
    seen = ~np.isnan(memberships)
    if not judged.any() or seen.sum() < LEAST_SEEN * judged.sum():
        return 0.0
    return float(np.where(seen, memberships, UNSEEN_MEMBERSHIP).prod())


def _decisive(
    beliefs: Mapping[Archetype, Mapping[int, float]], against: Mapping[tuple[Archetype, int], Floats], counted: Bools
) -> dict[int, float]:
    """How much each FAP speaks for the best profile against the best one of the runner-up.

    `against`: (68,) logarithms that each FAP takes off a profile. `counted`: (68,) FAPs that were seen.
    """
    best_of = {name: max(part, key=part.__getitem__) for name, part in beliefs.items()}
    first, second, *_ = sorted(beliefs, key=lambda name: -beliefs[name][best_of[name]])
    speaks = np.where(counted, against[second, best_of[second]] - against[first, best_of[first]], 0.0)
    return {int(index) + 1: float(speaks[index]) for index in np.argsort(-np.abs(speaks)) if speaks[index] != 0.0}


def _shown_by_features() -> Bools:
    """(68,) the FAPs that some feature shows."""
    return ~np.isnan(faps_from_features(np.zeros(FEATURE_COUNT)))
