"""What can be contracted by hand: names and titles of all muscles, lids and the jaw, without a face."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType

from .mechanisms.lid_movers import LID_MOVERS
from .muscles.table import read_muscles


@dataclass(frozen=True)
class Contractible:
    """A muscle of one side, or the jaw.

    Attributes
    ----------
    name : as in `Pose.contractions` ("zygomaticus_major_l").
    title : for people, without the side. action_unit : of FACS, or "".
    mirror : the name of the same muscle on the other side, or its own.
    group : the part of the face ("lips").
    """

    name: str
    title: str
    action_unit: str
    mirror: str
    group: str


@cache
def contractibles() -> Mapping[str, Contractible]:
    """All of them by name, in the order of the table: forehead first.

    Examples
    --------
    >>> muscle = api.contractibles()["zygomaticus_major_l"]
    >>> muscle.mirror
    'zygomaticus_major_r'
    """
    rows = [(name, row.title, row.au, str(row.mechanism)) for name, row in read_muscles().items()]
    rows += [(mover.name, mover.title, mover.au, "lids") for mover in LID_MOVERS.values()]
    found = [
        Contractible(f"{name}_{side}", title, unit, f"{name}_{'r' if side == 'l' else 'l'}", group)
        for name, title, unit, group in rows
        for side in "lr"
    ]
    found.append(Contractible("jaw_open", "jaw, opening", "26", "jaw_open", "jaw"))
    return MappingProxyType({entry.name: entry for entry in found})
