"""Units, the head's frame, and FAPs read off a face."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face
from risorius.face.default_head import HeadMesh
from risorius.face.mesh.head_frame import head_frame_of
from scipy.spatial.transform import Rotation

#: FAPs 1 and 2 are visemes and expressions: no feature point measures them.
NOT_MEASURED = {1, 2}


def test_the_frame_is_a_rotation_however_the_head_lies(head: HeadMesh) -> None:
    places = {name: head.vertices[point] if isinstance(point, int) else point for name, point in head.points.items()}
    upright = head_frame_of(places).axes
    for seed in range(300):
        turn = Rotation.random(random_state=seed).as_matrix()
        axes = head_frame_of({name: turn @ np.asarray(place) for name, place in places.items()}).axes
        np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(axes) > 0.0
        lies_askew = Rotation.from_matrix(axes @ turn @ upright.T).magnitude()
        assert lies_askew < np.radians(20.0), f"seed {seed}"


@pytest.mark.parametrize("name", ["ict", "makehuman", "mediapipe"])
def test_units_are_those_published_with_the_heads(
    shared_head: Callable[[str], object], shared_face: Callable[[str], Face], name: str
) -> None:
    units = shared_face(name).units
    for unit, millimetres in shared_head(name).fapu_mm.items():  # type: ignore[attr-defined]
        assert 1000 * getattr(units, unit.lower()) == pytest.approx(millimetres, abs=0.02), unit


def copy_of(head: HeadMesh, turn: Rotation, scale: float, shift: np.ndarray) -> Face:
    """The default head turned, scaled and moved."""

    def carry(places: np.ndarray) -> np.ndarray:
        return np.asarray(scale * turn.apply(places) + shift)

    points = {n: p if isinstance(p, int | np.integer) else carry(np.asarray(p)) for n, p in head.points.items()}
    return Face.from_arrays(carry(head.vertices), head.polygons, points, head.parts)


@pytest.mark.slow
@pytest.mark.parametrize("drive", ["natural", "exact"])
def test_a_face_lying_on_its_side_and_a_hundred_times_larger_is_the_same_face(head: HeadMesh, drive: str) -> None:
    """Two turned copies are compared: an upright face is measured along Blender's axes, not along its own points."""
    turns = Rotation.from_euler("xyz", [[40, -70, 120], [-100, 25, 60]], degrees=True)
    scales, shifts = (100.0, 1.0), np.array([[3.0, -200.0, 50.0], [0.1, 0.0, -2.0]])
    frame = api.archetype("joy", 1).frame()
    frame[[23 - 1, 43 - 1, 48 - 1]] = 5000.0, 200.0, 8000.0
    moved, achieved = [], []
    for turn, scale, shift in zip(turns, scales, shifts, strict=True):
        face = copy_of(head, turn, scale, shift)
        pose = face.pose(frame, drive=drive)
        moved.append(turn.inv().apply(pose.positions - face.vertices) / scale)
        achieved.append(pose.achieved)
    assert np.abs(moved[0]).max() > 5e-3
    np.testing.assert_allclose(moved[0], moved[1], atol=1e-6 * np.abs(moved[0]).max())
    np.testing.assert_allclose(achieved[0], achieved[1], rtol=1e-6, atol=1e-6)


def test_a_face_within_ten_degrees_of_upright_is_measured_along_blenders_axes(head: HeadMesh) -> None:
    for degrees, upright in ((8.0, True), (30.0, False)):
        face = copy_of(head, Rotation.from_euler("x", degrees, degrees=True), 1.0, np.zeros(3))
        snapped = np.allclose(face.anatomy.mesh.head_frame.axes, [[1, 0, 0], [0, 0, 1], [0, -1, 0]])
        assert snapped is upright, degrees


@pytest.mark.parametrize("name", ["default", "ict", "makehuman"])
def test_the_neutral_face_measures_nothing(any_face: Callable[[str], Face], name: str) -> None:
    face = any_face(name)
    frame = face.measure(face.vertices)
    silent = set(np.flatnonzero(np.isnan(frame)) + 1)
    # This eyeball of 72 vertices has none on its pupil but the pole: dilation shows on nothing.
    assert silent == NOT_MEASURED | ({29, 30} if name == "makehuman" else set())
    np.testing.assert_allclose(frame[~np.isnan(frame)], 0.0, atol=1e-6)
    np.testing.assert_allclose(face.features(face.vertices), 0.0, atol=1e-9)


def test_a_displacement_made_by_hand_is_measured_in_units_and_signs_of_the_standard(face: Face) -> None:
    positions = face.vertices.copy()
    chin, corner = face.points["2.1"], face.points["8.3"]
    positions[chin.vertices] += [0.0, 0.0, -0.006]
    positions[corner.vertices] += [0.004, 0.0, 0.003]
    frame = face.measure(positions)
    units = face.units
    assert frame[3 - 1] == pytest.approx(1024 * 0.006 / units.mns0, rel=1e-6)  # open_jaw: down
    assert frame[53 - 1] == pytest.approx(1024 * 0.004 / units.mw0, rel=1e-6)  # stretch_l_cornerlip_o: left
    assert frame[59 - 1] == pytest.approx(1024 * 0.003 / units.mns0, rel=1e-6)  # raise_l_cornerlip_o: up
    np.testing.assert_allclose(frame[[54 - 1, 60 - 1, 19 - 1]], 0.0, atol=1e-6)


def test_the_papers_features_are_distances(face: Face) -> None:
    positions = face.vertices.copy()
    corner = face.points["8.3"]
    width = np.linalg.norm(face.points["8.3"].position - face.points["8.4"].position)
    along = (face.points["8.3"].position - face.points["8.4"].position) / width
    positions[corner.vertices] += 0.005 * along
    values = face.features(positions)
    wider = [i for i, f in enumerate(api.FEATURES) if {f.point_a, f.point_b} == {"8.3", "8.4"}]
    assert wider
    for i in wider:
        assert abs(values[i]) == pytest.approx(1024 * 0.005 / face.units.mw0, rel=1e-6)


def test_eyes_tongue_and_head_do_what_they_are_asked_and_are_read_back(face: Face) -> None:
    rng = np.random.default_rng(5)
    angles, lengths = (23, 24, 25, 26, 48, 49, 50), (27, 28, 29, 30, 43, 44, 45, 46)
    for _ in range(3):
        frame = np.full(68, np.nan)
        for number in angles:
            frame[number - 1] = rng.uniform(-25000, 25000)
        for number in lengths:
            frame[number - 1] = rng.uniform(0, 150) if number == 46 else rng.uniform(-150, 150)
        achieved = face.pose(frame, drive="exact").achieved
        for number in (*angles, *lengths):
            assert achieved[number - 1] == pytest.approx(frame[number - 1], rel=1e-3, abs=0.5), number


def test_the_head_turns_as_a_whole_and_expression_is_read_through_its_turn(face: Face) -> None:
    frame = api.archetype("joy", 1).frame()
    still = face.pose(frame, drive="exact")
    frame[[48 - 1, 49 - 1]] = 15000.0, -20000.0
    turned = face.pose(frame, drive="exact")
    skull = face.anatomy.head_turn.skull
    assert np.median(np.linalg.norm((turned.positions - still.positions)[skull], axis=1)) > 1e-2
    same = np.setdiff1d(np.flatnonzero(~np.isnan(still.achieved)), [47, 48, 49])
    np.testing.assert_allclose(turned.achieved[same], still.achieved[same], atol=1.0)


def test_head_faps_turn_down_left_and_to_the_right_shoulder(face: Face) -> None:
    nose, crown = face.points["9.3"], int(np.argmax(face.vertices[:, 2]))

    def moved(number: int) -> tuple[np.ndarray, np.ndarray]:
        frame = np.full(68, np.nan)
        frame[number - 1] = 20000.0
        shift = face.pose(frame, drive="exact").positions - face.vertices
        return nose.weights @ shift[nose.vertices], shift[crown]

    assert moved(48)[0][2] < -5e-3  # pitch: the nose goes down
    assert moved(49)[0][0] > 5e-3  # yaw: to the subject's left
    assert moved(50)[1][0] < -5e-3  # roll: the crown to the subject's right
