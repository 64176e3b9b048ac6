"""The figures of the default head, read from presets/heads/default.toml and checked once.

The file holds the left half in millimetres, as its measurements were taken; `read_figures` returns metres.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np

from ...arrays import Floats
from ...errors import FormatError
from ...resources import PRESETS
from .cage import EAR_RIM, EAR_RINGS, EYE_RIM, MOUTH_RIM, ROWS, grid_name, grid_nodes, on_midline, ring_name

DEFAULT_FIGURES = PRESETS / "heads" / "default.toml"

MEASURED_EYE_RINGS = ("E4", "E3", "E2")
MEASURED_MOUTH_RINGS = ("M4", "M3", "M2", "M1")
MM = 1e-3


@dataclass(frozen=True)
class EyeballFigures:
    """Left eyeball: centre (3,) and radii of ball, iris and pupil, metres."""

    centre: Floats
    radius: float
    iris_radius: float
    pupil_radius: float


@dataclass(frozen=True)
class TeethFigures:
    """One dental arch, metres: an ellipse x = half_width sin t, y = back - depth cos t.

    Attributes
    ----------
    half_width, depth, back : the ellipse.
    edge, gum : heights of the biting edge and of the gum line.
    widths : (7,) crown widths of one side, from the central incisor to the second molar.
    """

    half_width: float
    depth: float
    back: float
    edge: float
    gum: float
    widths: Floats


@dataclass(frozen=True)
class TongueFigures:
    """Tongue: an ellipsoid, metres; `groove` is the depth of its middle furrow."""

    centre: Floats
    semi_axes: Floats
    groove: float


@dataclass(frozen=True)
class BrowFigures:
    """Left brow, metres: centre line (N, 2) in x and z from the front, half widths (N,), lift of its middle."""

    line: Floats
    half_widths: Floats
    lift: float


@dataclass(frozen=True)
class MaterialFigures:
    """A material: name, base colour (linear RGB, 0..1) and roughness (0..1)."""

    name: str
    colour: tuple[float, float, float]
    roughness: float


@dataclass(frozen=True)
class PointFigures:
    """Where a feature point lies on the skin.

    Attributes
    ----------
    nodes : a cage node, the 2 ends of a cage edge (its middle) or the 4 corners of a cage quad (its middle).
    uv : place inside the quad of 4 nodes, along nodes 1-2 and 1-4, each 0..1; None for the middle.
    """

    nodes: tuple[str, ...]
    uv: tuple[float, float] | None = None


@dataclass(frozen=True)
class HeadFigures:
    """Everything measured or chosen about the default head.

    Attributes
    ----------
    nodes : cage node name -> (3,) metres, left half.
    condyle : (3,) metres, the middle of the jaw hinge.
    neck_pivot : (3,) metres, feature point 7.1.
    points : feature point -> its place; left and midline.
    point_pairs : left feature point -> right feature point.
    """

    nodes: Mapping[str, Floats]
    eyeball: EyeballFigures
    teeth_upper: TeethFigures
    teeth_lower: TeethFigures
    tongue: TongueFigures
    brow: BrowFigures
    condyle: Floats
    neck_pivot: Floats
    materials: tuple[MaterialFigures, ...]
    points: Mapping[str, PointFigures]
    point_pairs: Mapping[str, str]


def read_figures(path: str | Path = DEFAULT_FIGURES) -> HeadFigures:
    """Read and check a table of head figures.

    Parameters
    ----------
    path : TOML file; the left half in millimetres, +X the subject's left, -Y front, +Z up.

    Raises
    ------
    FormatError : names the file, the key and what is expected there.
    """
    path = Path(path)
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise FormatError(path, f"not valid TOML: {error}") from error
    except OSError as error:
        raise FormatError(path, f"cannot be read: {error.strerror}") from error
    return _TableReader(path, table).head()


class _TableReader:
    """Takes values out of one TOML table; every complaint names the file and the key."""

    def __init__(self, path: Path, table: Mapping[str, Any]) -> None:
        self.path, self.table = path, table

    def head(self) -> HeadFigures:
        """The whole table."""
        if self.value("unit") != "mm":
            raise FormatError(self.path, 'must be "mm": give the figures in millimetres', key="unit")
        points, pairs = self.feature_points()
        eyeball = EyeballFigures(
            self.vector("eyeball.centre"),
            self.length("eyeball.radius"),
            self.length("eyeball.iris_radius"),
            self.length("eyeball.pupil_radius"),
        )
        brow = self.array("brow.line", (None, 3)) * MM
        return HeadFigures(
            nodes=self.nodes(),
            eyeball=eyeball,
            teeth_upper=self.teeth("teeth_upper"),
            teeth_lower=self.teeth("teeth_lower"),
            tongue=TongueFigures(
                self.vector("tongue.centre"), self.vector("tongue.semi_axes"), self.length("tongue.groove")
            ),
            brow=BrowFigures(brow[:, :2], brow[:, 2], self.length("brow.lift")),
            condyle=self.vector("jaw.condyle"),
            neck_pivot=self.vector("neck.pivot"),
            materials=self.materials(),
            points=points,
            point_pairs=pairs,
        )

    def nodes(self) -> dict[str, Floats]:
        """Every measured node of the left half; midline nodes must lie on it."""
        nodes: dict[str, Floats] = {}
        for row in range(ROWS):
            columns = grid_nodes(row)
            values = self.array(f"grid.r{row:02d}", (len(columns), 3))
            nodes |= {grid_name(row, c): p for c, p in zip(columns, values, strict=True)}
        for i in range(3):
            values = self.array(f"cap.cap{i}", (7, 3))
            nodes |= {f"cap{i}_{j}": p for j, p in enumerate(values, start=1)}
        families = (
            ("eye", MEASURED_EYE_RINGS, len(EYE_RIM)),
            ("mouth", MEASURED_MOUTH_RINGS, len(MOUTH_RIM)),
            ("ear", EAR_RINGS, len(EAR_RIM)),
            ("ear", ("CTR",), 4),
        )
        for family, rings, count in families:
            for ring in rings:
                values = self.array(f"{family}.{ring}", (count, 3))
                nodes |= {ring_name(family[:3] + ring, k): p for k, p in enumerate(values)}
        for name, point in nodes.items():
            if (point[0] != 0.0) if on_midline(name) else (point[0] <= 0.0):
                rule = "must have x = 0 (it lies on the midline)" if on_midline(name) else "must have x > 0 (left half)"
                raise FormatError(self.path, f"{rule}, but x is {point[0]:g}", key=name)
        return {name: point * MM for name, point in nodes.items()}

    def feature_points(self) -> tuple[dict[str, PointFigures], dict[str, str]]:
        """Feature points on the skin; left and right of a pair share one line."""
        points: dict[str, PointFigures] = {}
        pairs: dict[str, str] = {}
        for name in cast("Mapping[str, Any]", self.value("feature_points")):
            key = f'feature_points."{name}"'
            entry = self.table["feature_points"][name]
            nodes = entry.get("nodes") if isinstance(entry, dict) else None
            if not isinstance(nodes, list) or len(nodes) not in (1, 2, 4):
                raise FormatError(self.path, "needs nodes = [...] with 1, 2 or 4 node names", key=key)
            uv = entry.get("uv")
            if uv is not None:
                u, v = self.numbers(uv, (2,), f"{key}.uv")
                if len(nodes) != 4 or not (0.0 <= u <= 1.0 and 0.0 <= v <= 1.0):
                    raise FormatError(self.path, "uv needs 4 nodes and two numbers between 0 and 1", key=key)
                uv = (float(u), float(v))
            left, *right = name.split(" ")
            points[left] = PointFigures(tuple(map(str, nodes)), uv)
            if right:
                pairs[left] = right[0]
        return points, pairs

    def materials(self) -> tuple[MaterialFigures, ...]:
        """Materials in the order of the file."""
        found = []
        for name in cast("Mapping[str, Any]", self.value("materials")):
            red, green, blue = self.array(f"materials.{name}.colour", (3,))
            roughness = self.number(f"materials.{name}.roughness")
            if not all(0.0 <= v <= 1.0 for v in (red, green, blue, roughness)):
                raise FormatError(self.path, "colour and roughness must lie between 0 and 1", key=f"materials.{name}")
            found.append(MaterialFigures(name, (float(red), float(green), float(blue)), roughness))
        return tuple(found)

    def teeth(self, key: str) -> TeethFigures:
        """One dental arch."""
        return TeethFigures(
            self.length(f"{key}.half_width"),
            self.length(f"{key}.depth"),
            self.number(f"{key}.back_y") * MM,
            self.number(f"{key}.edge_z") * MM,
            self.number(f"{key}.gum_z") * MM,
            self.array(f"{key}.crown_widths", (7,)) * MM,
        )

    def value(self, key: str) -> Any:
        """The value under a dotted key."""
        found: Any = self.table
        for part in key.split("."):
            if not isinstance(found, dict) or part not in found:
                raise FormatError(self.path, "is missing", key=key)
            found = found[part]
        return found

    def number(self, key: str) -> float:
        """A finite number."""
        value = self.value(key)
        if isinstance(value, bool) or not isinstance(value, int | float) or not np.isfinite(value):
            raise FormatError(self.path, f"must be a finite number, but it is {value!r}", key=key)
        return float(value)

    def length(self, key: str) -> float:
        """A positive length, given in millimetres."""
        value = self.number(key)
        if value <= 0.0:
            raise FormatError(self.path, f"must be greater than 0, but it is {value!r}", key=key)
        return value * MM

    def vector(self, key: str) -> Floats:
        """A position or size, given in millimetres."""
        return self.array(key, (3,)) * MM

    def array(self, key: str, shape: tuple[int | None, ...]) -> Floats:
        """Finite numbers of a given shape (None: any count), in the unit of the file."""
        return self.numbers(self.value(key), shape, key)

    def numbers(self, value: object, shape: tuple[int | None, ...], key: str) -> Floats:
        """Finite numbers of a given shape out of a value already found."""
        wanted = " x ".join("N" if n is None else str(n) for n in shape)
        try:
            found = np.array(value, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise FormatError(self.path, f"must be {wanted} numbers", key=key) from error
        if found.ndim != len(shape) or any(n not in (None, m) for n, m in zip(shape, found.shape, strict=True)):
            got = " x ".join(map(str, found.shape))
            raise FormatError(self.path, f"must be {wanted} numbers, but it is {got}", key=key)
        if not np.isfinite(found).all():
            raise FormatError(self.path, "must hold finite numbers only", key=key)
        return found
