"""The 15 features of Table 3 (Raouzaiou et al. 2002, section 3.1), as definitions, and what they say of FAPs.

A feature is the change of the Euclidean distance of two feature points from the neutral face, in FAP units; the
measuring is the face's business. Points and signs stay as printed. One sign needs care: f4 is printed as
D4_neutral - D4, so it is positive when the lower lip rises, as F5 is in MPEG-4; the figures of Table 4 have the
opposite sign. The features are turned into MPEG-4 signs here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Floats
from ...errors import ParameterError
from ...resources import STANDARD
from ...tables import read_csv
from ..standard import FAP_COUNT, FAP_LIMIT, Unit

FEATURE_COUNT = 15


@dataclass(frozen=True)
class Feature:
    """One feature of Table 3.

    Attributes
    ----------
    number : 1..15.
    point_a, point_b : feature points whose distance D is measured.
    sign : +1 where f = D - D_neutral, -1 where f = D_neutral - D.
    unit : the FAP unit f is given in.
    shares : FAP number -> factor on f that gives the FAP in MPEG-4 signs.
    """

    number: int
    point_a: str
    point_b: str
    sign: int
    unit: Unit
    shares: Mapping[int, float]

    def value(self, distance: float, neutral_distance: float, unit_length: float) -> float:
        """The feature from two distances and the length of one FAP unit (FAPU / 1024), all in the same length unit."""
        return self.sign * (distance - neutral_distance) / unit_length


def _read_features() -> tuple[Feature, ...]:
    """features.csv in order."""
    features = []
    for row in read_csv(STANDARD / "features.csv"):
        pairs = (part.split(":") for part in row.texts("faps"))
        features.append(
            Feature(
                number=row.integer("feature"),
                point_a=row.text("point_a"),
                point_b=row.text("point_b"),
                sign=1 if row.choice("positive_when", ("grows", "shrinks")) == "grows" else -1,
                unit=row.choice("unit", Unit),
                shares=MappingProxyType({int(number): float(share) for number, share in pairs}),
            )
        )
    return tuple(features)


FEATURES: tuple[Feature, ...] = _read_features()
"""The 15 features in order."""


def faps_from_features(features: ArrayLike) -> Floats:
    """The FAPs that 15 features show.

    Parameters
    ----------
    features : (15,) features of Table 3 as printed, in FAP units; NaN where one could not be measured.

    Returns
    -------
    (68,) float64, FAP units in MPEG-4 signs; NaN for FAPs no feature shows. Lids and mouth corners, which share a
    feature, take half of it each; the brow squeezes, measured by two features each, take the mean of both.

    Raises
    ------
    ParameterError
        When there are not 15 finite-or-NaN numbers.
    """
    values = np.asarray(features, dtype=np.float64)
    if values.shape != (FEATURE_COUNT,) or (np.abs(values) > FAP_LIMIT).any():
        raise ParameterError(
            "features", f"must be {FEATURE_COUNT} numbers within ±{FAP_LIMIT:g} (NaN where unknown)", values.shape
        )
    total, count = np.zeros(FAP_COUNT), np.zeros(FAP_COUNT)
    for feature, value in zip(FEATURES, values, strict=True):
        for number, share in feature.shares.items():
            if not np.isnan(value):
                total[number - 1] += share * value
                count[number - 1] += 1.0
    return np.where(count > 0.0, total / np.maximum(count, 1.0), np.nan)
