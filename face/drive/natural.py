"""The natural mode: what a face does when it is asked for a few FAPs.

A profile names few FAPs, some beyond anatomy, some against one another, and is silent about the rest. Requests are
weighed against each FAP's range and against one another; what the profile does not say comes from a sparse,
non-negative mixture of action units that explains what it does say, with the emotion word's own mixture preferred.
Figures and reasons: docs/muscles.md; all in millimetres on the template face.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ...arrays import Bools, Floats
from ...mpeg4 import FAP_COUNT, Archetype, recognise
from .bounded_least_squares import bounded_least_squares
from .synergies import Synergies, load_synergies, mirror_fap, mirror_frame

#: Archetype -> share of an expression, 0..1; an `Archetype` is its own name (a StrEnum).
EmotionShares: TypeAlias = Mapping[Archetype, float] | Mapping[str, float]

#: A difference of left and right below these is no wish: units, and share of the larger.
SYMMETRY_UNITS, SYMMETRY_SHARE = 12.0, 0.12

#: Left and right corner of the mouth, drawn outwards: inner lip, outer lip.
CORNERS = ((6, 7), (53, 54))

#: The unit that is the mandible opening.
JAW, JAW_FAP = "AU27", 3

LID_FAPS = (19, 20, 21, 22)
BROW_CHEEK_FAPS = (*range(31, 43), 61, 62, 63, 64)
PSI_MOUTH, PSI_BROW, PSI_LID = 1.0, 0.8, 0.4

SUM_SPREAD = 1.5
SIDE_CORRELATION = 0.95
OWN_SPREAD = 0.17
OWN_GAIN = 1.15
OWN_LIMIT = 1.3
SILENCE_MM = 3.0

#: A belief of the recogniser that counts as half a certainty that the face shows that emotion.
SIGHT_DOUBT = 0.15

#: How much more the likelier of two emotions counts: the power that beliefs are taken to.
SHARPNESS = 4
L1_UNIT, L1_UNIT_MIDLINE, L1_SUM, L1_OTHER_SUM = 1.0, 2.0, 2.0, 6.0

#: The sums that are emotions; the others are habits of any face.
EMOTIONS = ("joy", "sadness", "anger", "fear", "disgust", "surprise")


@dataclass(frozen=True)
class Plan:
    """What a face should do for one frame.

    Attributes
    ----------
    goal : (68,) FAP units; NaN where nothing is known of the FAP.
    asked : (68,) the request after symmetry, FAP units; NaN where silent.
    limited : (68,) the request after the anatomical range, FAP units; NaN where silent.
    muscles : muscle name (with side) -> prior amount in metres, for what no FAP sees.
    units : half unit name -> amount, why the silent FAPs are what they are.
    """

    goal: Floats
    asked: Floats
    limited: Floats
    muscles: Mapping[str, float]
    units: Mapping[str, float]

    def reason(self, number: int) -> str:
        """In words, why a FAP's goal is what it is."""
        goal, asked, limited = (float(a[number - 1]) for a in (self.goal, self.asked, self.limited))
        if np.isnan(goal):
            return "not planned"
        if np.isnan(asked):
            return "not in the profile; it follows from the action units that explain the request"
        if abs(limited - asked) > 0.02 * abs(asked) + 1.0:
            return "limited by its anatomical range"
        if abs(goal - limited) > 0.1 * abs(limited) + 5.0:
            return "balanced against other requests"
        return "as asked"


def blend(plans: Sequence[Plan], weights: Sequence[float]) -> Plan:
    """One plan from several that are shown at once, each in 0..1 of its strength; together never above 1.

    A FAP is asked where any plan that is shown at all asks for it.
    """
    total = max(float(sum(weights)), 1.0)
    shown = [(plan, weight / total) for plan, weight in zip(plans, weights, strict=True) if weight > 0.0]

    def mix(name: str) -> Floats:
        values = np.stack([getattr(plan, name) for plan, _ in shown])
        shares = np.array([share for _, share in shown])
        known = ~np.isnan(values)
        return np.where(known.any(axis=0), shares @ np.where(known, values, 0.0), np.nan)

    if not shown:
        silent = np.full(FAP_COUNT, np.nan)
        rest = np.where(np.isnan(plans[0].goal), np.nan, 0.0)
        return Plan(rest, silent, silent, {}, {})
    muscles: dict[str, float] = {}
    units: dict[str, float] = {}
    for plan, share in shown:
        for source, target in ((plan.muscles, muscles), (plan.units, units)):
            for key, value in source.items():
                target[key] = target.get(key, 0.0) + share * value
    return Plan(mix("goal"), mix("asked"), mix("limited"), muscles, units)


def symmetric(frame: Floats) -> tuple[Floats, bool]:
    """A frame (68,) without small differences of left and right, missing sides filled; and if it is asymmetric."""
    result = frame.copy()
    asymmetric = False
    for number in range(3, FAP_COUNT + 1):
        other = mirror_fap(number)
        if other <= number:
            continue
        a, b = frame[number - 1], frame[other - 1]
        if np.isnan(a) and np.isnan(b):
            continue
        if np.isnan(a) or np.isnan(b):
            result[[number - 1, other - 1]] = a if np.isnan(b) else b
        elif abs(a - b) <= max(SYMMETRY_UNITS, SYMMETRY_SHARE * max(abs(a), abs(b))):
            result[[number - 1, other - 1]] = (a + b) / 2.0
        else:
            asymmetric = True
    return result, asymmetric


def saturate(value: Floats, low: Floats, high: Floats, low_linear: Floats, high_linear: Floats) -> Floats:
    """Values softly held within ranges: unchanged up to a share of the range, then approaching it exponentially."""
    limit = np.where(value < 0, -low, high)
    size = np.abs(value)
    knee = np.where(value < 0, low_linear, high_linear) * limit
    rest = limit - knee
    beyond = knee + rest * (1.0 - np.exp(-np.maximum(size - knee, 0.0) / rest))
    held: Floats = np.sign(value) * np.where(size <= knee, size, beyond)
    return held


@dataclass(frozen=True)
class Known:
    """Which emotions a request shows, and how certain that is.

    Attributes
    ----------
    shares : archetype -> share, summing to 1 (or empty). certainty : 0..1; 1 where the word was given.
    """

    shares: Mapping[str, float]
    certainty: float

    @classmethod
    def of_word(cls, emotion: EmotionShares) -> Known:
        """A given word's shares."""
        shares = {str(name): float(share) for name, share in emotion.items() if share > 0.0}
        return cls(shares, 1.0 if shares else 0.0)

    @classmethod
    def by_sight(cls, request: Floats) -> Known:
        """What the paper's recogniser (section 5) makes of a request (68,) whose word is not known.

        Some of the paper's profiles differ a little from left to right. A face and its mirror image show the same
        emotion, so both are looked at.
        """
        seen, mirrored = recognise(request), recognise(mirror_frame(request))
        evidence = {
            str(name): (float(belief) ** SHARPNESS + float(mirrored[name]) ** SHARPNESS) / 2.0
            for name, belief in seen.items()
        }
        total = sum(evidence.values())
        if total <= 0.0:
            return cls({}, 0.0)
        shares = {name: value / total for name, value in evidence.items() if value > 0.01 * total}
        return cls(shares, total / (total + SIGHT_DOUBT**SHARPNESS))


class Natural:
    """Plans for frames of FAPs; the same for every face."""

    def __init__(self, synergies: Synergies | None = None) -> None:
        self.data = load_synergies() if synergies is None else synergies
        numbers = self.data.numbers
        self._psi = np.where(
            np.isin(numbers, LID_FAPS), PSI_LID, np.where(np.isin(numbers, BROW_CHEEK_FAPS), PSI_BROW, PSI_MOUTH)
        )
        self._row = self.data.position

    def plan(self, frame: Floats, emotion: EmotionShares | None = None) -> Plan:
        """The plan for a frame.

        Parameters
        ----------
        frame : (68,) FAP units, NaN where silent.
        emotion : archetype -> share of the expression, where its word is known; else the request is recognised.
        """
        data = self.data
        request, asymmetric = symmetric(frame)
        y = request[data.numbers - 1] * data.per_fap
        asked = ~np.isnan(y)
        carried = self._jaw_carries(np.nan_to_num(y))
        limited = np.where(asked, self._held(np.nan_to_num(y), carried), np.nan)
        noise = self._conflicts(np.nan_to_num(y), limited, asked)
        self._spare_smiling_eyes(limited, asked)
        known = Known.of_word(emotion) if emotion else Known.by_sight(request)
        amounts = self._mixture(limited, asked, noise, known, asymmetric)
        explained = data.units @ amounts
        trust = self._psi**2 / (self._psi**2 + noise**2)
        goal = np.where(asked, explained + trust * (np.nan_to_num(limited) - explained), explained)
        least, most = (np.fmin(np.fmin(data.low, carried), limited), np.fmax(np.fmax(data.high, carried), limited))
        goal = np.clip(goal, least, most)
        return Plan(
            goal=self._frame(goal),
            asked=request,
            limited=self._frame(limited),
            muscles=self._hidden(amounts),
            units={n: float(a) for n, a in zip(data.unit_names, amounts, strict=True) if a > 0.01},
        )

    def _frame(self, values: Floats) -> Floats:
        """(68,) frame in FAP units from rows in mm."""
        frame = np.full(FAP_COUNT, np.nan)
        frame[self.data.numbers - 1] = values / self.data.per_fap
        return frame

    def _jaw_carries(self, y: Floats) -> Floats:
        """(m,) mm by which the asked opening of the jaw moves every FAP's point, itself left out."""
        data, row = self.data, self._row[JAW_FAP]
        limits = (data.low, data.high, data.low_linear, data.high_linear)
        jaw = data.units[:, data.unit_names.index(JAW)]
        carried = jaw * max(float(saturate(y, *limits)[row]) / float(jaw[row]), 0.0)
        carried[row] = 0.0
        return np.asarray(carried)

    def _held(self, y: Floats, carried: Floats) -> Floats:
        """(m,) requests in mm (0 = none) softly held within the anatomical ranges.

        Ranges are of what each part does by itself: what the jaw carries along, and what both corners of a mouth that
        is drawn to one side have in common, is not held back.
        """
        data = self.data
        free = np.where(y * carried > 0.0, np.sign(y) * np.minimum(np.abs(y), np.abs(carried)), 0.0)
        for pair in CORNERS:
            left, right = (self._row[number] for number in pair)
            one, other = y[left] - free[left], y[right] - free[right]
            if one * other < 0.0:
                aside = np.sign(one) * min(abs(one), abs(other))
                free[left] += aside
                free[right] -= aside
        return free + saturate(y - free, data.low, data.high, data.low_linear, data.high_linear)

    def _conflicts(self, asked_mm: Floats, limited: Floats, asked: Bools) -> Floats:
        """(m,) doubt in mm about each request: what lies beyond the range, and lips against an open jaw."""
        noise = 0.5 * self._psi + 0.25 * np.abs(asked_mm - np.nan_to_num(limited))
        row = self._row
        jaw = max(float(np.nan_to_num(limited[row[JAW_FAP]])), 0.0)
        noise[[row[n] for n in (5, 10, 11, 52, 57, 58)]] += 0.35 * jaw
        noise[row[JAW_FAP]] += 0.08 * jaw
        for number in (6, 7, 53, 54):
            if asked_mm[row[number]] < 0:
                noise[row[number]] += 0.12 * jaw
        return np.where(asked, noise, 0.0)

    def _spare_smiling_eyes(self, limited: Floats, asked: Bools) -> None:
        """A smile narrows the eye: requests to open the upper lids fade with it, in place."""
        row = self._row
        corners = [limited[row[n]] for n in (12, 13, 59, 60) if asked[row[n]]]
        smile = float(np.clip(max(corners, default=0.0) / 6.0, 0.0, 1.0))
        for number in (19, 20):
            if asked[row[number]] and limited[row[number]] < 0:
                limited[row[number]] *= 1.0 - 0.9 * smile

    def _own_strengths(self, y: Floats, asked: Bools, weight: Floats, known: Known) -> dict[str, float]:
        """Emotion -> strength at which its sum explains the request best."""
        data = self.data
        strengths = {}
        for emotion, share in known.shares.items():
            both = [data.sum_names.index(emotion + half) for half in ("_l", "_r")]
            prediction = data.units @ data.sums[:, both].sum(axis=1)
            p, t = prediction[asked] * weight[asked], np.nan_to_num(y)[asked] * weight[asked]
            fit = OWN_GAIN * float(p @ t) / max(float(p @ p), 1e-9)
            strengths[emotion] = share * float(np.clip(fit, 0.0, OWN_LIMIT))
        return strengths

    def _mixture(self, y: Floats, asked: Bools, noise: Floats, known: Known, asymmetric: bool) -> Floats:
        """Amounts (k,) of the half units that explain the request."""
        data = self.data
        unit_count, sum_count = data.units.shape[1], data.sums.shape[1]
        weight = 1.0 / np.sqrt(self._psi**2 + noise**2)
        own = self._own_strengths(y, asked, weight, known)
        through = np.column_stack([data.units, data.units @ data.sums])
        rows = [through[asked] * weight[asked, None]]
        right = [np.nan_to_num(y)[asked] * weight[asked]]
        spread, mean, l1 = self._priors(own, known.certainty)
        self._limit_jaw(spread, asked)
        whiten = self._prior_factor(spread, asymmetric)
        rows.append(whiten)
        right.append(whiten @ mean)
        for column, name in enumerate(data.sum_names):
            doubt = 1.0 - known.certainty if name[:-2] in own else 1.0
            silent = np.zeros((int((~asked).sum()), unit_count + sum_count))
            silent[:, unit_count + column] = doubt * through[~asked, unit_count + column] / SILENCE_MM
            rows.append(silent)
            right.append(np.zeros(len(silent)))
        matrix, target = np.concatenate(rows), np.concatenate(right)
        factor: Floats = np.asarray(np.linalg.cholesky(matrix.T @ matrix).T, dtype=np.float64)
        linear = matrix.T @ target - l1 / 2.0
        shifted: Floats = np.asarray(np.linalg.solve(factor.T, linear), dtype=np.float64)
        zero = np.zeros(unit_count + sum_count)
        solution = bounded_least_squares(factor, shifted, zero, zero + 10.0)
        return np.asarray(solution[:unit_count] + data.sums @ solution[unit_count:])

    def _priors(self, own: Mapping[str, float], certainty: float) -> tuple[Floats, Floats, Floats]:
        """Spread, mean and L1 weight of every unit and sum."""
        data = self.data
        spread = np.concatenate([data.unit_spread, np.full(len(data.sum_names), SUM_SPREAD)])
        mean = np.zeros(len(spread))
        paired = np.array([name.endswith(("_l", "_r")) for name in data.unit_names])
        rival = L1_SUM + certainty * (L1_OTHER_SUM - L1_SUM)
        other = [rival if name[:-2] in EMOTIONS else L1_SUM for name in data.sum_names]
        l1 = np.concatenate([np.where(paired, L1_UNIT, L1_UNIT_MIDLINE), other])
        for column, name in enumerate(data.sum_names, start=len(data.unit_names)):
            if name[:-2] in own:
                spread[column] = SUM_SPREAD * (OWN_SPREAD / SUM_SPREAD) ** certainty
                mean[column], l1[column] = certainty * own[name[:-2]], (1.0 - certainty) * L1_SUM
        return spread, mean, l1

    def _limit_jaw(self, spread: Floats, asked: Bools) -> None:
        """A jaw that nobody asks to open does not open to explain a lowered lip, in place."""
        if not asked[self._row[JAW_FAP]]:
            spread[self.data.unit_names.index(JAW)] = 0.05

    def _prior_factor(self, spread: Floats, asymmetric: bool) -> Floats:
        """Square root of the prior's inverse covariance: halves of a pair go together unless asked otherwise."""
        names = (*self.data.unit_names, *self.data.sum_names)
        correlation = 0.0 if asymmetric else SIDE_CORRELATION
        covariance = np.diag(spread**2)
        for i, name in enumerate(names):
            if name.endswith("_l"):
                j = names.index(name[:-2] + "_r")
                covariance[i, j] = covariance[j, i] = correlation * spread[i] * spread[j]
        inverse = np.linalg.inv(covariance)
        root: Floats = np.linalg.cholesky(inverse).T
        return root

    def _hidden(self, amounts: Floats) -> dict[str, float]:
        """Muscle name -> prior amount in metres for what no FAP sees."""
        wanted: dict[str, float] = {}
        for name, amount in zip(self.data.unit_names, amounts, strict=True):
            unit, _, side = name.partition("_")
            for muscle, per_unit in self.data.hidden.get(unit, {}).items():
                key = f"{muscle}_{side}"
                wanted[key] = wanted.get(key, 0.0) + per_unit * float(amount)
        return wanted
