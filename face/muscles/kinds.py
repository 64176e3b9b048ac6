"""The kinds of muscle: a new one is a file of its own and a line here."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from .arch import ArchRow
from .band import BandRow
from .linear import LinearRow
from .pressure import PressureRow
from .row import MuscleRow
from .sheet import SheetRow
from .sphincter import SphincterRow, SphincterSkinRow
from .window import WindowRow

_ALL: tuple[type[MuscleRow], ...] = (
    LinearRow,
    SheetRow,
    SphincterRow,
    SphincterSkinRow,
    WindowRow,
    BandRow,
    ArchRow,
    PressureRow,
)

KINDS: Mapping[str, type[MuscleRow]] = MappingProxyType({kind.kind: kind for kind in _ALL})
"""By the name that a row of the table says under `kind`."""
