"""The cage nodes that are computed, not measured: behind the lids, inside the mouth, up the nostrils.

They are hidden or nearly so; the numbers here are the construction's own, in metres.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...arrays import Floats
from .cage import EYE_RIM, MOUTH_RIM, NOSTRIL_RIM, grid_name, ring_name
from .figures import HeadFigures, MouthBagFigures

CARUNCLE = (0, 1, 15)  # ring indices that keep their own distance from the ball where it is larger
FOLD_ANGLE, FOLD_RISE = 0.33, 0.12  # which way the skin turns behind the lid

MOUTH_FLOOR_ARC = -112e-3
NOSTRIL_AXIS = np.array([0.05, 0.25, 1.0]) / np.linalg.norm([0.05, 0.25, 1.0])


def computed_nodes(figures: HeadFigures) -> dict[str, Floats]:
    """Positions (metres, left half) of the rings E1, E0, M0, B1, B2, BC, N1 and N2."""
    return _lid_rings(figures) | _mouth_rings(figures.nodes, figures.mouth_bag) | _nostril_rings(figures.nodes)


def _unit(v: Floats) -> Floats:
    """Unit vectors along the last axis."""
    return np.asarray(v / np.linalg.norm(v, axis=-1, keepdims=True), dtype=np.float64)


def _lid_rings(figures: HeadFigures) -> dict[str, Floats]:
    """E1, the inner edge of the lid margin, and E0, where the skin folds back behind the lid."""
    ball, margin = figures.eyeball, figures.lid_margin
    lash = np.array([figures.nodes[ring_name("eyeE2", k)] for k in range(len(EYE_RIM))])
    radial = lash - ball.centre
    distance = np.linalg.norm(radial, axis=1)
    out = radial / distance[:, None]
    toward = _unit(margin.opening - lash)
    toward = _unit(toward - np.sum(toward * out, axis=1)[:, None] * out)
    shift = np.full(len(lash), margin.shift)
    shift[0] = margin.canthus_shift
    thickness = np.clip(distance - ball.radius - margin.clearance, *margin.thickness)
    inner = lash - out * thickness[:, None] + toward * shift[:, None] - ball.centre
    reach = np.full(len(lash), ball.radius + margin.clearance)
    keep = list(CARUNCLE)
    reach[keep] = np.maximum(reach[keep], np.linalg.norm(inner[keep], axis=1))
    inner = _unit(inner) * reach[:, None]
    fold = _unit(_unit(inner) - FOLD_ANGLE * toward + np.array([0.0, FOLD_RISE, 0.0]))
    fold = fold * (ball.radius + margin.fold_clearance)
    rings = {ring_name("eyeE1", k): ball.centre + p for k, p in enumerate(inner)}
    return rings | {ring_name("eyeE0", k): ball.centre + p for k, p in enumerate(fold)}


def _mouth_rings(nodes: Mapping[str, Floats], bag: MouthBagFigures) -> dict[str, Floats]:
    """M0, the inner lip; B1 and B2, the bag round teeth and tongue; BC, its end wall."""
    rings: dict[str, Floats] = {}
    count = len(MOUTH_RIM)
    corner = count // 2
    for k in range(count):
        contact = nodes[ring_name("mouM1", k)]
        x, y, z = contact
        side = np.sign(corner - k)
        arch = 1.0 - 0.45 * (x / 25e-3) ** 2
        if k == corner:
            lip = contact + np.array([-0.4e-3, 3e-3, 0.0])
            bag1 = np.array([1.1 * x, y + 9e-3, z])
            bag2 = np.array([1.38 * x, bag.back, -34e-3])
        else:
            lip = contact + np.array([-0.05 * x, 3.5e-3, 1.5e-3 * side])
            bag1 = np.array([1.08 * x, y + 7e-3, z + 9e-3 * side * arch])
            bag2 = np.array([1.35 * x, bag.back + 0.15 * (y - MOUTH_FLOOR_ARC), -34e-3 + 17e-3 * side * arch])
        for ring, point in (("mouM0", lip), ("mouB1", bag1), ("mouB2", bag2)):
            rings[ring_name(ring, k)] = np.asarray(point, dtype=np.float64)
    for k in range(corner - 1):
        middle = 0.5 * (rings[ring_name("mouB2", k)] + rings[ring_name("mouB2", count - 1 - k)])
        rings[ring_name("mouBC", k)] = middle * np.array([bag.narrowing, 1.0, 1.0]) + np.array(
            [0.0, bag.throat - bag.back, 0.0]
        )
    return rings


def _nostril_rings(nodes: Mapping[str, Floats]) -> dict[str, Floats]:
    """N1 and N2: two steps up the nostril."""
    rim = np.array([nodes[grid_name(r, c)] for r, c in NOSTRIL_RIM])
    inward = rim.mean(axis=0) - rim
    rings: dict[str, Floats] = {}
    for ring, depth, narrowing in (("nosN1", 2.2e-3, 0.10), ("nosN2", 7e-3, 0.35)):
        points = rim + depth * NOSTRIL_AXIS + narrowing * inward
        rings |= {ring_name(ring, k): p for k, p in enumerate(points)}
    return rings
