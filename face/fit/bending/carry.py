"""Feature points carried from the fitted template to the mesh, and how sure each of them is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import cKDTree

from ....arrays import Floats
from ....physics.mesh import vertex_normals
from ...mesh.points import closest_on_triangles
from ..surface.cloud import Surface
from ..surface.margins import Margin
from ..template.template import FitTemplate
from .brow_lines import box_of_brows
from .confidence import confidences
from .fitted import Fit, ring_shares
from .modelled_brows import find_modelled_brows
from .painted_brows import Look, find_brows
from .proportions import read_brow_places, read_proportions
from .target import Target, feature

#: How much a disagreement of the normals counts when a point is dropped on the surface, metres per turn.
TURN = 5e-3
_SCALE = TURN / 10e-3  # `feature` counts a turn as 10 mm
#: Points of the surface tried for each.
NEAREST = 8
#: The nose tip is the middle of this share of the foremost points within reach, metres.
TIP_SHARE, TIP_REACH = 0.1, 7e-3
#: Where the middles of both lids lie between an eye's right corner and its left one.
LID_MIDDLE = {"eye_l": 0.46, "eye_r": 0.54}
#: How sure the points of brows are that show: some 2 mm off.
SHOWN = 0.85

#: Feature points on the lid margins and where the lips meet: ring, and edge or side of the corner.
RIM_POINTS: Mapping[str, tuple[str, str]] = {
    "3.7": ("eye_l", "left"), "3.11": ("eye_l", "right"), "3.1": ("eye_l", "upper"), "3.3": ("eye_l", "lower"),
    "3.12": ("eye_r", "right"), "3.8": ("eye_r", "left"), "3.2": ("eye_r", "upper"), "3.4": ("eye_r", "lower"),
    "2.4": ("mouth", "left"), "2.5": ("mouth", "right"),
    "2.2": ("mouth", "upper"), "2.6": ("mouth", "upper"), "2.7": ("mouth", "upper"),
    "2.3": ("mouth", "lower"), "2.8": ("mouth", "lower"), "2.9": ("mouth", "lower"),
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Carried:
    """Feature points in template coordinates: positions (3,), and confidences in [0, 1]."""

    positions: Mapping[str, Floats]
    confidence: Mapping[str, float]


def carry(
    template: FitTemplate, target: Target, fit: Fit, score: float, pieces: Surface, look: Look | None = None
) -> Carried:
    """The template's feature points on the head that it was bent onto.

    Parameters
    ----------
    score : the face's score; poor faces make every point doubtful.
    pieces : the head and what lies on it, in template coordinates.
    look : how bright the face is painted; None: it is not.
    """
    fit = replace(fit, margins={ring: margin for ring, margin in fit.margins.items() if _is_sound(ring, margin)})
    fitted = template.read(fit.skin)
    drop = _Drop(template, target, fit)
    places = {name: drop.nearest(name, place) for name, place in zip(template.names, fitted, strict=True)}
    places |= _on_rims(template, fit)
    places |= _lids_in_order(places, drop)
    places["9.3"] = _foremost(target, places["9.3"])
    places |= _by_proportions(template, fit, places, drop)
    shown = find_modelled_brows(pieces, target.outside.positions, places)
    if not shown and look is not None:
        shown = find_brows(*look(*box_of_brows(places)), places)
    brows = _on_skin(shown, places, drop)
    places |= brows
    sure = confidences(template, target, fit.skin, fit.margins, places, RIM_POINTS, score)
    return Carried(places, sure | dict.fromkeys(brows, SHOWN))


class _Drop:
    """Drops points on the head's surface: on what is seen and faces the way that the template's points do."""

    def __init__(self, template: FitTemplate, target: Target, fit: Fit) -> None:
        facing = template.read(vertex_normals(fit.skin, template.skin.quads))
        facing /= np.maximum(np.linalg.norm(facing, axis=1), 1e-30)[:, None]
        self._facing = dict(zip(template.names, facing, strict=True))
        self._surface, self._points = target.surface, target.outside
        self._tree = cKDTree(feature(self._points.positions, self._points.normals * _SCALE))

    def nearest(self, name: str, place: Floats) -> Floats:
        """(3,) where the surface is nearest to the place (3,) of a feature point."""
        _, near = self._tree.query(feature(place, self._facing[name] * _SCALE), k=NEAREST)
        corners = self._surface.vertices[self._surface.triangles[np.unique(self._points.triangles[near])]]
        weights, distance = closest_on_triangles(place, corners)
        best = int(distance.argmin())
        return np.asarray(weights[best] @ corners[best])


def _by_proportions(template: FitTemplate, fit: Fit, places: Mapping[str, Floats], drop: _Drop) -> dict[str, Floats]:
    """Points on smooth skin, drawn to where the face's proportions tell, as seen in the picture."""
    known, moved = dict(places), {}
    brows = read_brow_places()
    for proportion in (*read_proportions(), *brows):
        picture = list(proportion.view.value)
        for left in (True, False):
            name, origin = (k if left else template.twins.get(k, k) for k in (proportion.point, proportion.origin))
            if name in RIM_POINTS:
                if _has_rim(name, fit):  # which tells more
                    continue
            elif origin in RIM_POINTS and not _has_rim(origin, fit) and proportion not in brows:
                continue
            aim = proportion.place(known, template.twins, left=left)
            place = drop.nearest(name, aim)
            place[picture] = aim[picture]
            known[name] = moved[name] = drop.nearest(name, place)
    return moved


def _on_skin(shown: Mapping[str, Floats], places: Mapping[str, Floats], drop: _Drop) -> dict[str, Floats]:
    """The points of brows that show on the face, from their places (x, z) in the picture."""
    found = {}
    for name, (x, z) in shown.items():
        place = drop.nearest(name, np.array([x, places[name][1], z]))
        found[name] = drop.nearest(name, np.array([x, place[1], z]))
    return found


def _has_rim(name: str, fit: Fit) -> bool:
    """Whether the rim of the opening that a point lies on was found."""
    return RIM_POINTS[name][0] in fit.margins


def _on_rims(template: FitTemplate, fit: Fit) -> dict[str, Floats]:
    """The points of lids and lips, on the rims that were found: a point never leaves its own lid or lip."""
    places: dict[str, Floats] = {}
    for name, (ring, where) in RIM_POINTS.items():
        margin = fit.margins.get(ring)
        if margin is None or name not in template.names:
            continue
        if where in ("left", "right"):
            places[name] = margin.corner(1.0 if where == "left" else -1.0)
        else:
            places[name] = margin.at(where, _rim_share(template, name, ring))[0]
    return places


def _is_sound(ring: str, margin: Margin) -> bool:
    """Whether the upper lid lies above the lower one: not where a rim runs round twice, as on noisy skin."""
    if ring not in LID_MIDDLE:
        return True
    middle = np.array([LID_MIDDLE[ring]])
    return bool(margin.at("upper", middle)[0][2] > margin.at("lower", middle)[0][2])


def _lids_in_order(places: Mapping[str, Floats], drop: _Drop) -> dict[str, Floats]:
    """Middles of lids whose upper one lies below the lower one: the mirror image of the other eye's, or exchanged."""
    mended: dict[str, Floats] = {}
    pairs = (("3.1", "3.3"), ("3.2", "3.4"))
    for (upper, lower), twins in zip(pairs, pairs[::-1], strict=True):
        if places[upper][2] > places[lower][2]:
            continue
        if places[twins[0]][2] > places[twins[1]][2]:
            flip = np.array([-1.0, 1.0, 1.0])
            mended |= {
                name: drop.nearest(name, flip * places[twin]) for name, twin in zip((upper, lower), twins, strict=True)
            }
        else:
            mended |= {upper: places[lower], lower: places[upper]}
    return mended


def _rim_share(template: FitTemplate, name: str, ring: str) -> Floats:
    """(1,) how far a point of an edge lies from the right corner to the left one."""
    if ring in LID_MIDDLE:
        return np.array([LID_MIDDLE[ring]])
    return ring_shares(template, template.rings[ring], template.read(template.skin.vertices, [name]))


def _foremost(target: Target, tip: Floats) -> Floats:
    """The middle of the foremost points round the nose tip."""
    points = target.outside.positions[target.front]
    near = points[np.linalg.norm(points - tip, axis=1) < TIP_REACH]
    if len(near) == 0:
        return tip
    foremost = near[near[:, 1] <= np.quantile(near[:, 1], TIP_SHARE)]
    middle = foremost.mean(axis=0)
    return np.asarray(near[np.linalg.norm(near - middle, axis=1).argmin()])
