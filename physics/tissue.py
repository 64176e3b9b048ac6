"""Tissue: the figures of skin in SI units, read from presets/tissue.toml."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cache
from pathlib import Path
from types import MappingProxyType

import numpy as np

from ..errors import ParameterError
from ..resources import PRESETS
from ..tables import TomlTable, read_toml

PRESET = PRESETS / "tissue.toml"
"""The tissues that come with Risorius."""

_MAY_BE_ZERO = ("bending_length", "damping_ratio", "loose_damping_ratio", "jaw_damping_ratio")

STIFFNESS_OF_MODULUS = 1.5
"""w / (E h): a sheet of the springs of `springs.py` has the plane Young's modulus times thickness 2 w / 3."""


@dataclass(frozen=True, kw_only=True)
class Tissue:
    """The figures of one kind of skin; sources and meaning of each stand in presets/tissue.toml.

    Parameters
    ----------
    youngs_modulus : Pa, of the sheet at low strain.
    thickness : m, of the sheet.
    depth : m, of the soft tissue that moves with it.
    density : kg/m^3, of that tissue.
    stiffening : k_h / k_l, >= 1.
    threshold : strain at which springs stiffen, > 0.
    bending_length : m, >= 0; 0 leaves a bare membrane, the paper's skin. A face in motion needs 0.003 or more.
    anchor_length : m, > 0.
    damping_ratio : relative to critical damping on the bed, >= 0.
    loose_depth : m, of the soft tissue that moves where it hangs loose: cheek and jowl.
    loose_damping_ratio : as `damping_ratio`, where it hangs loose, >= 0.
    jaw_frequency : Hz, of the mandible in its muscles and ligaments, undamped.
    jaw_damping_ratio : of the mandible, relative to critical damping, >= 0.
    description : one line for a menu.

    Raises
    ------
    ParameterError : a figure outside its rule.
    """

    youngs_modulus: float
    thickness: float
    depth: float
    density: float
    stiffening: float
    threshold: float
    bending_length: float
    anchor_length: float
    damping_ratio: float
    loose_depth: float
    loose_damping_ratio: float
    jaw_frequency: float
    jaw_damping_ratio: float
    description: str = ""

    def __post_init__(self) -> None:
        for name in _figures():
            value = getattr(self, name)
            if isinstance(value, bool) or not isinstance(value, int | float) or not np.isfinite(value):
                raise ParameterError(name, "must be a finite number", value)
            if value < 0 or (value == 0 and name not in _MAY_BE_ZERO):
                raise ParameterError(name, "must be above 0", value)
        if self.stiffening < 1:
            raise ParameterError("stiffening", "must be 1 or more (k_h at least k_l)", self.stiffening)

    @property
    def membrane(self) -> float:
        """Membrane stiffness w of the springs at low strain, N/m."""
        return STIFFNESS_OF_MODULUS * self.youngs_modulus * self.thickness

    @property
    def mass_per_area(self) -> float:
        """kg/m^2."""
        return self.density * self.depth

    @property
    def anchor_per_area(self) -> float:
        """Stiffness of the bed, N/m per m^2."""
        return self.membrane / self.anchor_length**2

    @property
    def damping_rate(self) -> float:
        """c / m of equation (23), 1/s: alike at every node, whatever the mesh."""
        return float(2 * self.damping_ratio * np.sqrt(self.anchor_per_area / self.mass_per_area))


def load_tissues(path: str | Path = PRESET) -> Mapping[str, Tissue]:
    """Read tissues by name from a TOML file: [figures.NAME] with unit and source, [tissues.NAME] with every figure.

    Parameters
    ----------
    path : the file; its [figures] may be left out in a user's own.

    Returns
    -------
    Read-only mapping of name to tissue, in the file's order.

    Raises
    ------
    FormatError : unreadable file, unknown, missing or wrong key; names file, key and rule.
    """
    document = read_toml(path)
    document.table("figures", optional=True).only(*_figures())
    for figure in document.tables("figures", optional=True).values():
        figure.text("unit")
        figure.text("source")
    return MappingProxyType({name: _tissue(row) for name, row in document.tables("tissues").items()})


@cache
def tissues() -> Mapping[str, Tissue]:
    """The tissues that come with Risorius, by name; read once."""
    return load_tissues()


def tissue(name: str = "default") -> Tissue:
    """The bundled tissue of that name; ParameterError lists the names."""
    if name not in tissues():
        raise ParameterError("tissue", f"must be one of {', '.join(tissues())}", name)
    return tissues()[name]


def as_tissue(given: str | Tissue) -> Tissue:
    """A tissue, or the bundled one of that name; ParameterError lists the names."""
    return given if isinstance(given, Tissue) else tissue(given)


@cache
def _figures() -> tuple[str, ...]:
    """Names of the numeric fields."""
    return tuple(field.name for field in fields(Tissue) if field.name != "description")


def _tissue(row: TomlTable) -> Tissue:
    """One tissue."""
    row.only(*_figures(), "description")
    figures = {name: row.number(name) for name in _figures()}
    return row.made(lambda: Tissue(**figures, description=row.text("description", "")))
