"""Contractions that somebody sets by hand, over the amounts that explain a plan."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ...errors import ParameterError
from ..mechanism import Mechanism
from ..mechanisms.jaw import JawMotion
from ..mechanisms.lid_movers import LID_MOVERS
from ..response.actuators import OPENING, Actuators, Amounts
from .request import ByHand


def set_by_hand(actuators: Actuators, amounts: Amounts, hands: Iterable[ByHand]) -> Amounts:
    """Amounts some of whose contractions have come a share of the way to those set by hand, one set after the other.

    Raises
    ------
    ParameterError : an unknown muscle, or a contraction outside 0..1.
    """
    for hand in hands:
        for name, value in hand.contractions.items():
            if not 0.0 <= value <= 1.0:
                raise ParameterError(f"contraction of {name}", "must be in 0..1", value)
        now, rest = actuators.contractions(amounts), 1.0 - hand.share
        mixed = {name: rest * now.get(name, 0.0) + hand.share * value for name, value in hand.contractions.items()}
        amounts = _with(actuators, amounts, mixed)
    return amounts


def _with(actuators: Actuators, amounts: Amounts, contractions: Mapping[str, float]) -> Amounts:
    """Amounts with some contractions instead of their own."""
    muscles, lids, jaw = amounts.muscles.copy(), dict(amounts.lids), amounts.jaw
    index = {muscle.name: i for i, muscle in enumerate(actuators.muscles)}
    lid_index = {f"{LID_MOVERS[move].name}_{side}": (side, move) for side, move in actuators.lid_moves}
    hinge = ["jaw_open"] if actuators.skin.has(Mechanism.JAW) else []
    for name, value in contractions.items():
        if name in index:
            muscles[index[name]] = value * actuators.muscles[index[name]].amplitude
        elif name in lid_index:
            lids[lid_index[name]] = value * LID_MOVERS[lid_index[name][1]].amplitude
        elif name in hinge:
            jaw = JawMotion(value * float(actuators.upper[OPENING]) / actuators.chin_lever, jaw.left, jaw.forward)
        else:
            known = ", ".join(sorted([*index, *lid_index, *hinge]))
            raise ParameterError("muscle", f"must be one of {known}", name)
    return Amounts(muscles, lids, jaw)
