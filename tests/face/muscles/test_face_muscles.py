"""Muscles on a face: which there are, where they pull and where not; jaw, lids, contractions by hand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from risorius import api
from risorius.api import Face, Part
from risorius.face.bodies.contact import AT_REST
from risorius.face.bodies.eyeball_surface import EyeballSurface
from risorius.face.mechanisms.lid_movers import LidMove
from risorius.face.muscles import insertion
from risorius.face.muscles.insertion import force_density
from risorius.face.muscles.kinds import KINDS
from risorius.face.muscles.row import Region
from risorius.face.skin.outer import OuterSkin
from scipy.spatial.transform import Rotation

#: The kinds of muscle of the second paper's line and of every FACS table; the parts a name begins with.
EXPECTED = (
    "frontalis_med", "frontalis_lat", "corrugator", "procerus", "orb_oculi", "levator_labii_superioris", "llsan",
    "zygomaticus_major", "zygomaticus_minor", "risorius", "depressor_anguli_oris", "depressor_labii", "mentalis",
    "oris",
)  # fmt: skip

SILENT = np.full(68, np.nan)
FACES = ("default", "ict", "makehuman")


def fields_of(face: Face) -> np.ndarray:
    """(k, n) size of what each muscle shows on the outer skin, metres per metre of amount."""
    return np.asarray(np.linalg.norm(face.anatomy.actuators.fields, axis=2))


def middle_third(face: Face, arc: np.ndarray) -> np.ndarray:
    """The vertices of a lip's edge in the middle third of the mouth."""
    skin = face.anatomy.skin
    return arc[np.abs(skin.positions[arc, 0]) < skin.points["8.3"][0] / 3.0]


def test_every_kind_of_muscle_is_there_on_both_sides(face: Face) -> None:
    for kind in EXPECTED:
        for side in "lr":
            assert any(name.startswith(kind) and name.endswith(f"_{side}") for name in face.muscles), (kind, side)
    assert {m.row.kind for m in face.muscles.values()} == set(KINDS)
    assert all(name == muscle.name for name, muscle in face.muscles.items())


def test_muscles_of_a_pair_lie_on_their_own_sides(face: Face) -> None:
    for name, muscle in face.muscles.items():
        ends = [getattr(muscle.row, p) for p in ("attachment", "insertion", "centre") if hasattr(muscle.row, p)]
        assert ends, name
        assert muscle.side == (1 if name.endswith("_l") else -1), name
        if muscle.row.sides == "pair":
            assert muscle.side * np.mean([p.reshape(-1, 3)[:, 0].mean() for p in ends]) > 0.0, name


@pytest.mark.parametrize("name", FACES)
def test_an_amount_is_the_largest_displacement_that_its_muscle_makes(
    any_face: Callable[[str], Face], name: str
) -> None:
    face = any_face(name)
    fields = face.anatomy.actuators.fields
    assert np.isfinite(fields).all()
    assert len(fields) == len(face.muscles)  # no muscle of the table misses the skin
    np.testing.assert_allclose(fields_of(face).max(axis=1), 1.0, rtol=1e-9)


@pytest.mark.parametrize("name", FACES)
def test_no_muscle_pulls_on_the_back_of_the_head(any_face: Callable[[str], Face], name: str) -> None:
    face = any_face(name)
    skin = face.anatomy.skin
    behind, ears = skin.positions[:, 2] < -0.13, skin.positions[:, 2] < -0.106
    assert behind.any()
    assert fields_of(face)[:, behind].max() < 0.01
    for muscle in face.anatomy.muscles:
        assert not force_density(skin, muscle)[ears].any(), muscle.name


@pytest.mark.parametrize("name", FACES)
def test_a_muscle_of_one_lip_leaves_the_other_lips_edge_alone(any_face: Callable[[str], Face], name: str) -> None:
    """The lips nearly touch: through the air each would pull the other as much as itself."""
    face = any_face(name)
    skin, fields = face.anatomy.skin, fields_of(face)
    upper, lower = middle_third(face, skin.mouth.upper), middle_third(face, skin.mouth.lower)
    assert np.linalg.norm(skin.positions[upper].mean(axis=0) - skin.positions[lower].mean(axis=0)) < 3e-3
    tried = 0
    for muscle, field in zip(face.anatomy.actuators.muscles, fields, strict=True):
        if muscle.row.region not in (Region.UPPER, Region.LOWER):
            continue
        own, other = (lower, upper) if muscle.row.region is Region.LOWER else (upper, lower)
        if field[own].mean() > 0.2:
            tried += 1
            assert field[other].mean() < 0.25 * field[own].mean(), muscle.name
    assert tried >= 10
    named = {m.name: f for m, f in zip(face.anatomy.actuators.muscles, fields, strict=True)}
    assert named["depressor_labii_l"][upper].mean() < 0.05


@pytest.mark.parametrize("name", FACES)
def test_a_lids_mover_leaves_the_other_lid_alone(any_face: Callable[[str], Face], name: str) -> None:
    face = any_face(name)
    skin, fields = face.anatomy.skin, fields_of(face)
    raisers = {m.name: f for m, f in zip(face.anatomy.actuators.muscles, fields, strict=True)}
    for side in "lr":
        opening = skin.eyes[side]
        upper, lower = (arc[1 + len(arc) // 4 : -len(arc) // 4] for arc in (opening.upper, opening.lower))
        weights = face.anatomy.eyes[side].weights
        for move in (LidMove.UPPER_CLOSE, LidMove.UPPER_OPEN):
            assert weights[move][upper].min() > 0.8
            assert weights[move][lower].max() < 0.01
        for move in (LidMove.LOWER_UP, LidMove.LOWER_DOWN):
            assert weights[move][lower].min() > 0.8
            assert weights[move][upper].max() < 0.01
        cheek, brow = raisers[f"orb_oculi_orbital_inf_{side}"], raisers[f"corrugator_{side}"]
        assert cheek[upper].mean() < 0.25 * cheek[lower].mean()
        assert brow[lower].mean() < 0.15 * brow[upper].mean()


def test_the_two_sides_mirror_each_other(face: Face) -> None:
    """The default head is symmetric; so are its muscles, whatever order its polygons have."""
    skin, muscles = face.anatomy.skin, face.anatomy.actuators.muscles
    fields = face.anatomy.actuators.fields
    at = {tuple(np.round(p * [-1, 1, 1], 6) + 0.0): i for i, p in enumerate(skin.positions)}
    twin = np.array([at[tuple(np.round(p, 6) + 0.0)] for p in skin.positions])
    named = {m.name: i for i, m in enumerate(muscles)}
    for name, left in named.items():
        if name.endswith("_l"):
            right = fields[named[name[:-1] + "r"]][twin] * [-1, 1, 1]
            assert np.abs(fields[left] - right).max() < 1e-4, name


@pytest.mark.parametrize("name", FACES)
@pytest.mark.parametrize("drive", ["natural", "exact"])
def test_an_open_jaw_turns_the_lower_teeth_and_drops_the_chin_back(
    any_face: Callable[[str], Face], name: str, drive: str
) -> None:
    face = any_face(name)
    frame = SILENT.copy()
    frame[3 - 1] = 600.0
    pose = face.pose(frame, drive=drive)
    moved = face.anatomy.mesh.head_frame.to_head(pose.positions) - face.anatomy.mesh.positions
    teeth = face.anatomy.mesh.positions[face.parts == Part.TEETH_LOWER]
    now = teeth + moved[face.parts == Part.TEETH_LOWER]
    turn, _ = Rotation.align_vectors(now - now.mean(axis=0), teeth - teeth.mean(axis=0))
    np.testing.assert_allclose(turn.apply(teeth - teeth.mean(axis=0)), now - now.mean(axis=0), atol=1e-9)
    assert 5.0 < np.degrees(turn.as_rotvec()[0]) < 20.0
    assert np.abs(moved[face.parts == Part.TEETH_UPPER]).max() < 1e-9
    chin = face.points["2.10"]
    down, back = (float(chin.weights @ moved[chin.vertices][:, axis]) for axis in (1, 2))
    assert down < -5e-3
    assert back < -5e-3
    weights = face.anatomy.jaw.weights
    assert weights.min() >= 0.0
    assert weights.max() <= 1.0
    assert pose.contractions["jaw_open"] > 0.1


def test_the_jaw_slides_to_the_subjects_right_and_forward(face: Face) -> None:
    """The bone, with the lower teeth, and not the chin's skin alone."""
    teeth = face.parts == Part.TEETH_LOWER
    for number, axis, sign in ((15, 0, -1.0), (14, 1, -1.0)):
        frame = SILENT.copy()
        frame[number - 1] = 150.0
        moved = face.pose(frame, drive="exact").positions - face.vertices
        assert (sign * moved[teeth][:, axis]).min() > 1.5e-3, number


@pytest.mark.parametrize("name", FACES)
@pytest.mark.parametrize("drive", ["natural", "exact"])
def test_closing_lids_stay_outside_the_eyeball(any_face: Callable[[str], Face], name: str, drive: str) -> None:
    face = any_face(name)
    frame = SILENT.copy()
    frame[[19 - 1, 20 - 1]], frame[[21 - 1, 22 - 1]] = 612.0, 412.0  # 1024 together: the whole gap
    pose = face.pose(frame, drive=drive)
    skin = face.anatomy.skin
    now = face.anatomy.mesh.head_frame.to_head(pose.positions)[skin.index]
    for side in "lr":
        eye, margin = face.anatomy.eyes[side], skin.eyes[side].upper
        rest, closed = (np.linalg.norm(p[margin] - eye.centre, axis=1) for p in (skin.positions, now))
        # Where a mesh's lid lies inside the fitted ball from the start, it need not leave it.
        assert (closed >= np.minimum(rest, eye.radius) - 0.3e-3).all()
        drop = (skin.positions - now)[margin, 1].max()
        assert drop > 0.4 * face.units.irisd0 / face.anatomy.mesh.head_frame.scale


def test_skin_pushed_into_the_eyeball_is_lifted_off_it_and_other_skin_is_not(face: Face) -> None:
    contact, skin = face.anatomy.contact, face.anatomy.skin
    (ball,) = (
        body for body in contact.bodies if isinstance(body, EyeballSurface) and skin.positions[body.index, 0].mean() > 0
    )
    pushed = 0.2 * (face.anatomy.eyes["l"].centre - skin.positions)
    firm = ball.firmness == 1.0
    sunk, cleared = (ball.depths(skin.positions + way, AT_REST)[0] for way in (pushed, contact.clear(pushed)))
    assert sunk[firm].max() > 1e-3
    assert cleared[firm].max() < 0.1e-3
    others = np.setdiff1d(np.arange(skin.vertex_count), np.concatenate([body.index for body in contact.bodies]))
    np.testing.assert_allclose(contact.clear(pushed)[others], pushed[others], atol=1e-12)


def test_contractions_set_by_hand_move_what_they_name(face: Face) -> None:
    still = face.pose(SILENT, drive="muscles")
    np.testing.assert_allclose(still.positions, face.vertices, atol=1e-9)
    by_hand = {"zygomaticus_major_l": 0.5, "orbicularis_oculi_upper_r": 1.0, "jaw_open": 0.25}
    pose = face.pose(SILENT, drive="muscles", contractions=by_hand)
    for name, value in by_hand.items():
        assert pose.contractions[name] == pytest.approx(value)
    assert sum(v > 0.0 for v in pose.contractions.values()) == len(by_hand)
    assert pose.achieved[12 - 1] - pose.achieved[13 - 1] > 50  # left lip corner up
    assert pose.achieved[20 - 1] > 500 > 50 > abs(pose.achieved[19 - 1])  # right lid closed
    assert pose.achieved[3 - 1] > 200  # jaw down


def test_contractions_scale_from_nothing_to_the_amplitude(face: Face) -> None:
    """The amplitude is the low-strain response; the biphasic skin gives more at first and less when stretched far."""
    name = "frontalis_lat_r"
    muscle = face.muscles[name]
    actuators, scale = face.anatomy.actuators, face.anatomy.mesh.head_frame.scale
    number = [placed.name for placed in actuators.muscles].index(name)
    gains = []
    for share in (0.25, 1.0):
        solution = np.zeros(actuators.count)
        solution[number] = share * muscle.amplitude
        linear = np.linalg.norm(actuators.low_strain(actuators.amounts(solution)), axis=1).max()
        assert linear == pytest.approx(share * muscle.amplitude, rel=1e-6)
        moved = face.pose(SILENT, drive="muscles", contractions={name: share}).positions - face.vertices
        gains.append(np.linalg.norm(moved[face.anatomy.skin.index], axis=1).max() / scale / linear)
    assert 1.0 < gains[0] < 1.3
    assert 0.7 < gains[1] < gains[0]


@pytest.mark.parametrize("drive", ["muscles", "points"])
def test_the_simpler_drives_smile_too(face: Face, drive: str) -> None:
    frame = SILENT.copy()
    frame[[12 - 1, 13 - 1]] = 200.0
    pose = face.pose(frame, drive=drive)
    if drive == "points":
        assert not any(pose.contractions.values())
        np.testing.assert_allclose(pose.achieved[[11, 12]], 200.0, rtol=1e-3)
    else:
        assert pose.contractions["zygomaticus_major_l"] > 0.05
        assert (pose.achieved[[11, 12]] > 100.0).all()


def test_insertions_are_worked_out_once_for_each_region_and_half(monkeypatch: pytest.MonkeyPatch) -> None:
    face, made = api.default_face(), list[tuple[Region, int]]()
    skin = replace(face.anatomy.skin, _cache={})
    whole = insertion.insertion

    def counted(skin: OuterSkin, region: Region, side: int = 0) -> Any:
        made.append((region, side))
        return whole(skin, region, side)

    monkeypatch.setattr(insertion, "insertion", counted)
    for muscle in face.anatomy.muscles:
        force_density(skin, muscle)
    assert len(made) == len(set(made)) < len(face.anatomy.muscles) / 3
