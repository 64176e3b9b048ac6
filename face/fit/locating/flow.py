"""Where the parts of the template's face lie in a face that is crooked or unlike it: two pictures are compared.

Nearest points pull a template into place only where it nearly lies there. Here every patch of its picture is tried
in all places within reach, and the places that neighbours agree on win: coupled discrete matching, after

    M. P. Heinrich, B. W. Papiez, J. A. Schnabel, H. Handels (2014): Non-parametric discrete registration with convex
    optimisation. WBIR 2014, LNCS 8545.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.ndimage import gaussian_filter

from ....arrays import Floats
from ..template.picture import COLUMNS, LOW, PIXEL, ROWS, Picture, looked_up, template_picture

#: Half width of a patch, pixels; only every so many-th pixel is a patch of its own.
PATCH, STEP = 3.0, 2
#: The most that a difference counts, and the difference to what is not there.
MOST, MISSING = 2.0, 1.0
#: How firmly a patch holds to what its neighbours agree on, round by round; per square pixel.
FIRM = (0.01 / 9.0, 0.03 / 9.0, 0.1 / 9.0)
#: Share of a field's own curvature that smoothness costs, and how much empty places draw its detail to nothing.
CURVED, EMPTY = 0.02, 0.15
#: Depths farther than this from the smooth field are another surface, metres, ever stricter; blur of the last, pixels.
ASTRAY, DEPTH_SMOOTH = (30e-3, 20e-3, 12e-3, 8e-3), 5.0


class Pass(NamedTuple):
    """One search: how far, in what steps (pixels), and how fine a field may be: blur in patches, 0 is a quadratic."""

    reach: int
    step: int
    smooth: float


@dataclass(frozen=True, eq=False)
class Flow:
    """How far each place of the template's picture is from its counterpart.

    Attributes
    ----------
    across, back, up : (ROWS, COLUMNS) metres of the template, along x, y and z.
    """

    across: Floats
    back: Floats
    up: Floats

    def at(self, places: Floats) -> Floats:
        """(N, 3) displacements of places (N, 3) of the template; beyond the picture those of its sides."""
        columns, rows = ((places[:, [0, 2]] - LOW) / PIXEL - 0.5).T
        return np.column_stack([looked_up(field, rows, columns) for field in (self.across, self.back, self.up)])


def find_flow(seen: Picture, jaw_degrees: float, passes: tuple[Pass, ...]) -> Flow:
    """The flow from the template's picture to another one, found in ever finer passes."""
    own, weight = template_picture(jaw_degrees)
    shift = np.zeros((2, ROWS, COLUMNS))
    for each in passes:
        shift = _matched(seen, own, weight, shift, each)
    return Flow(shift[0] * PIXEL, _depths(seen, own, weight, shift), shift[1] * PIXEL)


def _matched(seen: Picture, own: Picture, weight: Floats, shift: Floats, how: Pass) -> Floats:
    """(2, ROWS, COLUMNS) shifts along x and z, pixels, after one search round those at hand."""
    steps = np.arange(-how.reach, how.reach + 1, how.step)
    ways = np.array([(x, z) for z in steps for x in steps], dtype=np.float64)
    share = _patches(weight)
    costs = np.array([_patches(_differences(seen, own, shift + way[:, None, None]) * weight) for way in ways])
    costs /= np.maximum(share, 1e-3)
    clear = np.median(costs, axis=0) - costs.min(axis=0)
    sure = (np.maximum(clear, 0.0) * (share > 0.1) + 1e-3) * share
    here = shift[:, ::STEP, ::STEP]
    agreed = np.zeros_like(here)
    for firm in FIRM:
        pull = firm * ((ways[:, :, None, None] - agreed) ** 2).sum(axis=1)
        best = ways[(costs + pull).argmin(axis=0)].transpose(2, 0, 1)
        agreed = np.array([smooth_field(field, sure, how.smooth) for field in here + best]) - here
    rows, columns = np.indices((ROWS, COLUMNS)) / STEP
    return np.array([looked_up(field, rows, columns) for field in here + agreed])


def _differences(seen: Picture, own: Picture, shift: Floats) -> Floats:
    """(ROWS, COLUMNS) how unlike the features are, with the template's shifted by whole pixels."""
    row, column = np.round(np.indices((ROWS, COLUMNS)) + shift[::-1]).astype(np.int64)
    inside = (row >= 0) & (row < ROWS) & (column >= 0) & (column < COLUMNS)
    row, column = np.clip(row, 0, ROWS - 1), np.clip(column, 0, COLUMNS - 1)
    unlike = ((seen.features[:, row, column] - own.features) ** 2).sum(axis=0)
    return np.where(inside & seen.known[row, column], np.minimum(unlike, MOST), MISSING)


def _patches(values: Floats) -> Floats:
    """Means over patches."""
    mean = gaussian_filter(values, PATCH, truncate=2.5, mode="constant")
    return np.asarray(mean[::STEP, ::STEP], dtype=np.float64)


def smooth_field(values: Floats, weight: Floats, blur: float) -> Floats:
    """A smooth field through weighted values: a quadratic and, unless `blur` is 0 pixels, what is left, blurred."""
    rows, columns = values.shape
    z, x = np.indices(values.shape)
    z, x = (z.ravel() - rows / 2) / rows, (x.ravel() - columns / 2) / columns
    basis = np.column_stack([np.ones_like(x), x, z, x * x, x * z, z * z])
    weights = weight.ravel()
    normal = basis.T @ (basis * weights[:, None])
    normal += 1e-3 * weights.sum() * np.diag([1e-6, 1e-6, 1e-6, CURVED, CURVED, CURVED])
    field = (basis @ np.linalg.solve(normal, basis.T @ (weights * values.ravel()))).reshape(values.shape)
    if blur > 0.0:
        share = gaussian_filter(weight, blur, mode="constant") + EMPTY * weight.mean()
        field = field + gaussian_filter(weight * (values - field), blur, mode="constant") / share
    return np.asarray(field, dtype=np.float64)


def _depths(seen: Picture, own: Picture, weight: Floats, shift: Floats) -> Floats:
    """(ROWS, COLUMNS) how much farther back each place's counterpart lies, metres; smooth past edges and holes."""
    row, column = np.indices((ROWS, COLUMNS)) + shift[::-1]
    farther = looked_up(seen.depth, row, column) - own.depth
    known = (weight > 0.0) & (looked_up(seen.known.astype(np.float64), row, column) > 0.5)
    core = known & (weight > 0.5)
    field: Floats = np.full(farther.shape, float(np.median(farther[core])) if core.any() else 0.0)
    for number, limit in enumerate(ASTRAY):
        kept = known & (np.abs(farther - field) < limit)
        last = number == len(ASTRAY) - 1
        field = smooth_field(np.where(kept, farther, 0.0), kept * weight + 1e-9, DEPTH_SMOOTH if last else 0.0)
    return field
