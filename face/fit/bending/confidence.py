"""How sure found points are: the error to be expected of each, by its usual error and what is unusual about it here."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from scipy.spatial import cKDTree

from ....arrays import Bools, Floats
from ....resources import PRESETS
from ....tables import read_csv
from ..surface.cloud import nearest
from ..surface.margins import Margin
from ..template.template import FitTemplate
from .target import RIM, Target

ERRORS_FILE = PRESETS / "anatomy" / "point_errors.csv"
#: An expected error of this size halves the confidence, metres. It is the usual error of points that have none listed.
HALF_ERROR = 5e-3
#: The expected error, mm: `BASE` times the usual error to this power, times e to the power of all that follows. They
#: were fitted by least squares to the logarithms of the errors on the heads of docs/fit.md, without the reserved ones,
#: and on two scans with landmarks.
BASE, POWER = 0.8, 0.74
#: Corners, and other points, of eyes and mouths whose rim was not found; points of the skin beside such a mouth.
NO_RIM = {("eye", "corner"): 0.53, ("eye", "edge"): 0.71, ("mouth", "corner"): 1.2, ("mouth", "edge"): 1.13}
BESIDE_NO_MOUTH = 1.06
#: Within reach of the edge of the mesh; a unit of the face's score; where the skin that was bent lies e times farther
#: off the head than a millimetre round the point, in root mean square within so many metres, of at most so many.
AT_EDGE, PER_SCORE, PER_GAP = 0.18, 0.5, 0.24
GAP_REACH, LARGEST_GAP = 12e-3, 10e-3


def confidences(
    template: FitTemplate,
    target: Target,
    skin: Floats,
    margins: Mapping[str, Margin],
    places: Mapping[str, Floats],
    rim_points: Mapping[str, tuple[str, str]],
    score: float,
) -> dict[str, float]:
    """Feature point -> how sure it is, 0 .. 1; at a half its error is expected to be 5 mm.

    Parameters
    ----------
    skin : (V, 3) the template's skin as it was bent.
    margins : the rims of the openings that were found.
    places : name -> (3,) the points, template coordinates.
    rim_points : which of them lie on rims: ring, and edge or side of the corner.
    score : the face's score.
    """
    usual = usual_errors()
    names = template.names
    gaps = _gaps(template, target, skin, template.read(skin))
    edges = _near(np.array([places[name] for name in names]), target.rim)
    sure = {}
    for name, gap, edge in zip(names, gaps, edges, strict=True):
        doubt = AT_EDGE * edge + PER_SCORE * score + PER_GAP * np.log1p(1e3 * gap)
        doubt += _rim_doubt(name, margins, rim_points)
        expected = BASE * (1e3 * usual.get(name, HALF_ERROR)) ** POWER * np.exp(doubt)
        sure[name] = float(1.0 / (1.0 + (expected / (1e3 * HALF_ERROR)) ** 2))
    return sure


def _rim_doubt(name: str, margins: Mapping[str, Margin], rim_points: Mapping[str, tuple[str, str]]) -> float:
    """What a rim that was not found adds to the doubt of a point."""
    if name not in rim_points:
        return BESIDE_NO_MOUTH if name.startswith("8.") and "mouth" not in margins else 0.0
    ring, where = rim_points[name]
    if ring in margins:
        return 0.0
    return NO_RIM[ring.partition("_")[0], "corner" if where in ("left", "right") else "edge"]


def _gaps(template: FitTemplate, target: Target, skin: Floats, places: Floats) -> Floats:
    """(P,) how far the bent skin lies off the head round places (P, 3): root mean square, metres."""
    visible = skin[template.exterior]
    distance, _ = nearest(cKDTree(target.outside.positions), visible)
    square = np.minimum(distance, LARGEST_GAP) ** 2
    around = cKDTree(visible).query_ball_point(places, GAP_REACH)
    return np.array([np.sqrt(square[near].mean()) if near else LARGEST_GAP for near in around])


def _near(places: Floats, rim: Floats) -> Bools:
    """(P,) which places (P, 3) lie at the edge of the mesh."""
    if len(rim) == 0:
        return np.zeros(len(places), dtype=bool)
    return np.asarray(nearest(cKDTree(rim), places)[0] < RIM, dtype=np.bool_)


@lru_cache(maxsize=1)
def usual_errors() -> Mapping[str, float]:
    """Feature point -> its median error in metres over the heads that the finding was measured on (docs/fit.md)."""
    return {row.text("point"): 1e-3 * row.number("median_mm", above=0.0) for row in read_csv(ERRORS_FILE)}
