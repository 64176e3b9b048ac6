"""What the skin does beyond the second paper's membrane."""

from __future__ import annotations

import numpy as np
from risorius.api import Face, Mechanism
from risorius.face.assembly import Assembly

from .claim import MM, SILENT, Claim, contracted, place, posed, pulled, shown


def spread_of_a_pull(face: Face) -> float:
    """A point pulled alone takes the skin 8 mm off along: share of its own motion."""
    moved = pulled(face, "8.3")
    return float(moved.at(place(face, "8.3", 8.0, 0.0, -4.0))[1] / moved.at("8.3")[1])


def scalp_at_rest(face: Face) -> float:
    """Brows raised by the skin alone: how much more the brow moves than the forehead 30 mm above it."""
    moved = pulled(face, "4.1", "4.3", "4.5")
    return float(moved.at("4.3")[1] / moved.at(place(face, "4.3", 0.0, 30.0, -4.0))[1])


def along_the_bone(face: Face) -> float:
    """The forehead pulled along the bone and off it: how much more it gives way along it."""
    skin, sheet = face.anatomy.skin, face.anatomy.sheet
    spot = np.argmin(np.linalg.norm(skin.positions - place(face, "4.1", 0.0, 18.0, 0.0), axis=1))
    normal = skin.normals[spot]
    along = np.cross(normal, [1.0, 0.0, 0.0])
    loads = np.zeros((2, skin.vertex_count, 3))
    loads[:, spot] = along / np.linalg.norm(along), normal
    given = [response[spot] @ load[spot] for response, load in zip(sheet.point_responses(loads), loads, strict=True)]
    return float(given[0] / given[1])


def heap_of_a_squeeze(face: Face) -> float:
    """Corrugators drawn together: how far the skin between them heaps up, mm."""
    moved, sheet = contracted(face, "corrugator"), face.anatomy.skin
    middle = place(face, "4.1", 0.0, 4.0, 0.0) * np.array([0.0, 1.0, 1.0])
    spot = np.linalg.norm(sheet.positions - middle, axis=1) < 9 * MM
    return float((moved.skin * sheet.normals).sum(axis=1)[spot].mean())


def shelf_over_the_eye(face: Face) -> float:
    """Lowered brows: how far the skin half way between lid and brow comes down, over the brow's own way."""
    moved = posed(face, {31: -80.0, 32: -80.0, 33: -130.0, 34: -130.0})
    lid, brow = (face.anatomy.skin.points[name] for name in ("3.1", "4.3"))
    return float(moved.at((lid + brow) / 2.0)[1] / moved.at("4.3")[1])


def heap_beside_the_wing(face: Face) -> float:
    """A nose wrinkled and a lip raised by their muscles: how far skin comes forward above the nasolabial fold, mm."""
    moved = contracted(face, "llsan_wing", "llsan_lip", "levator_labii_superioris")
    above, below = place(face, "9.1", 6.0, 5.0, -7.0), place(face, "9.1", 8.0, -10.0, -4.0)
    return float(moved.at(above)[2] - moved.at(below)[2])


def gain_lost_when_stretched(face: Face) -> float:
    """Corners drawn up and back: motion per contraction at a tenth of the amplitude over that at all of it."""
    names = [name for name in face.muscles if name.startswith(("zygomaticus", "risorius"))]
    moved = [
        shown(face, face.pose(SILENT, drive="muscles", contractions=dict.fromkeys(names, share)).positions).skin / share
        for share in (0.1, 1.0)
    ]
    weak, strong = (np.linalg.norm(way, axis=1).max() for way in moved)
    return float(weak / strong)


def fold_beside_the_nose(face: Face) -> float:
    """A smile: how much of the nasolabial fold's full profile shows in the skin's heights."""
    corners = {6: 250.0, 7: 250.0, 12: 400.0, 13: 400.0, 53: 250.0, 54: 250.0, 59: 400.0, 60: 400.0}
    moved, sheet = posed(face, corners, "natural"), face.anatomy.skin
    fold = next(fold for fold in Assembly(face.anatomy).folds.placed if fold.row.name == "nasolabial_l")
    profile = sheet.areas * np.asarray(fold.field.sum(axis=1)).ravel()
    height = (moved.skin * MM * sheet.normals).sum(axis=1)
    return float(profile @ height / (profile @ np.asarray(fold.field.sum(axis=1)).ravel()))


CLAIMS = (
    Claim(Mechanism.BENDING, spread_of_a_pull, 0.3),
    Claim(Mechanism.FIRMNESS, scalp_at_rest, 16.0),
    Claim(Mechanism.SLIDING, along_the_bone, 2.0),
    Claim(Mechanism.BULGE, heap_of_a_squeeze, 0.8),
    Claim(Mechanism.HOOD, shelf_over_the_eye, 0.9),
    Claim(Mechanism.BULGE, heap_beside_the_wing, 3.0),
    Claim(Mechanism.BIPHASIC, gain_lost_when_stretched, 1.05),
    Claim(Mechanism.FOLDS, fold_beside_the_nose, 1.2, "ict"),
)
