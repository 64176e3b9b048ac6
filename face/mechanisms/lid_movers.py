"""The muscles of the lids: what they are called, and how far they go. What skin they turn is told in `lids`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from ...tables import read_toml
from ..figures import ANATOMY
from ..mesh.template import MM


class LidMove(StrEnum):
    """The four movements of a pair of lids; each is a muscle of its own and only pulls one way."""

    UPPER_CLOSE = "upper_close"
    UPPER_OPEN = "upper_open"
    LOWER_UP = "lower_up"
    LOWER_DOWN = "lower_down"


@dataclass(frozen=True)
class LidMover:
    """The muscle of one movement: name, title and action unit for people; usual and largest way of the lid, metres."""

    name: str
    title: str
    au: str
    prior: float
    amplitude: float


def _read_movers() -> Mapping[LidMove, LidMover]:
    """The muscles of presets/anatomy/lids.toml by what they do."""
    table = read_toml(ANATOMY / "lids.toml").table("movers")
    table.text("source")
    table.only("source", *LidMove)
    movers = {}
    for move in LidMove:
        row = table.table(move)
        row.only("name", "title", "au", "prior_mm", "amplitude_mm")
        prior, amplitude = (MM * row.number(key, above=0.0) for key in ("prior_mm", "amplitude_mm"))
        movers[move] = LidMover(row.text("name"), row.text("title"), row.text("au", ""), prior, amplitude)
    return MappingProxyType(movers)


LID_MOVERS = _read_movers()
