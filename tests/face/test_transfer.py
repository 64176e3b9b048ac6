"""The table of muscles was written on one head: on any other each muscle does the same, with no row touched."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest
from risorius.api import FAPS, Face

#: What anatomy expects of each muscle: FAPs of the left side that its contraction raises (+) or lowers (-).
#: Source: the FACS muscle list; FAP signs of ISO/IEC 14496-2 (upper lip and upper lid positive down, chin positive up).
EXPECTED: Mapping[str, Mapping[int, int]] = {
    "frontalis_med": {31: +1, 33: +1},
    "frontalis_lat": {33: +1, 35: +1},
    "corrugator": {37: +1, 31: -1},
    "depressor_supercilii": {31: -1},
    "procerus": {31: -1, 32: -1},
    "orb_oculi_orbital_sup": {33: -1, 35: -1},
    "orb_oculi_orbital_inf": {21: +1, 41: +1},
    "llsan_wing": {63: +1, 55: -1},
    "llsan_lip": {8: -1, 55: -1},
    "levator_labii_superioris": {8: -1, 55: -1},
    "zygomaticus_minor": {8: -1, 12: +1, 59: +1},
    "zygomaticus_major": {12: +1, 59: +1, 53: +1},
    "levator_anguli_oris": {12: +1, 59: +1},
    "risorius": {6: +1, 53: +1},
    "buccinator": {6: +1, 53: +1},
    "buccinator_lips": {6: +1, 53: +1, 7: -1, 54: -1},
    "depressor_anguli_oris": {12: -1, 59: -1},
    "depressor_labii": {10: -1, 57: -1},
    "mentalis": {18: +1, 57: +1},
    "nasalis_alar": {61: +1},
    "depressor_septi": {63: -1},
    "oris_modiolus": {6: -1, 53: -1},
    "oris_upper_outer": {17: +1},
    "oris_lower_outer": {16: +1},
    "oris_upper_evert": {17: +1, 8: -1},
    "oris_lower_evert": {16: +1, 10: -1},
    "oris_upper_press": {4: +1, 8: +1},
    "oris_lower_press": {5: +1, 10: +1},
    "platysma": {59: -1},
    "cheek_puff": {39: +1},
    "cheek_suck": {39: -1},
}

HEADS = ("default", "ict", "makehuman", "another identity")


@pytest.fixture(scope="module")
def heads(any_face: Callable[[str], Face], shared: Path, shared_head: Callable[[str], object]) -> Mapping[str, Face]:
    """Faces by name; the identity shares its topology with the ICT head."""
    ict = any_face("ict")
    vertices = ict.vertices.copy()
    with np.load(shared / "heads" / "ict_identities.npz") as file:
        skin = file["vertices"][3].astype(np.float64)
    vertices[: len(skin)] = skin
    vertices[len(skin) :] += skin.mean(axis=0) - ict.vertices[: len(skin)].mean(axis=0)
    points = shared_head("ict").points  # type: ignore[attr-defined]
    points = {name: point for name, point in points.items() if isinstance(point, int) and name not in ("3.5", "3.6")}
    identity = Face.from_arrays(vertices, ict.polygons, points, ict.parts)
    return {
        "default": any_face("default"),
        "ict": ict,
        "makehuman": any_face("makehuman"),
        "another identity": identity,
    }


def left_muscles(face: Face) -> dict[str, np.ndarray]:
    """Row name -> (n, 3) field of the left-hand muscle over the outer skin, head space."""
    actuators = face.anatomy.actuators
    pairs = zip(actuators.muscles, actuators.fields, strict=True)
    return {muscle.row.name: field for muscle, field in pairs if muscle.side > 0}


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=pytest.mark.slow if name in ("ict", "another identity") else ()) for name in HEADS],
)
def test_each_muscle_does_what_anatomy_says_on_every_head(heads: Mapping[str, Face], name: str) -> None:
    face = heads[name]
    silent = np.full(68, np.nan)
    known = {muscle.row.name for muscle in face.muscles.values()}
    assert set(EXPECTED) <= known
    for muscle, signs in EXPECTED.items():
        achieved = face.pose(silent, drive="muscles", contractions={f"{muscle}_l": 0.3}).achieved
        largest = np.nanmax(np.abs(achieved))
        for number, sign in signs.items():
            assert sign * achieved[number - 1] > 0.05 * largest, f"{muscle}: {FAPS[number].name}"


def alike(one: np.ndarray, other: np.ndarray) -> float:
    """Cosine of two displacements."""
    return float((one * other).sum() / np.linalg.norm(one) / np.linalg.norm(other))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["default", "makehuman"])
def test_each_muscle_moves_the_feature_points_of_another_head_alike(heads: Mapping[str, Face], name: str) -> None:
    def at_points(face: Face) -> dict[str, np.ndarray]:
        skin = np.zeros(len(face.vertices), dtype=bool)
        skin[face.anatomy.skin.index] = True
        names = [n for n in face.points if len(face.points[n].vertices) and skin[face.points[n].vertices].all()]
        read = face.points.matrix(sorted(set(names) & common))[:, face.anatomy.skin.index]
        return {muscle: np.asarray(read @ field) for muscle, field in left_muscles(face).items()}

    common = set(heads["ict"].points) & set(heads[name].points) - {"9.4", "9.5"}
    here, there = at_points(heads[name]), at_points(heads["ict"])
    for muscle in there:
        assert alike(here[muscle], there[muscle]) > 0.9, muscle


@pytest.mark.slow
def test_each_muscle_moves_each_vertex_of_another_person_alike(heads: Mapping[str, Face]) -> None:
    ict, identity = heads["ict"], heads["another identity"]
    common, here, there = np.intersect1d(ict.anatomy.skin.index, identity.anatomy.skin.index, return_indices=True)
    assert len(common) > 10_000
    others = left_muscles(identity)
    for muscle, field in left_muscles(ict).items():
        assert alike(field[here], others[muscle][there]) > 0.95, muscle
