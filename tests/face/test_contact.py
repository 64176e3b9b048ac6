"""Lips and lids meet without passing through each other."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face
from risorius.face.contact import Contact, lip_share
from risorius.face.openings import Opening

HEADS = ("default", "ict", "makehuman")


def opened(positions: np.ndarray, opening: Opening) -> np.ndarray:
    """Height (100,) of the upper over the lower margin at even places from corner to corner, metres."""
    arcs = [positions[arc][np.argsort(positions[arc][:, 0])] for arc in (opening.upper, opening.lower)]
    places = np.linspace(max(a[0, 0] for a in arcs), min(a[-1, 0] for a in arcs), 102)[1:-1]
    upper, lower = (np.interp(places, arc[:, 0], arc[:, 1]) for arc in arcs)
    return np.asarray(upper - lower)


def skin_of(face: Face, positions: np.ndarray) -> np.ndarray:
    """The outer skin (n, 3) of posed vertices, in head space."""
    return np.asarray(face.anatomy.mesh.frame.to_head(positions)[face.anatomy.skin.index])


def overlap(face: Face, positions: np.ndarray, opening: Opening) -> float:
    """Deepest overlap of an opening's margins beyond that at rest, metres."""
    already = max(0.0, -float(opened(face.anatomy.skin.positions, opening).min()))
    return -float(opened(skin_of(face, positions), opening).min()) - already


@pytest.mark.parametrize("head", HEADS)
@pytest.mark.parametrize("word", ["anger:0", "anger:1", "grieving"])
def test_pressed_lips_do_not_pass_through_each_other(head: str, word: str, any_face: Callable[[str], Face]) -> None:
    """Without contact angry lips overlap by 3 to 4 mm."""
    face = any_face(head)
    name, _, variant = word.partition(":")
    profile = api.archetype(name, int(variant)) if variant else api.expression(word)
    pose = face.pose(profile.frame(), emotion=profile.weights)
    assert overlap(face, pose.positions, face.anatomy.skin.mouth) <= 0.2e-3


@pytest.mark.parametrize("head", HEADS)
def test_lids_that_are_asked_to_close_too_far_meet_along_their_whole_length(
    head: str, any_face: Callable[[str], Face]
) -> None:
    face = any_face(head)
    frame = np.full(68, np.nan)
    frame[18:20], frame[20:22] = 1024.0, 500.0
    positions = face.pose(frame).positions
    for opening in face.anatomy.skin.eyes.values():
        assert overlap(face, positions, opening) <= 0.2e-3
        assert opened(skin_of(face, positions), opening).max() <= 0.2e-3


def test_a_half_closed_eye_is_left_half_closed(face: Face) -> None:
    frame = np.full(68, np.nan)
    frame[18:20] = 400.0
    achieved = face.pose(frame).achieved
    assert achieved[[18, 19]] == pytest.approx(400.0, rel=0.1)


@pytest.mark.parametrize("head", HEADS)
def test_a_face_at_rest_is_in_no_contact(head: str, any_face: Callable[[str], Face]) -> None:
    """Overlap of the neutral lips is the head's own."""
    anatomy = any_face(head).anatomy
    still = np.zeros((anatomy.skin.vertex_count, 3))
    assert np.abs(Contact(anatomy.skin, anatomy.eyes).settle(still)).max() < 1e-9


def test_both_lips_give_way_alike_and_the_push_fades(face: Face) -> None:
    skin = face.anatomy.skin
    contact = Contact(skin, face.anatomy.eyes)
    pressed = np.zeros((skin.vertex_count, 3))
    upper, lower = skin.lip_distances
    near = np.clip(1.0 - np.minimum(upper, lower) / 0.02, 0.0, 1.0) * np.exp(-((skin.positions[:, 0] / 0.015) ** 2))
    pressed[:, 1] = np.where(upper < lower, -0.002, 0.002) * near
    push = contact.settle(pressed) - pressed
    middle = [arc[np.argmin(np.abs(skin.positions[arc, 0]))] for arc in (skin.mouth.upper, skin.mouth.lower)]
    assert push[middle[0], 1] == pytest.approx(-push[middle[1], 1], rel=0.05)
    assert push[middle[0], 1] > 1e-3
    assert np.abs(push[np.minimum(upper, lower) > 0.017]).max() < 1e-12
    rising = np.flatnonzero((upper < lower) & (np.abs(skin.positions[:, 0]) < 0.004) & (upper < 0.016))
    order = rising[np.argsort(upper[rising])]
    assert (np.diff(push[order, 1]) < 0.2e-3).all()


def test_a_lip_that_is_moved_pushes_the_other(face: Face) -> None:
    frame = np.full(68, np.nan)
    assert lip_share(frame) == 0.5
    frame[3] = 100.0
    assert lip_share(frame) < 0.1
    frame[4] = -100.0
    assert lip_share(frame) == 0.5
    raised = np.full(68, np.nan)
    raised[4] = 60.0
    pose = face.pose(raised)
    assert pose.achieved[4] == pytest.approx(60.0, rel=0.25)
    assert pose.achieved[3] < -5.0
    assert overlap(face, pose.positions, face.anatomy.skin.mouth) <= 0.2e-3


def test_exact_requests_outrank_contact(face: Face) -> None:
    """What is asked for exactly is met, even if it makes lids pass each other."""
    frame = np.full(68, np.nan)
    frame[18:20], frame[20:22] = 1024.0, 500.0
    achieved = face.pose(frame, drive="exact").achieved
    assert achieved[[18, 20]] == pytest.approx([1024.0, 500.0], rel=0.01)
