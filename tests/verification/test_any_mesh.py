"""Any mesh: a face of it moves by finite amounts, or is refused in words. No NaN ever leaves."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import risorius.api as api
from fuzzing import meshes
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from risorius.errors import RisoriusError, SolverError

WORDS, DRIVES = ("joy", "fear", "surprise", "disgust"), ("natural", "points", "exact", "muscles")


@cache
def sound() -> meshes.Damaged:
    return meshes.sound()


@cache
def mask() -> meshes.Damaged:
    return meshes.mask(sound())


def posed_or_refused(damages: tuple[str, ...], seed: int, drive: str) -> str:
    """What becomes of the default face with damages; fails where anything but a finite pose or an error comes out."""
    draw, mesh = np.random.default_rng(seed), mask()
    for name in damages:
        mesh = getattr(meshes, name)(mesh, draw)
    try:
        face = api.Face.from_arrays(mesh.vertices, mesh.polygons, mesh.points, mesh.parts)
        pose = face.pose(api.expression(WORDS[seed % len(WORDS)]).frame(), drive=drive)
    except SolverError as error:
        return "not solved" if error.residual is not None else "not told how far it is off"
    except RisoriusError:
        return "refused"
    assert pose.positions.shape == mesh.vertices.shape
    assert np.isfinite(pose.positions).all()
    assert np.isfinite(list(pose.contractions.values())).all()
    assert not np.isinf(pose.achieved).any()
    assert np.abs(pose.positions - mesh.vertices).max() < np.ptp(mesh.vertices, axis=0).max()
    return "posed"


#: What a face must bear, and what must be refused: single damages that leave a face, and one that leaves none.
BORNE = (
    "shuffled", "far", "turned", "degenerate", "collapsed", "doubled", "loose", "many_cornered", "non_manifold",
    "partless",
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("damage", BORNE)
def test_a_face_bears_one_damage(damage: str) -> None:
    assert posed_or_refused((damage,), 1, "natural") == "posed"


def test_coordinates_that_are_none_are_refused() -> None:
    for seed in range(5):
        assert posed_or_refused(("poisoned",), seed, "points") == "refused"


@pytest.mark.slow
@settings(
    max_examples=12, derandomize=True, deadline=None, database=None, suppress_health_check=[HealthCheck.too_slow],
)  # fmt: skip
@given(
    damages=st.lists(st.sampled_from([damage.__name__ for damage in meshes.DAMAGES]), min_size=2, max_size=4),
    seed=st.integers(0, 10_000),
    drive=st.sampled_from(DRIVES),
)
def test_a_face_with_several_damages_moves_or_is_refused(damages: list[str], seed: int, drive: str) -> None:
    assert posed_or_refused(tuple(damages), seed, drive) in ("posed", "refused", "not solved")


@pytest.mark.slow
def test_the_scale_and_the_place_of_a_mesh_are_of_no_account() -> None:
    """From a ten-thousandth to ten thousand times the size, and a thousand sizes away: the same pose."""
    mesh, frame = sound(), api.expression("joy").frame()
    expected = api.default_face().pose(frame).positions
    for factor, shift in ((1e-4, 0.0), (1e4, 0.0), (1.0, 1e2)):
        points = {name: np.asarray(place) * factor + shift for name, place in mesh.points.items()}
        face = api.Face.from_arrays(mesh.vertices * factor + shift, mesh.polygons, points, mesh.parts)
        again = (face.pose(frame).positions - shift) / factor
        np.testing.assert_allclose(again, expected, atol=2e-5)
