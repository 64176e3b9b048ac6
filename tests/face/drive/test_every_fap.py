"""Every low-level FAP moves what the standard says it moves, on every head that has the part, as far as it is asked to.

Displacements are read off the mesh anew here: the feature point's vertices, the standard's direction, the unit's size.
Eyes, pupils, tongue and head are read by what a person would look at: the ball's turn, the disc's width, the crown.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face
from risorius.mpeg4 import Unit
from scipy.spatial.transform import Rotation

HEADS = ("default", "ict", "makehuman")
LOW_LEVEL = range(3, 69)

#: 100 units of a length; 0.1 rad of an angle.
ASKED = {True: 10000.0, False: 100.0}

#: FAPs that a head cannot show, with the reason.
CANNOT = {
    ("makehuman", 29): "its eyeball of 72 vertices has none on the pupil's edge",
    ("makehuman", 30): "its eyeball of 72 vertices has none on the pupil's edge",
}
UNIT_LENGTH = {Unit.IRISD: "irisd0", Unit.ES: "es0", Unit.ENS: "ens0", Unit.MNS: "mns0", Unit.MW: "mw0"}


def cases() -> list[tuple[str, int, float]]:
    """Head, FAP and request: positive, and negative where the standard means both directions."""
    return [
        (head, number, sign * ASKED[api.FAPS[number].angular])
        for head in HEADS
        for number in LOW_LEVEL
        for sign in ((1.0, -1.0) if api.FAPS[number].bidirectional else (1.0,))
    ]


def shown(face: Face, number: int, positions: np.ndarray) -> float:
    """How much of a FAP deformed vertices (V, 3) show, in its units; Blender's axes, face towards -y."""
    fap = api.FAPS[number]
    if number in (48, 49, 50):
        return head_turn(face, number, positions)
    if number in (23, 24, 25, 26):
        return eye_turn(face, number, positions)
    if number in (29, 30):
        return pupil_growth(face, number, positions)
    if number == 47:
        return tongue_roll(face, positions)
    assert fap.feature_point is not None
    assert fap.unit is not None
    length = getattr(face.units, UNIT_LENGTH[fap.unit]) / 1024.0
    if number in (27, 28):
        ball = face.parts == (api.Part.EYEBALL_L if number == 27 else api.Part.EYEBALL_R)
        return float(-(positions - face.vertices)[ball, 1].mean()) / length
    point = face.points[fap.feature_point]
    moved = point.weights @ (positions - face.vertices)[point.vertices]
    assert fap.motion is not None
    assert fap.motion.direction is not None
    return float(moved @ np.array(fap.motion.direction)) / length


def turn_of(before: np.ndarray, after: np.ndarray) -> Rotation:
    turn, _ = Rotation.align_vectors(after - after.mean(axis=0), before - before.mean(axis=0))
    return turn


def eye_turn(face: Face, number: int, positions: np.ndarray) -> float:
    """Where a ball that looked along -y looks now: to the subject's left (+x) or down (-z)."""
    ball = face.parts == (api.Part.EYEBALL_L if number in (23, 25) else api.Part.EYEBALL_R)
    x, y, z = turn_of(face.vertices[ball], positions[ball]).apply([0.0, -1.0, 0.0])
    return float(np.arctan2(x if number < 25 else -z, -y)) / 1e-5


def head_turn(face: Face, number: int, positions: np.ndarray) -> float:
    """Where the nose points now (down, to the left), or the crown (to the right)."""
    skull = face.vertices[:, 2] > face.points["4.3"].position[2] + 0.05
    turn = turn_of(face.vertices[skull], positions[skull])
    nose, crown = turn.apply([0.0, -1.0, 0.0]), turn.apply([0.0, 0.0, 1.0])
    across, along = {48: (-nose[2], -nose[1]), 49: (nose[0], -nose[1]), 50: (-crown[0], crown[2])}[number]
    return float(np.arctan2(across, along)) / 1e-5


def pupil_growth(face: Face, number: int, positions: np.ndarray) -> float:
    """Change of the width of the pupil's disc: a third of the neutral iris, which is as wide as IRISD0."""
    name, part = {29: ("3.5", api.Part.EYEBALL_L), 30: ("3.6", api.Part.EYEBALL_R)}[number]
    ball, middle = face.parts == part, face.points[name].position
    away = np.linalg.norm((face.vertices[ball] - middle)[:, [0, 2]], axis=1)
    front = face.vertices[ball][:, 1] < face.vertices[ball][:, 1].mean()
    neutral = face.units.irisd0 / 3.0
    disc = front & (away < 0.51 * neutral) & (away > 0.02 * neutral)
    assert disc.any()
    now = np.linalg.norm((positions[ball] - middle)[:, [0, 2]], axis=1)
    return float((now[disc] / away[disc]).mean() - 1.0) * neutral / (face.units.irisd0 / 1024.0)


def tongue_roll(face: Face, positions: np.ndarray) -> float:
    """Angle by which the borders rose about the tongue's middle."""
    now, rest = (
        {name: (p := face.points[name]).weights @ places[p.vertices] for name in ("6.2", "6.3", "6.4")}
        for places in (positions, face.vertices)
    )
    angles = []
    for border in ("6.3", "6.4"):
        rise = (now[border] - now["6.2"])[2] - (rest[border] - rest["6.2"])[2]
        angles.append(np.arcsin(rise / abs(rest[border] - rest["6.2"])[0]))
    return float(np.mean(angles)) / 1e-5


@pytest.mark.parametrize(("name", "number", "asked"), cases())
def test_a_fap_asked_for_exactly_is_shown(
    any_face: Callable[[str], Face], name: str, number: int, asked: float
) -> None:
    if (name, number) in CANNOT:
        pytest.skip(CANNOT[name, number])
    face = any_face(name)
    frame = np.full(68, np.nan)
    frame[number - 1] = asked
    pose = face.pose(frame, drive="exact")
    assert shown(face, number, pose.positions) == pytest.approx(asked, rel=0.05)
    assert pose.achieved[number - 1] == pytest.approx(asked, rel=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("name", HEADS)
def test_heads_of_plain_meshes_have_the_organs_too(any_face: Callable[[str], Face], name: str) -> None:
    """Parts derived from nothing but mesh and feature points: no FAP is lost for want of labels."""
    labelled = any_face(name)
    points = {n: p.position for n, p in labelled.points.items()}
    plain = Face.from_arrays(labelled.vertices, labelled.polygons, points)
    for number in LOW_LEVEL:
        if (name, number) not in CANNOT and api.FAPS[number].group in (3, 6, 7):
            assert not np.isnan(plain.measure(plain.vertices)[number - 1]), number
    frame = np.full(68, np.nan)
    frame[[44 - 1, 46 - 1, 47 - 1]] = 80.0, 60.0, 10000.0
    pose = plain.pose(frame, drive="exact")
    for number in (44, 46, 47):
        assert shown(plain, number, pose.positions) == pytest.approx(frame[number - 1], rel=0.05), number
