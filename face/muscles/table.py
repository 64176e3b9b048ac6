"""The table of muscles: presets/anatomy/muscles/, a file per group, as frozen rows, checked once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np

from ...arrays import Floats
from ...errors import FormatError
from ..mechanism import MUSCLE_GROUPS, Mechanism
from ..mesh.fap_units import TEMPLATE_FAPU
from ..mesh.template import ANATOMY, MM, TEMPLATE_POINTS
from ..tables import read_toml

#: Offsets in the table are given in these units of the template: ES0, ENS0, ENS0 (metres).
OFFSET_UNITS: Floats = np.array([TEMPLATE_FAPU.es0, TEMPLATE_FAPU.ens0, TEMPLATE_FAPU.ens0])


class Kind(StrEnum):
    """How a muscle pulls; the first three are the paper's classes."""

    LINEAR = "linear"
    SHEET = "sheet"
    SPHINCTER = "sphincter"
    SPHINCTER_SKIN = "sphincter_skin"
    WINDOW = "window"
    BAND = "band"
    ARCH = "arch"
    PRESSURE = "pressure"


#: The classes of Zhang, Sung, Prakash 2001.
PAPER_KINDS = (Kind.LINEAR, Kind.SHEET, Kind.SPHINCTER)


class Sides(StrEnum):
    """Whether a muscle is one of a pair, or one muscle whose halves contract on their own."""

    PAIR = "pair"
    HALVES = "halves"


class Region(StrEnum):
    """The skin that a muscle inserts in."""

    ALL = "all"
    BROW = "brow"
    CHEEK = "cheek"
    CHEEK_POUCH = "cheek2"
    UPPER = "upper"
    LOWER = "lower"
    NOSE = "nose"


@dataclass(frozen=True)
class MuscleRow:
    """One row: left side, template head space, metres and radians; `mechanism` is the group that it belongs to.

    `attachment` and `insertion` are (3,) for a linear muscle and (2, 3) for a sheet; the other kinds have a `centre`.
    Figures that a kind does not use are 0.
    """

    name: str
    mechanism: Mechanism
    title: str
    kind: Kind
    au: str
    sides: Sides
    region: Region
    attachment: Floats | None
    insertion: Floats | None
    centre: Floats | None
    direction: Floats | None
    radii: tuple[float, ...]
    angle: float
    exponent: float
    reach: float
    fall: float
    power: float
    arch: float
    reaction: float
    reaction_at: float
    bulge: float
    along_skin: float
    prior: float
    amplitude: float


#: What each kind must give.
NEEDS: Mapping[Kind, tuple[str, ...]] = {
    Kind.LINEAR: ("attachment", "insertion", "angle_deg", "exponent", "reach"),
    Kind.SHEET: ("attachment", "insertion", "exponent", "reach"),
    Kind.SPHINCTER: ("centre", "radii_mm", "fall"),
    Kind.SPHINCTER_SKIN: ("centre", "radii_mm", "fall"),
    Kind.WINDOW: ("centre", "radii_mm", "power", "direction"),
    Kind.BAND: ("centre", "radii_mm", "direction"),
    Kind.ARCH: ("centre", "radii_mm", "arch_mm"),
    Kind.PRESSURE: ("centre", "radii_mm", "bulge"),
}
COMMON = ("title", "kind", "au", "sides", "region", "prior_mm", "amplitude_mm")
OPTIONAL = ("reaction", "reaction_at", "bulge", "along_skin")


def _place(path: Path, key: str, entry: Any) -> Floats:
    """A table position, or a line of two, on the template."""
    if isinstance(entry, list):
        return np.stack([_place(path, key, one) for one in entry])
    point = entry.get("point") if isinstance(entry, dict) else None
    offset = entry.get("offset") if isinstance(entry, dict) else None
    if not isinstance(point, str) or point not in TEMPLATE_POINTS:
        raise FormatError(path, f"names feature point {point!r}, which the template lacks", key=key)
    if not isinstance(offset, list) or len(offset) != 3:
        raise FormatError(path, "needs an offset of three numbers in units of ES0, ENS0, ENS0", key=key)
    return TEMPLATE_POINTS[point] + np.array(offset, dtype=np.float64) * OFFSET_UNITS


def _row(path: Path, mechanism: Mechanism, name: str, raw: Mapping[str, Any]) -> MuscleRow:
    """One checked row."""
    key = f"muscles.{name}"
    try:
        kind, sides, region = Kind(raw.get("kind", "")), Sides(raw.get("sides", "")), Region(raw.get("region", ""))
    except ValueError as error:
        raise FormatError(path, f"kind, sides or region: {error}", key=key) from error
    for needed in (*COMMON, *NEEDS[kind]):
        if needed not in raw:
            raise FormatError(path, f"a {kind} muscle needs {needed}", key=key)
    extra = set(raw) - {*COMMON, *NEEDS[kind], *OPTIONAL}
    if extra:
        raise FormatError(path, f"a {kind} muscle has no {', '.join(sorted(extra))}", key=key)
    for figure in ("prior_mm", "amplitude_mm", "arch_mm"):
        if figure in raw and not raw[figure] > 0:
            raise FormatError(path, f"{figure} must be positive, not {raw[figure]!r}", key=key)
    places = {
        p: _place(path, f"{key}.{p}", raw[p]) if p in raw else None for p in ("attachment", "insertion", "centre")
    }
    return MuscleRow(
        name=name,
        mechanism=mechanism,
        title=str(raw["title"]),
        kind=kind,
        au=str(raw["au"]),
        sides=sides,
        region=region,
        **places,
        direction=np.array(raw["direction"], dtype=np.float64) if "direction" in raw else None,
        radii=tuple(MM * float(r) for r in raw.get("radii_mm", ())),
        angle=float(np.radians(raw.get("angle_deg", 0.0))),
        exponent=float(raw.get("exponent", 0.0)),
        reach=float(raw.get("reach", 0.0)),
        fall=float(raw.get("fall", 0.0)),
        power=float(raw.get("power", 0.0)),
        arch=MM * float(raw.get("arch_mm", 0.0)),
        reaction=float(raw.get("reaction", 0.0)),
        reaction_at=float(raw.get("reaction_at", 0.0)),
        bulge=float(raw.get("bulge", 0.0)),
        along_skin=float(raw.get("along_skin", 0.0)),
        prior=MM * float(raw["prior_mm"]),
        amplitude=MM * float(raw["amplitude_mm"]),
    )


def _group(path: Path, raw: Mapping[str, Any]) -> Mechanism:
    """The group that a table says it is."""
    name = raw.get("mechanism")
    if name not in MUSCLE_GROUPS:
        raise FormatError(path, f"must be one of {', '.join(MUSCLE_GROUPS)}, not {name!r}", key="mechanism")
    return Mechanism(name)


def read_muscles(path: Path = ANATOMY / "muscles") -> dict[str, MuscleRow]:
    """The rows of a table of muscles by name; `path` is a file, or a folder of them.

    Raises
    ------
    FormatError : names the file, the key and the rule that is broken.
    """
    rows: dict[str, MuscleRow] = {}
    for file in sorted(path.glob("*.toml")) if path.is_dir() else [path]:
        raw = read_toml(file)
        mechanism = _group(file, raw)
        for name, row in raw.get("muscles", {}).items():
            if name in rows:
                raise FormatError(file, f"is also a muscle of the group {rows[name].mechanism}", key=f"muscles.{name}")
            rows[name] = _row(file, mechanism, name, row)
    return rows


def muscles_of(mechanisms: frozenset[Mechanism]) -> dict[str, MuscleRow]:
    """The built-in rows whose group, and whose kind where it is not the paper's, is among some mechanisms."""
    flat = Mechanism.FLAT_PULLS in mechanisms
    return {
        name: row
        for name, row in read_muscles().items()
        if row.mechanism in mechanisms and (flat or row.kind in PAPER_KINDS)
    }
