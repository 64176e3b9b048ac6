"""Table 1 of Raouzaiou et al. 2002: which FAPs go with which action units (AU) of the facial action coding system.

The table names FAPs without directions: AU 4 lowers the brows that its FAPs raise, AU 5 opens the lids they close.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from ...resources import STANDARD
from ...tables import read_csv


@dataclass(frozen=True)
class AuTerm:
    """One FAP of an action unit.

    Attributes
    ----------
    printed : the name in the table, typing errors included.
    fap : the FAP's number; None where no FAP has the printed name.
    optional : True where the table prints it in parentheses.
    """

    printed: str
    fap: int | None
    optional: bool


def _read_action_units() -> dict[int, tuple[AuTerm, ...]]:
    """action_units.csv by AU."""
    units: dict[int, list[AuTerm]] = {}
    for row in read_csv(STANDARD / "action_units.csv"):
        terms = units.setdefault(row.integer("au"), [])
        if "printed" in row:
            fap, optional = row.integer("fap") if "fap" in row else None, row.choice("optional", ("yes", "no"))
            terms.append(AuTerm(row.text("printed"), fap, optional == "yes"))
    return {number: tuple(terms) for number, terms in units.items()}


ACTION_UNITS: Mapping[int, tuple[AuTerm, ...]] = MappingProxyType(_read_action_units())
"""AU 1..20 -> its FAPs; empty where the table leaves the cell empty."""
