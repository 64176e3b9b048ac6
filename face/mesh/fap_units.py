"""The five FAP units of length of one neutral face, measured as the standard's table says (`mpeg4.FAPU`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...errors import ModelError, ParameterError
from ...mpeg4 import FAPU, Unit
from .template import TEMPLATE_POINTS

#: Row of the head's axes (left, up, forward) that each direction of the table is along.
_AXES = {"lateral": 0, "vertical": 1}


@dataclass(frozen=True)
class Fapu:
    """The five FAP units of length of one neutral face, in metres of its own coordinates.

    Differences per head axis, not Euclidean distances; source: mpeg4/data/fapu.csv.
    """

    irisd0: float
    es0: float
    ens0: float
    mns0: float
    mw0: float

    def __post_init__(self) -> None:
        for definition in FAPU.values():
            if definition.pairs and not getattr(self, definition.symbol.lower()) > 0.0:
                value = getattr(self, definition.symbol.lower())
                pairs = ", ".join(" and ".join(pair) for pair in definition.pairs)
                raise ModelError(
                    f"FAP unit {definition.symbol}, {definition.name}, is {value * 1000:.2f} mm but must be positive: "
                    f"check the feature points {pairs}"
                )


def fapu(points: Mapping[str, Floats], axes: Floats) -> Fapu:
    """The FAP units of a neutral face in its own units of length.

    Parameters
    ----------
    points : name -> (3,) position in the face's coordinates; all that the table names.
    axes : (3, 3) rows left, up and forward in the face's coordinates.

    Raises
    ------
    ModelError : a unit that is not positive; names the points that are wrong.
    """
    place = {name: axes @ np.asarray(position, dtype=np.float64) for name, position in points.items()}
    lengths = {}
    for definition in FAPU.values():
        if definition.axis is not None:
            along = _AXES[definition.axis]
            gaps = [place[a][along] - place[b][along] for a, b in definition.pairs]
            lengths[definition.symbol.lower()] = float(np.mean(gaps))
    return Fapu(**lengths)


def unit_length(unit: Unit | None, units: Fapu) -> float:
    """One FAP unit of length (a FAPU over its divisor) in metres of the face.

    Raises
    ------
    ParameterError : a unit that is no length.
    """
    definition = FAPU.get(unit) if unit is not None else None
    if definition is None or definition.divisor is None:
        known = ", ".join(unit for unit, definition in FAPU.items() if definition.divisor is not None)
        raise ParameterError("unit", f"must be one of the lengths {known}", unit)
    length: float = getattr(units, definition.symbol.lower())
    return length / definition.divisor


#: The units of the template face, metres.
TEMPLATE_FAPU = fapu(TEMPLATE_POINTS, np.eye(3))
