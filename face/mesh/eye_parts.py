"""Telling eyeballs in a mesh: balls of any size behind the lids, flat eyes, and what lies in or on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Floats, Ints
from ...physics.mesh import fans
from ...polygons import PolygonTable
from ..figures import Length, Pair, Share, read_figures
from .mouth_parts import loose_pieces
from .parts import Part
from .sphere import fit_sphere


@dataclass(frozen=True)
class EyeballFigures:
    """What an eyeball may be (presets/anatomy/parts.toml)."""

    reach: float
    slack: Length
    radius: Pair
    roundness: Share
    centred: Share
    depth: Share
    within: float
    shell: float
    strip: Share


@dataclass(frozen=True)
class FlatEyeFigures:
    """What an eye that is a plate may be (presets/anatomy/parts.toml)."""

    before: Length
    behind: Length
    width: float
    spread: Share
    covered: float


EYEBALL = read_figures("parts.eyeball", EyeballFigures)
FLAT_EYE = read_figures("parts.flat_eye", FlatEyeFigures)

#: Part -> feature points: inner and outer corner, middle of the upper and of the lower lid.
EYES = {Part.EYEBALL_L: ("3.11", "3.7", "3.1", "3.3"), Part.EYEBALL_R: ("3.8", "3.12", "3.2", "3.4")}


def ball_of(piece: Floats, corners: Floats) -> tuple[Floats, float] | None:
    """Centre (3,) and radius of the ball that a piece (k, 3) is, with the lids on it; None where it is none.

    `corners` (2, 3) are the eye's; head space, metres.
    """
    centre, radius = fit_sphere(piece)
    if not EYEBALL.radius[0] < radius < EYEBALL.radius[1]:
        return None
    if np.linalg.norm(centre - corners.mean(axis=0)) > EYEBALL.reach * radius + EYEBALL.slack:
        return None
    off = np.abs(np.linalg.norm(piece - centre, axis=1) - radius)
    is_round = np.median(off) < EYEBALL.roundness * radius
    is_whole = np.linalg.norm(piece.mean(axis=0) - centre) < EYEBALL.centred * radius
    thin = np.linalg.svd(piece - piece.mean(axis=0), full_matrices=False)[2][2]
    is_deep = np.ptp(piece @ thin) > EYEBALL.depth * radius
    return (centre, radius) if is_round and is_whole and is_deep else None


def is_flat(eye: Floats) -> bool:
    """Whether an eye's vertices (k, 3) are too flat to turn as a ball; head space, metres."""
    return fit_sphere(eye)[1] > EYEBALL.radius[1]


def add_eyes(
    parts: Ints, labels: Ints, positions: Floats, polygons: PolygonTable, points: Mapping[str, Floats]
) -> None:
    """Give pieces of `Part.OTHER` that are eyeballs, flat eyes, or lie in or on one, to their eye, in place.

    Parameters
    ----------
    parts : (V,) numbers of `Part`. labels : (V,) number of each vertex's connected piece.
    positions : (V, 3) head space, metres.
    points : feature point -> (3,) in head space.
    """
    members = loose_pieces(parts, labels)
    for part, names in EYES.items():
        lids = np.array([points[name] for name in names])
        own = [member for member in members if ball_of(positions[member], lids[:2]) is not None]
        if own:
            ball = fit_sphere(positions[np.concatenate(own)])
            own += [member for member in members if _lies_in(positions[member], ball, lids)]
        else:
            own = _plates(members, labels, positions, polygons, lids)
        for member in own:
            parts[member] = int(part)


def _lies_in(piece: Floats, ball: tuple[Floats, float], lids: Floats) -> bool:
    """Whether a piece (k, 3) lies wholly in or on a ball, as iris and cornea do; lashes on it reach along the lid."""
    centre, radius = ball
    farthest = float(np.linalg.norm(piece - centre, axis=1).max())
    if farthest > EYEBALL.within * radius:
        return False
    return farthest <= radius or float(np.ptp(piece[:, 0])) < EYEBALL.strip * _width(lids)


def _width(lids: Floats) -> float:
    """Distance of the corners, the first two of (4, 3)."""
    return float(np.linalg.norm(lids[1] - lids[0]))


def _plates(
    members: Sequence[Ints], labels: Ints, positions: Floats, polygons: PolygonTable, lids: Floats
) -> list[Ints]:
    """Pieces that fill the lids' opening (4, 3) as seen from the front, and those that lie on them there."""
    places = between(lids)
    near = [member for member in members if _fits(positions[member], lids)]
    pieces = [polygons.kept(polygons.within(labels == labels[member[0]])) for member in near]
    covered = [covers(positions, piece, places) for piece in pieces]
    if not any(each.sum() >= FLAT_EYE.covered for each in covered):
        return []
    return [member for member, each in zip(near, covered, strict=True) if each[0]]


def between(lids: Floats) -> Floats:
    """(5, 3) places between lids (4, 3) that an eye covers as seen from the front, the middle first."""
    middle = lids.mean(axis=0)
    return np.concatenate([[middle], middle + FLAT_EYE.spread * (lids - middle)])


def _fits(piece: Floats, lids: Floats) -> bool:
    """Whether a piece (k, 3) is no wider than a flat eye may be, and lies where one does."""
    middle = lids.mean(axis=0)
    away = piece.mean(axis=0) - middle
    width = FLAT_EYE.width * _width(lids)
    beside = np.abs(piece[:, :2] - middle[:2]).max() < width
    return bool(beside and -FLAT_EYE.behind < away[2] < FLAT_EYE.before)


def covers(positions: Floats, polygons: PolygonTable, places: Floats) -> Bools:
    """(n,) which of some places (n, 3) polygons cover, as seen from the front."""
    corners = positions[fans(polygons)[0]][:, :, :2]
    edges = np.roll(corners, -1, axis=1) - corners
    away = places[:, None, None, :2] - corners
    side = edges[None, :, :, 0] * away[..., 1] - edges[None, :, :, 1] * away[..., 0]
    inside = np.asarray((side >= 0.0).all(axis=2) | (side <= 0.0).all(axis=2))
    return np.asarray(inside.any(axis=1))
