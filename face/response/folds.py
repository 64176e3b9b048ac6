"""Folds: lines where squeezed skin gives way - nasolabial, forehead, glabella.

The elastic skin is smooth over a centimetre; folds are not. Each is a line on the template, carried to the face. Where
the posed skin is shortened across the line, it sinks along the line and rises beside it, the more the shorter it gets
and without gaining volume. A mesh too coarse for a fold gets a broader and shallower one, or none. Feature points keep
their places.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree

from ...arrays import Floats, Ints
from ...physics.mesh import Sparse, applied
from ...progress import Progress, Work, stepwise
from ...tables import TomlTable, read_toml
from ..figures import ANATOMY, Length, Share, read_figures
from ..mesh.template import MM, TemplateWarp
from ..skin.lines import COURSE, Beside, line_on
from ..skin.outer import OuterSkin, smoothstep

#: Points along a line at which compression is taken.
GAUGES = 9

#: Half a valley is at least this many edges wide; made so many times wider by that, a fold begins to fade and is gone.
EDGES = 1.3
FADES_FROM, FADES_TO = 1.4, 1.75

#: A fold reaches so many times its width to both sides.
SPREAD = 5.0

#: A fold that would be shallower than this at its fullest is left out, metres.
SHALLOWEST = 0.1 * MM


@dataclass(frozen=True)
class FoldFigures:
    """Of all folds (presets/anatomy/folds.toml)."""

    ends: Share
    shared: Share
    spared: Length


FOLDS = read_figures("folds.every", FoldFigures)


@dataclass(frozen=True, eq=False)
class FoldRow:
    """One row of the table of folds; lengths in metres of head space.

    Attributes
    ----------
    name : unique, with "_l" or "_r" where there are two.
    line : (k, 3) along the valley on the template.
    width, depth, lean : half width and depth of the valley; how much higher the outer ridge is.
    gauge, onset, full : length over which compression is taken; compressions at which the fold begins and is full.
    """

    name: str
    line: Floats
    width: float
    depth: float
    lean: float
    gauge: float
    onset: float
    full: float


def _rows(name: str, row: TomlTable) -> list[FoldRow]:
    """The one or two folds of a table's entry."""
    row.only("sides", "line_mm", "width_mm", "depth_mm", "lean", "gauge_mm", "onset", "full")
    sides = row.choice("sides", ("pair", "joined"))
    line = row.numbers("line_mm", None, 3) * MM
    if len(line) < 2:
        raise row.refuse("must be two or more points", "line_mm")
    width, depth, gauge = (MM * row.number(key, above=0.0) for key in ("width_mm", "depth_mm", "gauge_mm"))
    onset = row.number("onset", least=0.0)
    figures = (width, depth, row.number("lean"), gauge, onset, row.number("full", above=onset))
    mirrored = line * np.array([-1.0, 1.0, 1.0])
    if sides == "joined":
        across = np.concatenate([mirrored[::-1], line[1:] if line[0, 0] == 0.0 else line])
        return [FoldRow(name, across, *figures)]
    return [FoldRow(f"{name}_l", line, *figures), FoldRow(f"{name}_r", mirrored, *figures)]


def read_folds(path: Path = ANATOMY / "folds.toml") -> list[FoldRow]:
    """The folds of a table.

    Raises
    ------
    FormatError : names the file, the key and the rule that is broken.
    """
    return [fold for name, row in read_toml(path).tables("folds").items() for fold in _rows(name, row)]


@dataclass(frozen=True, eq=False)
class PlacedFold:
    """One fold on one face.

    Attributes
    ----------
    row : its figures.
    plus, minus : (GAUGES, n) readers of the skin on both sides of the line, half a gauge away.
    lengths : (GAUGES,) distances between what they read at rest, metres.
    field : (n, GAUGES) heights in metres along the skin's normals for full folding at each gauge.
    """

    row: FoldRow
    plus: Sparse
    minus: Sparse
    lengths: Floats
    field: Sparse

    def compression(self, positions: Floats) -> Floats:
        """(GAUGES,) share by which posed skin (n, 3) is shortened across the line; negative: stretched."""
        now = np.linalg.norm(np.asarray(self.plus @ positions - self.minus @ positions), axis=1)
        return np.asarray(1.0 - now / self.lengths)

    def heights(self, positions: Floats) -> Floats:
        """(n,) heights along the normals, metres, for posed skin (n, 3)."""
        return np.asarray(self.field @ self.amounts(self.compression(positions)))

    def amounts(self, squeezed: Floats) -> Floats:
        """(..., GAUGES) how far the fold shows at each gauge, 0..1, by the `compression` (..., GAUGES)."""
        row, most = self.row, np.sort(squeezed, axis=-1)[..., -GAUGES // 2 :].mean(axis=-1, keepdims=True)
        together = (1.0 - FOLDS.shared) * squeezed + FOLDS.shared * most
        return smoothstep((together - row.onset) / (row.full - row.onset))


def _reader(tree: cKDTree, places: Floats, count: int) -> Sparse:
    """(k, n) averages of the skin round some places (k, 3), each over the few nearest vertices."""
    distance, nearest = (np.reshape(part, (len(places), 6)) for part in tree.query(places, k=6))
    share = np.exp(-((distance / (distance[:, 2:3] + 0.1 * MM)) ** 2))
    share /= share.sum(axis=1, keepdims=True)
    rows = np.repeat(np.arange(len(places)), 6)
    return sparse.csr_array((share.ravel(), (rows, nearest.ravel())), shape=(len(places), count))


def _profile(across: Floats, lean: float) -> Floats:
    """Height over distance across the line in half widths: a valley of depth 1, ridges beside it, no volume."""
    fall = np.exp(-(across**2) / 2.0)
    profile: Floats = (across**2 - 1.0 + lean * across) * fall
    return profile


def place_fold(skin: OuterSkin, warp: TemplateWarp, row: FoldRow, spared: Floats) -> PlacedFold | None:
    """A fold on a face, or None where the mesh is too coarse for it; `spared` (n,) is 0 where nothing may move."""
    rest, tree, line = skin.positions, skin.tree, line_on(skin, warp, row.line)
    edge = float(np.median(np.sqrt(skin.areas[tree.query(line.course, k=6)[1]])))
    width = max(row.width, EDGES * edge)
    excess = width / row.width
    depth = row.depth / excess * (1.0 - float(smoothstep(np.array((excess - FADES_FROM) / (FADES_TO - FADES_FROM)))))
    if depth < SHALLOWEST:
        return None
    near = np.flatnonzero(cKDTree(line.course).query(rest, distance_upper_bound=SPREAD * width)[0] < np.inf)
    field = np.zeros((skin.vertex_count, GAUGES))
    field[near] = _field(line.beside(rest[near]), width, row.lean)
    field = _neutral(field * (depth * spared)[:, None], skin.areas)
    at = np.linspace(0, COURSE - 1, GAUGES).round().astype(np.int64)
    reach = 0.5 * max(row.gauge, 3.0 * edge) * line.outwards[at]
    plus, minus = (_reader(tree, line.course[at] + sign * reach, skin.vertex_count) for sign in (1.0, -1.0))
    lengths = np.linalg.norm(np.asarray(plus @ rest - minus @ rest), axis=1)
    return PlacedFold(row, plus, minus, lengths, sparse.csr_array(field))


def _field(beside: Beside, width: float, lean: float) -> Floats:
    """(n, GAUGES) heights of a fold of depth 1 over the skin about its line, shared among the gauges along it."""
    ends = smoothstep(beside.share / FOLDS.ends) * smoothstep((1.0 - beside.share) / FOLDS.ends)
    height = _profile(beside.across / width, lean) * ends * (beside.off < SPREAD * width)
    place = beside.share * (GAUGES - 1.0)
    share = np.maximum(1.0 - np.abs(place[:, None] - np.arange(GAUGES)), 0.0)
    heights: Floats = height[:, None] * share
    return heights


def _neutral(field: Floats, areas: Floats) -> Floats:
    """The field with its ridges scaled, within reason, to hold what the valley has lost."""
    lost, gained = (float((areas @ np.maximum(sign * field, 0.0)).sum()) for sign in (-1.0, 1.0))
    scale = float(np.clip(lost / max(gained, 1e-18), 0.5, 1.5))
    return np.where(field > 0.0, scale * field, field)


class Folds:
    """The folds of one face's outer skin."""

    def __init__(self, skin: OuterSkin, warp: TemplateWarp, fixed: Ints, rows: Sequence[FoldRow] | None = None) -> None:
        """Place the folds of a table (the built-in one) on a face; `fixed` are vertices that must stay."""
        self.skin, self._warp, self._fixed, self._rows = skin, warp, fixed, rows

    @stepwise
    def placed(self) -> Work[list[PlacedFold]]:
        """The folds that the mesh is fine enough for."""
        skin = self.skin
        distance, _ = cKDTree(skin.positions[self._fixed]).query(skin.positions)
        spared = 1.0 - np.exp(-((distance / FOLDS.spared) ** 2))
        spared[self._fixed] = 0.0
        rows = read_folds() if self._rows is None else self._rows
        placed = []
        for number, row in enumerate(rows):
            yield Progress(number / len(rows), "Placing folds")
            placed.append(place_fold(skin, self._warp, row, spared))
        return [fold for fold in placed if fold is not None]

    @cached_property
    def _gauges(self) -> tuple[Ints, Sparse, Floats, Sparse]:
        """Of all folds: (r,) vertices that are read, their reader (f GAUGES, r), lengths at rest and field."""
        reader = sparse.vstack([fold.plus - fold.minus for fold in self.placed]).tocsc()
        read = np.flatnonzero(np.diff(reader.indptr))
        lengths = np.concatenate([fold.lengths for fold in self.placed])
        return read, reader[:, read].tocsr(), lengths, sparse.hstack([fold.field for fold in self.placed]).tocsr()

    def displacement(self, displacement: Floats) -> Floats:
        """What folds add (..., n, 3) to displacements (..., n, 3) of the outer skin; head space, metres."""
        if not self.placed:
            return np.zeros_like(displacement)
        read, reader, lengths, field = self._gauges
        positions = (self.skin.positions[read] + displacement[..., read, :]).reshape(-1, len(read), 3)
        squeezed = 1.0 - np.linalg.norm(applied(reader, positions), axis=2) / lengths
        parts = np.split(squeezed, len(self.placed), axis=1)
        amounts = np.concatenate([fold.amounts(part) for fold, part in zip(self.placed, parts, strict=True)], axis=1)
        heights = np.asarray(field @ amounts.T).T.reshape(displacement.shape[:-1])
        return np.asarray(heights[..., None] * self.skin.normals)
