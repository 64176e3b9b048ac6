"""The figures of the default head, read from presets/heads/default.toml and checked once.

The file holds the left half in millimetres, as its measurements were taken; `read_figures` returns metres.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ...arrays import Floats
from ...resources import PRESETS
from ...tables import TomlTable, read_toml
from ..mesh.template import MM
from .cage import EAR_RIM, EAR_RINGS, EYE_RIM, MOUTH_RIM, ROWS, grid_name, grid_nodes, on_midline, ring_name

DEFAULT_FIGURES = PRESETS / "heads" / "default.toml"

MEASURED_EYE_RINGS = ("E4", "E3", "E2")
MEASURED_MOUTH_RINGS = ("M4", "M3", "M2", "M1")


@dataclass(frozen=True, eq=False)
class EyeballFigures:
    """Left eyeball: centre (3,) and radii of ball, iris and pupil, metres; `limbus` is the ring's share of the iris."""

    centre: Floats
    radius: float
    iris_radius: float
    pupil_radius: float
    limbus: float


@dataclass(frozen=True, eq=False)
class LidMarginFigures:
    """The rim of the left lids, metres.

    Attributes
    ----------
    thickness : least and greatest, of the rim.
    clearance, gap, fold_clearance : from the eyeball to the rim's inner edge, to the lids' other vertices, and to the
        skin that ends behind the lid.
    shift, canthus_shift : of the rim towards `opening` (3,), the middle of the lids' opening; at the inner corner.
    """

    thickness: Floats
    clearance: float
    gap: float
    fold_clearance: float
    shift: float
    canthus_shift: float
    opening: Floats


@dataclass(frozen=True)
class MouthBagFigures:
    """The bag behind the lips, metres.

    Attributes
    ----------
    back, throat : how far back it is full and where it ends, y.
    narrowing : width of its end, as a share of the full width.
    """

    back: float
    throat: float
    narrowing: float


@dataclass(frozen=True, eq=False)
class TeethFigures:
    """One dental arch, metres: an ellipse x = half_width sin t, y = back - depth cos t.

    Attributes
    ----------
    half_width, depth, back : the ellipse.
    edge, gum : heights of the biting edge and of the gum line.
    widths : (7,) crown widths of one side, from the central incisor to the second molar.
    groove : depth of the groove between two crowns.
    """

    half_width: float
    depth: float
    back: float
    edge: float
    gum: float
    widths: Floats
    groove: float


@dataclass(frozen=True, eq=False)
class TongueFigures:
    """Tongue: an ellipsoid, metres.

    Attributes
    ----------
    groove, furrow : depth of its middle furrow, and its width as a share of the half width.
    back_drop : how far the back end sinks.
    dorsum, dorsum_at, dorsum_length : how far its back rises over the ellipsoid, where (0 the middle, 1 the back end)
        and how far along, as shares of the half length.
    """

    centre: Floats
    semi_axes: Floats
    groove: float
    furrow: float
    back_drop: float
    dorsum: float
    dorsum_at: float
    dorsum_length: float


@dataclass(frozen=True, eq=False)
class BrowFigures:
    """Left brow, metres.

    Attributes
    ----------
    line : (N, 2) its centre in x and z from the front. half_widths : (N,).
    lift, sink : height of its middle over the skin, depth of its border under it.
    furrow : height between two tufts, as a share of it.
    fringe : how much farther tufts reach than the furrows between them, at most, as a share of the half width.
    lean : how far tufts lean outwards on their way up: 0 not at all, 1 lying flat.
    light : share of the tufts that are of a lighter colour.
    """

    line: Floats
    half_widths: Floats
    lift: float
    sink: float
    furrow: float
    fringe: float
    lean: float
    light: float


@dataclass(frozen=True)
class MaterialFigures:
    """A material: name, base colour (linear RGB, 0..1), roughness (0..1) and how metallic it is (0..1)."""

    name: str
    colour: tuple[float, float, float]
    roughness: float
    metallic: float


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


@dataclass(frozen=True, eq=False)
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
    lid_margin: LidMarginFigures
    mouth_bag: MouthBagFigures
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
    table = read_toml(path)
    table.choice("unit", ("mm",))
    eyeball = table.table("eyeball")
    points, pairs = _feature_points(table.table("feature_points"))
    return HeadFigures(
        nodes=_nodes(table),
        eyeball=EyeballFigures(
            _vector(eyeball, "centre"),
            _length(eyeball, "radius"),
            _length(eyeball, "iris_radius"),
            _length(eyeball, "pupil_radius"),
            eyeball.number("limbus", above=0.0, most=1.0),
        ),
        lid_margin=_lid_margin(table.table("lid_margin")),
        mouth_bag=_mouth_bag(table.table("mouth_bag")),
        teeth_upper=_teeth(table.table("teeth_upper")),
        teeth_lower=_teeth(table.table("teeth_lower")),
        tongue=_tongue(table.table("tongue")),
        brow=_brow(table.table("brow")),
        condyle=_vector(table.table("jaw"), "condyle"),
        neck_pivot=_vector(table.table("neck"), "pivot"),
        materials=tuple(_material(name, row) for name, row in table.tables("materials").items()),
        points=points,
        point_pairs=pairs,
    )


def _nodes(table: TomlTable) -> dict[str, Floats]:
    """Every measured node of the left half; midline nodes must lie on it."""
    nodes: dict[str, Floats] = {}
    for row in range(ROWS):
        columns = grid_nodes(row)
        values = table.table("grid").numbers(f"r{row:02d}", len(columns), 3)
        nodes |= {grid_name(row, c): p for c, p in zip(columns, values, strict=True)}
    for i in range(3):
        nodes |= {f"cap{i}_{j}": p for j, p in enumerate(table.table("cap").numbers(f"cap{i}", 7, 3), start=1)}
    families = (
        ("eye", MEASURED_EYE_RINGS, len(EYE_RIM)),
        ("mouth", MEASURED_MOUTH_RINGS, len(MOUTH_RIM)),
        ("ear", EAR_RINGS, len(EAR_RIM)),
        ("ear", ("CTR",), 4),
    )
    for family, rings, count in families:
        for ring in rings:
            values = table.table(family).numbers(ring, count, 3)
            nodes |= {ring_name(family[:3] + ring, k): p for k, p in enumerate(values)}
    for name, point in nodes.items():
        if (point[0] != 0.0) if on_midline(name) else (point[0] <= 0.0):
            rule = "must have x = 0 (it is on the midline)" if on_midline(name) else "must have x > 0 (left half)"
            raise table.refuse(f"{rule}, but x is {point[0]:g}", name)
    return {name: point * MM for name, point in nodes.items()}


def _feature_points(table: TomlTable) -> tuple[dict[str, PointFigures], dict[str, str]]:
    """Feature points on the skin; left and right of a pair share one line."""
    points: dict[str, PointFigures] = {}
    pairs: dict[str, str] = {}
    for name in table:
        entry = table.table(name)
        nodes = entry.texts("nodes")
        if len(nodes) not in (1, 2, 4):
            raise entry.refuse("must be 1, 2 or 4 names of nodes", "nodes")
        uv = None
        if "uv" in entry:
            u, v = entry.numbers("uv", 2)
            if len(nodes) != 4 or not (0.0 <= u <= 1.0 and 0.0 <= v <= 1.0):
                raise entry.refuse("needs 4 nodes and two numbers between 0 and 1", "uv")
            uv = (float(u), float(v))
        left, *right = name.split(" ")
        points[left] = PointFigures(nodes, uv)
        if right:
            pairs[left] = right[0]
    return points, pairs


def _material(name: str, row: TomlTable) -> MaterialFigures:
    """One material."""
    red, green, blue = (float(value) for value in row.numbers("colour", 3))
    if not all(0.0 <= value <= 1.0 for value in (red, green, blue)):
        raise row.refuse("must be three numbers between 0 and 1", "colour")
    metallic = row.number("metallic", least=0.0, most=1.0) if "metallic" in row else 0.0
    return MaterialFigures(name, (red, green, blue), row.number("roughness", least=0.0, most=1.0), metallic)


def _teeth(row: TomlTable) -> TeethFigures:
    """One dental arch."""
    return TeethFigures(
        _length(row, "half_width"),
        _length(row, "depth"),
        row.number("back_y") * MM,
        row.number("edge_z") * MM,
        row.number("gum_z") * MM,
        row.numbers("crown_widths", 7) * MM,
        _length(row, "groove"),
    )


def _lid_margin(row: TomlTable) -> LidMarginFigures:
    """The rim of the lids."""
    return LidMarginFigures(
        row.numbers("thickness", 2) * MM,
        _length(row, "clearance"),
        _length(row, "gap"),
        _length(row, "fold_clearance"),
        _length(row, "shift"),
        _length(row, "canthus_shift"),
        _vector(row, "opening"),
    )


def _brow(row: TomlTable) -> BrowFigures:
    """The left brow."""
    line = row.numbers("line", None, 3) * MM
    return BrowFigures(
        line[:, :2],
        line[:, 2],
        _length(row, "lift"),
        _length(row, "sink"),
        row.number("furrow", above=0.0, most=1.0),
        row.number("fringe", least=0.0, most=1.0),
        row.number("lean", least=0.0, most=1.0),
        row.number("light", least=0.0, most=1.0),
    )


def _mouth_bag(row: TomlTable) -> MouthBagFigures:
    """The bag behind the lips."""
    return MouthBagFigures(
        row.number("back_y") * MM, row.number("throat_y") * MM, row.number("narrowing", above=0.0, most=1.0)
    )


def _tongue(row: TomlTable) -> TongueFigures:
    """The tongue."""
    return TongueFigures(
        _vector(row, "centre"),
        _vector(row, "semi_axes"),
        _length(row, "groove"),
        row.number("furrow", above=0.0, most=1.0),
        _length(row, "back_drop"),
        row.number("dorsum", least=0.0) * MM,
        row.number("dorsum_at", least=-1.0, most=1.0),
        row.number("dorsum_length", above=0.0),
    )


def _length(row: TomlTable, name: str) -> float:
    """A length, given in millimetres."""
    return row.number(name, above=0.0) * MM


def _vector(row: TomlTable, name: str) -> Floats:
    """(3,) a position or size, given in millimetres."""
    return row.numbers(name, 3) * MM
