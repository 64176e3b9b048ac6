"""What each group of muscles is for."""

from __future__ import annotations

import numpy as np
import risorius.api as api
from risorius.api import Face, Mechanism

from .claim import Claim, contracted, place, posed, shown


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


CLAIMS = (
    Claim(Mechanism.BROW, frown_of_the_forehead, 1.2),
    Claim(Mechanism.CHEEK, raised_cheek, 12.0),
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
