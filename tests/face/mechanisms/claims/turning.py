"""What turns as a body, and what meets."""

from __future__ import annotations

import numpy as np
from risorius.api import Face, Mechanism
from risorius.face.bodies.margins import crossing
from risorius.face.mechanisms.jaw import JawMotion

from .claim import MM, SILENT, Claim, posed, upper_margin


def chin_back(face: Face) -> float:
    """An open jaw: the chin goes back as it goes down, mm, for it turns about the ears."""
    return float(-posed(face, {3: 500.0}, "exact").at("2.10")[2])


def floor_of_the_mouth(face: Face) -> float:
    """An open jaw: how far the skin under the chin bulges beyond where mandible and neck take it, mm."""
    sheet, jaw = face.anatomy.skin, face.anatomy.jaw
    motion = JawMotion(angle=0.25)
    excess = jaw.skin(sheet.positions, motion) - jaw.weights[:, None] * jaw.rigid(sheet.positions, motion)
    return float((excess * sheet.normals).sum(axis=1).max() / MM)


def hollow_beside_the_mouth(face: Face) -> float:
    """A wide open jaw: how far the cheeks sink below where mandible and skull take them, along their normals, mm."""
    sheet, jaw = face.anatomy.skin, face.anatomy.jaw
    motion = JawMotion(angle=0.4)
    excess = jaw.skin(sheet.positions, motion) - jaw.weights[:, None] * jaw.rigid(sheet.positions, motion)
    return float(-(excess * sheet.normals).sum(axis=1).min() / MM)


def lid_as_one(face: Face) -> float:
    """A closing eye: drop of the least moved vertex of the lid's middle over that of the most moved."""
    moved = posed(face, {19: 550.0, 20: 550.0}, "exact")
    drop = -moved.skin[upper_margin(face, "l"), 1]
    return float(drop.min() / drop.max())


def lower_lid_to_the_nose(face: Face) -> float:
    """A closing upper lid: how far the middle of the lower one goes to the nose, mm."""
    moved, arc = posed(face, {19: 700.0, 20: 700.0}, "muscles"), face.anatomy.skin.eyes["l"].lower
    return float(-moved.skin[arc[len(arc) // 3 : -len(arc) // 3], 0].mean())


def lips_apart(face: Face) -> float:
    """Lips pushed into each other by contradictory FAPs: least height of the upper over the lower edge, mm."""
    moved, sheet = posed(face, {4: 250.0, 5: 250.0}, "natural"), face.anatomy.skin
    now, mouth = sheet.positions + moved.skin * MM, sheet.mouth
    heights = [crossing(positions, mouth.upper, mouth.lower) for positions in (now, sheet.positions)]
    return float((heights[0] - np.minimum(heights[1], 0.0)).min() / MM)


def middle_held(face: Face) -> float:
    """One corner drawn up and out, the other told to stay: the corner's motion aside over that of the lips' middle."""
    moved = posed(face, {6: 200.0, 7: 0.0, 12: 200.0, 13: 0.0, 53: 200.0, 54: 0.0, 59: 200.0, 60: 0.0}, "exact")
    return float(moved.at("2.4")[0] / max(np.abs([moved.at("2.2")[0], moved.at("2.3")[0]]).max(), 0.05))


def exactness(face: Face) -> float:
    """A cheek's and a brow's request: the share that is met, at the worse of the two."""
    frame = SILENT.copy()
    frame[[31 - 1, 41 - 1]] = 120.0, 60.0
    return float(np.min(face.pose(frame, drive="exact").achieved[[30, 40]] / frame[[30, 40]]))


CLAIMS = (
    Claim(Mechanism.JAW, chin_back, 5.0),
    Claim(Mechanism.FLOOR, floor_of_the_mouth, 2.0),
    Claim(Mechanism.HOLLOW, hollow_beside_the_mouth, 3.0),
    Claim(Mechanism.LIDS, lid_as_one, 0.5),
    Claim(Mechanism.LID_SLIDE, lower_lid_to_the_nose, 1.0),
    Claim(Mechanism.CONTACT, lips_apart, -0.2),
    Claim(Mechanism.LIP_MIDDLE, middle_held, 10.0),
    Claim(Mechanism.CORRECTION, exactness, 0.97),
)
