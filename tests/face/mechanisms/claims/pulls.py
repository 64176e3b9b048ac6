"""How muscles pull: on whose skin, how evenly, and where to."""

from __future__ import annotations

import numpy as np
from risorius.api import Face, Mechanism
from risorius.face.muscles.insertion import force_density

from .claim import MM, Claim, contracted, place, posed


def own_lip_alone(face: Face) -> float:
    """The ring muscle of the lower lip: its pull on the lower lip's edge over that on the upper one's."""
    sheet = face.anatomy.skin
    pull = np.linalg.norm(force_density(sheet, face.muscles["oris_lower_outer_l"]), axis=1)
    edges = (arc[np.abs(sheet.positions[arc, 0]) < 8 * MM] for arc in (sheet.mouth.lower, sheet.mouth.upper))
    lower, upper = (pull[edge].mean() for edge in edges)
    return float(lower / max(upper, 1e-3 * pull.max()))


def evenness_of_the_ring(face: Face) -> float:
    """Peak of a sphincter's pull over its largest jump from one vertex to the next."""
    sheet, muscle = face.anatomy.skin, face.muscles["oris_upper_outer_l"]
    pull = force_density(sheet, muscle)
    ends = sheet.graph.tocoo()
    jump = np.linalg.norm(pull[ends.row] - pull[ends.col], axis=1)
    return float(np.linalg.norm(pull, axis=1).max() / jump.max())


def along_its_skin(face: Face) -> float:
    """The risorius lies in the skin of the cheek: its pull along the skin over its pull into it."""
    sheet = face.anatomy.skin
    pull = force_density(sheet, face.muscles["risorius_l"])
    into = (pull * sheet.normals).sum(axis=1)
    along = np.linalg.norm(pull - into[:, None] * sheet.normals, axis=1)
    return float(along.sum() / max(np.abs(into).sum(), 1e-3 * along.sum()))


def pushed_up_lip(face: Face) -> float:
    """Pad of the chin pushed forward by FAPs 5 and 18, mm."""
    return float(posed(face, {5: 150.0, 10: 120.0, 11: 120.0, 18: 100.0}).at("2.10")[2])


def hairline_down(face: Face) -> float:
    """Raised brows: descent of the scalp 45 mm above the brow, mm."""
    moved = contracted(face, "frontalis")
    return float(-moved.at(place(face, "4.1", 8.0, 52.0, -14.0))[1])


CLAIMS = (
    Claim(Mechanism.SEPARATION, own_lip_alone, 5.0),
    Claim(Mechanism.FADING, evenness_of_the_ring, 1.7),
    Claim(Mechanism.SUPERFICIAL, along_its_skin, 10.0),
    Claim(Mechanism.FLAT_PULLS, pushed_up_lip, 0.3),
    Claim(Mechanism.SCALP, hairline_down, 1.0),
)
