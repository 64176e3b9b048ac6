"""What each mechanism is for: one measured claim that holds with it and does not hold without it.

Every claim is one figure of a posed face with a limit. The same measurement is made on the face with the mechanism left
out, where it must miss the limit: a claim that would hold anyway cannot stand here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face, Mechanism
from risorius.face.assembly import Assembly
from risorius.face.bodies.margins import crossing
from risorius.face.mechanisms.jaw import JawMotion
from risorius.face.muscles.insertion import force_density
from risorius.face.response.pulls import pulls_of

SILENT = np.full(68, np.nan)
MM = 1e-3


@dataclass(frozen=True)
class Moved:
    """A posed face: displacement of its outer skin (n, 3) in head space, mm, and of a place on it."""

    face: Face
    skin: np.ndarray

    def at(self, place: str | np.ndarray) -> np.ndarray:
        """Displacement (3,) of a feature point, or of the skin nearest to a place (3,) in head space, metres."""
        sheet = self.face.anatomy.skin
        target = sheet.points[place] if isinstance(place, str) else place
        return self.skin[np.argmin(np.linalg.norm(sheet.positions - target, axis=1))]


def shown(face: Face, positions: np.ndarray) -> Moved:
    """How far positions (V, 3) are from rest."""
    mesh = face.anatomy.mesh
    moved = mesh.head_frame.to_head(positions) - mesh.positions
    return Moved(face, moved[face.anatomy.skin.index] / MM)


def posed(face: Face, faps: Mapping[int, float], drive: str = "muscles") -> Moved:
    """The face posed from some FAPs."""
    frame = SILENT.copy()
    for number, value in faps.items():
        frame[number - 1] = value
    return shown(face, face.pose(frame, drive=drive).positions)


def contracted(face: Face, *prefixes: str) -> Moved:
    """The low-strain response to every muscle whose name begins so, at its amplitude; a face may have none of them."""
    anatomy = face.anatomy
    chosen = [muscle for name, muscle in face.muscles.items() if name.startswith(prefixes)]
    pulls = pulls_of(anatomy.skin, anatomy.sheet, chosen)
    amounts = [muscle.amplitude / MM for muscle in pulls.muscles]
    return Moved(face, np.tensordot(amounts, pulls.fields, axes=1))


def pulled(face: Face, *points: str) -> Moved:
    """What shows when the skin alone is pulled upwards at some feature points."""
    sheet, load = face.anatomy.skin, np.zeros((1, face.anatomy.skin.vertex_count, 3))
    for point in points:
        load[0, np.argmin(np.linalg.norm(sheet.positions - sheet.points[point], axis=1)), 1] = 1.0
    return Moved(face, face.anatomy.sheet.point_responses(load)[0])


def place(face: Face, point: str, x: float, y: float, z: float) -> np.ndarray:
    """A place (3,) in head space so many mm from a feature point."""
    return face.anatomy.skin.points[point] + np.array([x, y, z]) * MM


def upper_margin(face: Face, side: str) -> np.ndarray:
    """The middle half of an upper lid's edge."""
    arc = face.anatomy.skin.eyes[side].upper
    return arc[len(arc) // 4 : -len(arc) // 4]


# ---- the skin -----------------------------------------------------------------------------------------------------


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


# ---- how muscles pull ---------------------------------------------------------------------------------------------


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


# ---- what turns and meets -----------------------------------------------------------------------------------------


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


# ---- groups of muscles --------------------------------------------------------------------------------------------


def frown_of_the_forehead(face: Face) -> float:
    """Brows drawn together by FAPs 37 and 38: the skin above the brow's middle goes along, mm towards the middle."""
    return float(-posed(face, {37: 60.0, 38: 60.0}, "exact").at(place(face, "4.3", 0.0, 14.0, 2.0))[0])


def raised_cheek(face: Face) -> float:
    """Cheeks lifted by FAPs 41 and 42: rise under the eye over that of the mouth's corner, of which nothing is said."""
    moved = posed(face, {41: 150.0, 42: 150.0})
    return float(moved.at(place(face, "3.3", 2.0, -14.0, -2.0))[1] / moved.at("8.3")[1])


def blown_cheek(face: Face) -> float:
    """Cheeks puffed by FAPs 39 and 40: swelling of the pouch along its normal, mm."""
    moved, sheet = posed(face, {39: 150.0, 40: 150.0}), face.anatomy.skin
    nearest = np.argmin(np.linalg.norm(sheet.positions - place(face, "5.1", 0.0, -10.0, -6.0), axis=1))
    return float(moved.skin[nearest] @ sheet.normals[nearest])


def disgusted_nose(face: Face) -> float:
    """Disgust, whose FAPs name no wrinkled nose: rise of the skin 14 mm above the nostril's wing, mm."""
    profile = api.archetype("disgust", 0)
    pose = face.pose(profile.frame(), emotion=profile.weights)
    return float(shown(face, pose.positions).at(place(face, "9.1", 0.0, 14.0, -6.0))[1])


def wrinkled_nose(face: Face) -> float:
    """The muscles of AU 9 by hand: rise of the wing, mm."""
    return float(contracted(face, "llsan").at("9.1")[1])


def lowered_lower_lip(face: Face) -> float:
    """FAPs 5, 10 and 11 by muscles: fall of the lower lip, mm."""
    return float(-posed(face, {5: -250.0, 10: -250.0, 11: -250.0}).at("2.3")[1])


def smile(face: Face) -> float:
    """Corners up and out by muscles: rise of the left one, mm."""
    return float(posed(face, {6: 150.0, 7: 150.0, 12: 250.0, 13: 250.0}).at("8.3")[1])


def sulk(face: Face) -> float:
    """Corners down by muscles: fall of the left one, mm."""
    return float(-posed(face, {12: -200.0, 13: -200.0}).at("8.3")[1])


def dimple(face: Face) -> float:
    """The muscle of AU 14 by hand: the corner goes back, mm."""
    return float(-contracted(face, "buccinator").at("8.3")[2])


def mouth_aside(face: Face) -> float:
    """The mouth drawn to the left by muscles: the lips' middle goes along, mm."""
    return float(posed(face, {6: 120.0, 7: -120.0, 53: 120.0, 54: -120.0}).at("2.2")[0])


def balled_chin(face: Face) -> float:
    """The chin's boss raised by FAP 18 with a raised lip: it rises, mm."""
    return float(posed(face, {5: 150.0, 18: 100.0}).at("2.10")[1])


def pucker(face: Face) -> float:
    """Lips pushed forward and the mouth narrowed by muscles: both lips' middles forward, mm."""
    moved = posed(face, {6: -150.0, 7: -150.0, 16: -150.0, 17: -150.0, 53: -150.0, 54: -150.0})
    return float(min(moved.at("8.1")[2], moved.at("8.2")[2]))


def funnel(face: Face) -> float:
    """Lips turned out by the marginal fibres: the upper lip's edge goes forward and up, mm of the lesser."""
    moved = contracted(face, "oris_upper_evert", "oris_lower_evert")
    return float(min(moved.at("8.1")[2], moved.at("8.1")[1], moved.at("8.2")[2], -moved.at("8.2")[1]))


def press(face: Face) -> float:
    """Lips pressed by FAPs 4, 5 with their sides: the red of the upper lip is drawn down towards the lower one, mm."""
    moved = posed(face, {4: 60.0, 8: 60.0, 9: 60.0, 51: 120.0, 55: 120.0, 56: 120.0})
    return float(-moved.at("8.1")[1])


def tightened_neck(face: Face) -> float:
    """The platysma by hand: the skin of the jaw line goes down and back, mm of the lesser."""
    moved = contracted(face, "platysma").at(place(face, "2.11", 22.0, 2.0, -24.0))
    return float(min(-moved[1], -moved[2]))


def corner_down_and_back(face: Face) -> float:
    """The platysma by hand: the mouth's corner goes down and back, mm of the lesser."""
    moved = contracted(face, "platysma").at("8.3")
    return float(min(-moved[1], -moved[2]))


@dataclass(frozen=True)
class Claim:
    """What a mechanism is for: a figure that is above a limit with it, and below without it; on one of the heads."""

    mechanism: Mechanism
    figure: Callable[[Face], float]
    limit: float
    head: str = "default"


CLAIMS = (
    Claim(Mechanism.BENDING, spread_of_a_pull, 0.3),
    Claim(Mechanism.FIRMNESS, scalp_at_rest, 16.0),
    Claim(Mechanism.SLIDING, along_the_bone, 2.0),
    Claim(Mechanism.BULGE, heap_of_a_squeeze, 0.8),
    Claim(Mechanism.BIPHASIC, gain_lost_when_stretched, 1.05),
    Claim(Mechanism.FOLDS, fold_beside_the_nose, 0.85, "ict"),
    Claim(Mechanism.SEPARATION, own_lip_alone, 5.0),
    Claim(Mechanism.FADING, evenness_of_the_ring, 1.7),
    Claim(Mechanism.SUPERFICIAL, along_its_skin, 10.0),
    Claim(Mechanism.FLAT_PULLS, pushed_up_lip, 0.3),
    Claim(Mechanism.SCALP, hairline_down, 1.0),
    Claim(Mechanism.JAW, chin_back, 5.0),
    Claim(Mechanism.FLOOR, floor_of_the_mouth, 2.0),
    Claim(Mechanism.HOLLOW, hollow_beside_the_mouth, 3.0),
    Claim(Mechanism.LIDS, lid_as_one, 0.5),
    Claim(Mechanism.LID_SLIDE, lower_lid_to_the_nose, 1.0),
    Claim(Mechanism.CONTACT, lips_apart, -0.2),
    Claim(Mechanism.LIP_MIDDLE, middle_held, 10.0),
    Claim(Mechanism.CORRECTION, exactness, 0.97),
    Claim(Mechanism.BROW, frown_of_the_forehead, 1.2),
    Claim(Mechanism.CHEEK, raised_cheek, 8.0),
    Claim(Mechanism.CHEEK, blown_cheek, 2.0),
    Claim(Mechanism.NOSE, disgusted_nose, 3.0),
    Claim(Mechanism.NOSE, wrinkled_nose, 2.0),
    Claim(Mechanism.LIPS, lowered_lower_lip, 4.0),
    Claim(Mechanism.CORNERS, smile, 3.0),
    Claim(Mechanism.CORNERS, sulk, 2.2),
    Claim(Mechanism.BUCCINATOR, dimple, 4.0),
    Claim(Mechanism.BUCCINATOR, mouth_aside, 3.5),
    Claim(Mechanism.CHIN, balled_chin, 0.7),
    Claim(Mechanism.ORBICULARIS_ORIS, pucker, 0.5),
    Claim(Mechanism.ORBICULARIS_ORIS, funnel, 1.0),
    Claim(Mechanism.ORBICULARIS_ORIS, press, 0.6),
    Claim(Mechanism.PLATYSMA, tightened_neck, 2.0),
    Claim(Mechanism.PLATYSMA, corner_down_and_back, 2.0),
)


@pytest.fixture(scope="module")
def less(any_face: Callable[[str], Face]) -> Callable[[str, Mechanism], Face]:
    """A head without a mechanism, prepared once."""

    @cache
    def build(head: str, mechanism: Mechanism) -> Face:
        return any_face(head).without(mechanism)

    return build


@pytest.mark.parametrize(
    "claim",
    [pytest.param(claim, marks=() if claim.head == "default" else pytest.mark.slow) for claim in CLAIMS],
    ids=lambda claim: f"{claim.mechanism}-{claim.figure.__name__}",
)
def test_it_holds_with_the_mechanism_and_not_without(
    claim: Claim, any_face: Callable[[str], Face], less: Callable[[str, Mechanism], Face]
) -> None:
    assert claim.figure(any_face(claim.head)) > claim.limit
    assert not claim.figure(less(claim.head, claim.mechanism)) > claim.limit


def test_every_mechanism_has_a_claim() -> None:
    assert {claim.mechanism for claim in CLAIMS} == set(Mechanism)
