"""Lips and lids meet without passing through each other."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face
from risorius.face.bodies.contact import lip_share
from risorius.face.bodies.surroundings import Surroundings
from risorius.face.mechanisms.jaw import JawMotion
from risorius.face.mesh.openings import Opening
from risorius.face.mesh.parts import Part
from risorius.physics.mesh import surface_samples, triangulate
from risorius.physics.skin import State
from scipy.spatial import cKDTree

HEADS = ("default", "ict", "makehuman")


def opened(positions: np.ndarray, opening: Opening) -> np.ndarray:
    """Height (100,) of the upper over the lower margin at even places from corner to corner, metres."""
    arcs = [positions[arc][np.argsort(positions[arc][:, 0])] for arc in (opening.upper, opening.lower)]
    places = np.linspace(max(a[0, 0] for a in arcs), min(a[-1, 0] for a in arcs), 102)[1:-1]
    upper, lower = (np.interp(places, arc[:, 0], arc[:, 1]) for arc in arcs)
    return np.asarray(upper - lower)


def skin_of(face: Face, positions: np.ndarray) -> np.ndarray:
    """The outer skin (n, 3) of posed vertices, in head space."""
    return np.asarray(face.anatomy.mesh.head_frame.to_head(positions)[face.anatomy.skin.index])


def overlap(face: Face, positions: np.ndarray, opening: Opening) -> float:
    """Deepest overlap of an opening's margins beyond that at rest, metres."""
    already = max(0.0, -float(opened(face.anatomy.skin.positions, opening).min()))
    return -float(opened(skin_of(face, positions), opening).min()) - already


_surfaces: dict[tuple[int, bytes], tuple[np.ndarray, cKDTree]] = {}


def seen(points: np.ndarray, centre: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distance (k,) and direction (k, 3) of points from a centre, or from an upright axis if its height is NaN."""
    upright = np.isnan(centre)
    away = np.where(upright, 0.0, points - centre)
    distance = np.linalg.norm(away, axis=1)
    return distance, away / distance[:, None] + np.where(upright, points / 0.03, 0.0)


def depth_in(face: Face, positions: np.ndarray, part: Part, near: np.ndarray, centre: np.ndarray) -> np.ndarray:
    """(k,) how far some outer skin lies behind a part's surface as seen from its centre or axis, metres.

    Minus infinity where nothing of the part is before it. Measured on the posed mesh itself, outermost surface first.
    """
    posed = face.anatomy.mesh.head_frame.to_head(positions)
    key = (int(part), posed[face.parts == part].tobytes())
    if key not in _surfaces:
        polygons = [p for p in face.polygons if (face.parts[p] == part).all()]
        reach, way = seen(surface_samples(posed[triangulate(polygons)], 0.3e-3), centre)
        _surfaces[key] = reach, cKDTree(way)
    reach, tree = _surfaces[key]
    distance, direction = seen(posed[face.anatomy.skin.index][near], centre)
    found, nearest = tree.query(direction, k=12, distance_upper_bound=0.02)
    before = np.where(np.isfinite(found), np.append(reach, -np.inf)[nearest], -np.inf)
    depth = before.max(axis=1) - distance
    return np.where(depth < 6e-3, depth, -np.inf)


def sunk(face: Face, positions: np.ndarray) -> tuple[float, float]:
    """Deepest that lid skin lies in the eyeballs, and lip skin in the teeth, beyond rest; metres."""
    anatomy, deepest = face.anatomy, []
    lids = []
    for side, part in (("l", Part.EYEBALL_L), ("r", Part.EYEBALL_R)):
        lids.append((part, np.min(anatomy.skin.lid_distances(side), axis=0), anatomy.eyes[side].centre))
    teeth = []
    for part in (Part.TEETH_UPPER, Part.TEETH_LOWER):
        row = anatomy.mesh.positions[face.parts == part]
        teeth.append((part, anatomy.skin.lip_edge_distance, np.array([0.0, np.nan, row[:, 2].min()])))
    for bodies, reach in ((lids, 4e-3), (teeth, 6e-3)):
        worst = 0.0
        for part, distance, centre in bodies:
            near = np.flatnonzero(distance < reach)
            rest = depth_in(face, face.vertices, part, near, centre)
            now = depth_in(face, positions, part, near, centre)
            worst = max(worst, float((now - np.maximum(rest, 0.0)).max()))
        deepest.append(worst)
    return deepest[0], deepest[1]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("word", "drive"), [("anger:4", "natural"), ("ecstatic", "exact"), ("ecstatic", "muscles"), ("joy:0", "natural")]
)
def test_lids_stay_out_of_the_eyeballs_and_lips_out_of_the_teeth(
    word: str, drive: str, any_face: Callable[[str], Face]
) -> None:
    """Without contact lids sink 0.9 mm into the scanned head's eyes, whose corneas stand out, and lips 1.1 mm."""
    face = any_face("ict")
    name, _, variant = word.partition(":")
    profile = api.archetype(name, int(variant)) if variant else api.expression(word)
    pose = face.pose(profile.frame(), drive=drive, emotion=profile.weights if drive == "natural" else None)
    eyes, teeth = sunk(face, pose.positions)
    assert eyes <= 0.1e-3
    assert teeth <= 0.2e-3


@pytest.mark.slow
def test_a_cornea_that_turns_under_a_closed_lid_lifts_it(any_face: Callable[[str], Face]) -> None:
    face = any_face("ict")
    closed = np.full(68, np.nan)
    closed[18:20] = 1024.0
    aside = closed.copy()
    aside[22:26] = 20000.0, 20000.0, 25000.0, 25000.0
    shapes = [face.pose(frame).positions for frame in (closed, aside)]
    lids = np.flatnonzero(np.min(face.anatomy.skin.lid_distances("l"), axis=0) < 6e-3)
    lifted = np.linalg.norm((shapes[1] - shapes[0])[face.anatomy.skin.index[lids]], axis=1)
    assert lifted.max() > 0.3e-3
    assert sunk(face, shapes[1])[0] <= 0.1e-3


def test_teeth_hold_lips_that_are_pressed_back_and_the_lower_ones_go_with_the_jaw(face: Face) -> None:
    anatomy, contact = face.anatomy, face.anatomy.contact
    skin = anatomy.skin
    near = np.clip(1.0 - skin.lip_edge_distance / 0.012, 0.0, 1.0)
    pressed = np.zeros((skin.vertex_count, 3))
    pressed[:, 2] = -0.015 * near
    rows = contact.bodies[-2:]
    assert max(row.depths(skin.positions + pressed, Surroundings())[0].max() for row in rows) > 2e-3
    settled = skin.positions + contact.settle(pressed)
    assert max(row.depths(settled, Surroundings())[0][row.firmness > 0.99].max() for row in rows) < 0.1e-3
    lower = rows[1]
    open_jaw = Surroundings(JawMotion(0.3))
    carried = anatomy.jaw.rigid(skin.positions + pressed, open_jaw.jaw) + pressed
    there, _ = lower.depths(skin.positions + carried, open_jaw)
    here, _ = lower.depths(skin.positions + pressed, Surroundings())
    np.testing.assert_allclose(there, here, atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("head", "word", "drive"),
    [("default", "disgust", "natural"), ("ict", "anger", "natural"), ("makehuman", "surprise", "exact")],
)
def test_contact_holds_in_every_frame_of_a_flash(
    head: str, word: str, drive: str, any_face: Callable[[str], Face]
) -> None:
    """Onset to offset in less than half a second; eyes that shut in passing are tested by a blink."""
    face, timing = any_face(head), api.load_timings()["flash"]
    cue = api.Cue(api.expression(word), onset=timing.onset, apex=timing.apex, offset=timing.offset)
    for positions in face.performance([cue], drive=drive):
        eyes, teeth = sunk(face, positions)
        assert eyes <= 0.1e-3
        assert teeth <= 0.2e-3
        assert overlap(face, positions, face.anatomy.skin.mouth) <= 0.2e-3


@pytest.mark.slow
def test_a_blink_closes_the_eyes_and_crosses_nothing(any_face: Callable[[str], Face]) -> None:
    face = any_face("ict")
    frames = np.full((9, 68), np.nan)
    frames[:, 18:20] = np.array([0.0, 512.0, 1024.0, 1024.0, 1024.0, 700.0, 200.0, 0.0, 0.0])[:, None]
    shapes = face.simulate(frames).positions
    for positions in shapes:
        assert sunk(face, positions)[0] <= 0.1e-3
        for opening in face.anatomy.skin.eyes.values():
            assert overlap(face, positions, opening) <= 0.2e-3
    for opening in face.anatomy.skin.eyes.values():
        assert opened(skin_of(face, shapes[4]), opening).max() <= 0.2e-3


def test_contact_takes_the_speed_of_what_it_stops_and_adds_none(face: Face) -> None:
    skin, contact = face.anatomy.skin, face.anatomy.contact
    upper, lower = skin.lip_distances
    way = np.zeros((skin.vertex_count, 3))
    way[:, 1] = np.where(upper < lower, -0.002, 0.002) * np.clip(1.0 - np.minimum(upper, lower) / 0.02, 0.0, 1.0)
    step = 0.02
    state = State(skin.positions + way, way / step)
    at_rest = contact.slack(np.zeros_like(way), Surroundings())
    held = contact.hold(state, 0.5, Surroundings(), at_rest, step)
    margins = contact.lips.depths(held.positions)
    assert max(float(depth.max()) for depth in margins) < 0.05e-3
    speed = np.linalg.norm(state.velocities, axis=1), np.linalg.norm(held.velocities, axis=1)
    assert (speed[1] <= speed[0] + 1e-12).all()
    middle = skin.mouth.upper[len(skin.mouth.upper) // 2]
    assert speed[1][middle] < 0.2 * speed[0][middle]
    apart = State(skin.positions, -way / step)
    assert contact.hold(apart, 0.5, Surroundings(), at_rest, step) is apart


@pytest.mark.slow
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


@pytest.mark.slow
def test_lids_that_close_evenly_are_drawn_together_evenly(face: Face) -> None:
    """A tracker's blink trembles about its end: lids that jump from ajar to shut would flicker."""
    asked = np.arange(760.0, 960.0, 25.0)
    closed = []
    for value in asked:
        frame = np.full(68, np.nan)
        frame[18:20] = value
        closed.append(face.pose(frame).achieved[[18, 20]].sum())
    assert np.diff(closed).min() > -5.0
    assert np.diff(closed).max() < 4.0 * 25.0
    assert closed[-1] > 1010.0


@pytest.mark.parametrize("head", HEADS)
def test_a_face_at_rest_is_in_no_contact(head: str, any_face: Callable[[str], Face]) -> None:
    """Overlap of the neutral lips is the head's own."""
    anatomy = any_face(head).anatomy
    still = np.zeros((anatomy.skin.vertex_count, 3))
    assert np.abs(anatomy.contact.settle(still)).max() < 1e-9


def test_both_lips_give_way_alike_and_the_push_fades(face: Face) -> None:
    skin = face.anatomy.skin
    contact = face.anatomy.contact
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


def test_a_raised_lip_pushes_the_other_one_by_muscles_alone_too(face: Face) -> None:
    """Most of the way that its muscles take it: with lips that share the way it comes half as far."""
    frame = np.full(68, np.nan)
    frame[np.array([5, 10, 11, 52, 57, 58]) - 1] = 400.0
    moved = face.pose(frame, drive="muscles").positions - face.vertices
    middles = (face.points[name] for name in ("2.2", "2.3"))
    upper, lower = (float((point.weights @ moved[point.vertices])[2]) for point in middles)
    assert upper == pytest.approx(lower, abs=1e-5)
    assert lower > 4e-3
