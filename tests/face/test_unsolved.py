"""A skin whose balance is not reached: every way to a pose or a motion says so, and what was before still is.

Nothing is feigned: the solver itself gets one iteration where it needs some ten, and judges what it has.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius import cli
from risorius.errors import SolverError
from risorius.face.long_motion import long_motion
from risorius.progress import run

pytestmark = pytest.mark.slow

#: The first frame of `film` that is not at rest.
BEGINS = 3


@pytest.fixture
def face(monkeypatch: pytest.MonkeyPatch) -> api.Face:
    """The default face, whose equilibria may take one iteration."""
    known = api.default_face()
    monkeypatch.setattr(known.anatomy.relaxation._solver, "max_iterations", 1)
    return known


def film() -> np.ndarray:
    """(6, 68) a face at rest that smiles."""
    frames = np.zeros((6, 68))
    frames[BEGINS:] = np.nan_to_num(api.expression("joy").frame())
    return frames


def stream() -> api.FapStream:
    return api.FapStream(film(), fps=25.0)


#: Ways that know frames, and ways to one pose.
MOTIONS: dict[str, Callable[[api.Face], object]] = {
    "reduced": lambda face: face.simulate(film()).positions,
    "balance": lambda face: face.simulate(film(), integrator="balance").positions,
    "implicit": lambda face: face.simulate(film(), integrator="implicit").positions,
    "play": lambda face: list(api.play(face, stream())),
    "play with inertia": lambda face: list(api.play(face, stream(), inertia=True)),
    "long": lambda face: run(long_motion(face.poser, film(), api.Drive("natural"))),
}
POSES: dict[str, Callable[[api.Face], object]] = {
    "natural": lambda face: face.pose(api.expression("joy").frame()),
    "exact": lambda face: face.pose(api.expression("joy").frame(), drive="exact"),
    "muscles": lambda face: face.pose(api.expression("joy").frame(), drive="muscles"),
    "by hand": lambda face: face.pose(np.full(68, np.nan), contractions={"zygomaticus_major_l": 1.0}),
    "dragged": lambda face: face.sketcher().sketch(api.expression("joy").frame()),
    "tables": lambda face: api.face_animation_tables(face, faps=[12], steps=1),
    "shapes": lambda face: api.arkit_shapes(face),
}


@pytest.mark.parametrize("way", MOTIONS)
def test_a_motion_that_is_not_solved_names_frame_and_residual(way: str, face: api.Face) -> None:
    with pytest.raises(SolverError, match=r"no equilibrium .*frame \d, residual") as told:
        MOTIONS[way](face)
    assert told.value.frame is not None
    assert BEGINS <= told.value.frame < 6
    assert told.value.residual is not None
    assert 1e-6 < told.value.residual < 1.0


@pytest.mark.parametrize("way", POSES)
def test_a_pose_that_is_not_solved_tells_how_far_it_is_off(way: str, face: api.Face) -> None:
    with pytest.raises(SolverError, match="residual") as told:
        POSES[way](face)
    assert told.value.residual is not None
    assert 1e-6 < told.value.residual < 1.0


def test_a_face_poses_as_before_after_it_could_not() -> None:
    face, sketcher = api.default_face(), api.default_face().sketcher()
    frame = api.expression("joy").frame()
    before, sketched = face.pose(frame).positions, sketcher.sketch(frame).positions
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(face.anatomy.relaxation._solver, "max_iterations", 1)
        other = api.expression("fear").frame()
        for call in (lambda: face.pose(other), lambda: sketcher.sketch(other), lambda: face.simulate(film())):
            with pytest.raises(SolverError):
                call()
    np.testing.assert_array_equal(face.pose(frame).positions, before)
    np.testing.assert_allclose(sketcher.sketch(frame).positions, sketched, atol=1e-9)


def test_the_command_line_says_it_and_writes_nothing(
    face: api.Face, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RISORIUS_CACHE", "off")
    assert cli.main(["tables", "--faps", "12", "--steps", "1", "--out", str(tmp_path / "a.json")]) == 1
    assert "no equilibrium" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_what_is_no_number_never_leaves(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where every judgement before it fails: the last one does not."""
    face = api.default_face()
    solver = face.anatomy.relaxation._solver
    frame = api.expression("joy").frame()
    exact = solver.solve

    def lost(*given: object, **options: object) -> object:
        found = exact(*given, **options)
        found.positions[7] = np.nan
        return found

    monkeypatch.setattr(solver, "solve", lost)
    with pytest.raises(SolverError, match="beyond all numbers"):
        face.pose(frame)
    for integrator in ("balance", "reduced"):
        with pytest.raises(SolverError, match="frame") as told:
            face.simulate(film(), integrator=integrator)
        assert told.value.frame is not None
