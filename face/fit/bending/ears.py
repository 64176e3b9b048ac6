"""Where the ears are: their relief, seen from the side, is sought near where the face lets them be expected.

Ears lie far from everything that the face's front tells, so that the nearest surface is often the wrong part of the
ear, or the skull. Their relief is unlike anything round them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.ndimage import zoom

from ....arrays import Bools, Floats
from ...default_head.cage import Region
from ..surface.cloud import Surface, sample
from ..surface.depth_map import blurred
from ..template.template import FitTemplate
from .bend import Wishes
from .target import Target

PIXEL = 2.5e-3
#: Relief is what is finer than the second and coarser than the first blur, metres; it is clipped.
BLURS, CLIP = (3e-3, 15e-3), 8e-3
#: How far an ear may lie from where it is expected, metres, and how much larger or smaller it may be.
REACH, SIZES = 36e-3, (0.75, 0.85, 0.95, 1.05, 1.15, 1.3)
#: The ear's picture is wider than the ear by this, metres.
FRAME = 8e-3
#: Correlation of the reliefs from which a place is believed, and what a way of `REACH` takes off it.
BELIEVED, FAR = 0.7, 0.15
#: Points that the template's head is seen by.
POINTS = 60_000


@dataclass(frozen=True, eq=False)
class _SideView:
    """A head seen from one side: `relief` and `depth` (rows up, columns to the back) from the corner `low` (y, z)."""

    relief: Floats
    depth: Floats
    low: Floats


def ear_wishes(template: FitTemplate, target: Target, skin: Floats) -> list[Wishes]:
    """Where the ears' nodes shall go, for each ear that is found; `skin` (V, 3) is where the template's lies now."""
    seen = sample(Surface.from_polygons(skin, template.skin.quads), POINTS).positions
    wishes = []
    for side in (1.0, -1.0):
        ear = np.zeros(len(skin), dtype=bool)
        ear[template.skin.region_vertices(Region.EAR)] = True
        ear &= side * template.skin.vertices[:, 0] > 0.0
        wish = _ear_wish(template, target, skin, seen, ear, side)
        if wish is not None:
            wishes.append(wish)
    return wishes


def _ear_wish(
    template: FitTemplate, target: Target, skin: Floats, seen: Floats, ear: Bools, side: float
) -> Wishes | None:
    """One ear's wish, or None where no relief near by is like an ear's."""
    low, high = skin[ear].min(axis=0)[1:] - FRAME, skin[ear].max(axis=0)[1:] + FRAME
    model = _seen_from(side, seen, low, high)
    margin = REACH + 0.15 * (high - low)
    scene = _seen_from(side, target.outside.positions, low - margin, high + margin)
    places = [place for size in SIZES if (place := _best_place(model, scene, size)) is not None]
    if not places:
        return None
    agreement, size, corner, depth = max(places, key=lambda place: place[0])
    if agreement < BELIEVED:
        return None
    nodes = np.flatnonzero(ear[: len(template.skin.cage.names)])
    moved = skin[nodes].copy()
    moved[:, 1:] = corner + (moved[:, 1:] - low) * size
    moved[:, 0] -= side * depth
    return Wishes.of_nodes(template, nodes, moved)


def _seen_from(side: float, positions: Floats, low: Floats, high: Floats) -> _SideView:
    """What is seen from a side of a rectangle (y, z)."""
    columns, rows = np.ceil((high - low) / PIXEL).astype(int)
    pixel = np.floor((positions[:, 1:] - low) / PIXEL).astype(np.int64)
    inside = (pixel >= 0).all(axis=1) & (pixel < (columns, rows)).all(axis=1) & (side * positions[:, 0] > 0.0)
    nearest = np.full(rows * columns, np.inf)
    np.minimum.at(nearest, pixel[inside, 1] * columns + pixel[inside, 0], -side * positions[inside, 0])
    depth = nearest.reshape(rows, columns)
    known = np.isfinite(depth)
    fine, coarse = (blurred(depth, known, width / PIXEL) for width in BLURS)
    relief = np.where(known, np.clip(fine - coarse, -CLIP, CLIP), 0.0)
    return _SideView(relief, np.where(known, fine, np.nan), low)


def _best_place(model: _SideView, scene: _SideView, size: float) -> tuple[float, float, Floats, float] | None:
    """Agreement, size, corner (y, z) and added depth where a view of an ear at some size best agrees with a scene."""
    picture = zoom(model.relief, size, order=1)
    if (np.array(picture.shape) >= scene.relief.shape).any():
        return None
    windows = sliding_window_view(scene.relief, picture.shape)
    flat = windows.reshape(-1, picture.size)
    pattern = picture.ravel() - picture.mean()
    spread = np.sqrt(np.maximum((flat**2).mean(axis=1) - flat.mean(axis=1) ** 2, 1e-12))
    agreement = flat @ pattern / (picture.size * spread * max(float(pattern.std()), 1e-6))
    row, column = np.divmod(np.arange(len(flat)), windows.shape[1])
    corners = scene.low + PIXEL * np.column_stack([column, row])
    middle = np.array(model.relief.shape)[::-1] * PIXEL / 2.0
    way = np.linalg.norm(corners + size * middle - model.low - middle, axis=1)
    best = int((agreement - FAR * (way / REACH) ** 2).argmax())
    depth = sliding_window_view(scene.depth, picture.shape)[row[best], column[best]]
    added = depth - zoom(np.nan_to_num(model.depth, nan=float(np.nanmean(model.depth))), size, order=1)
    if np.isnan(added).mean() > 0.5:
        return None
    return float(agreement[best]), size, corners[best], float(np.nanmedian(added))
