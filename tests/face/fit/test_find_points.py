"""Feature points found on meshes: any pose and unit, clicks, refusals, known topologies, progress."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from fit import shapes
from risorius.errors import FormatError, ModelError, ParameterError
from risorius.face.default_head import HeadMesh
from risorius.face.fit.clicks import ASKED
from risorius.face.fit.topologies import FOLDER

EARS_AND_SKULL = ("10.", "11.")


def turned(x: float, y: float, z: float) -> np.ndarray:
    """(3, 3) rotation by degrees about x, then y, then z."""
    rotation = np.eye(3)
    for axis, angle in enumerate(np.radians([x, y, z])):
        i, j = [(1, 2), (2, 0), (0, 1)][axis]
        step = np.eye(3)
        step[i, i] = step[j, j] = np.cos(angle)
        step[j, i], step[i, j] = np.sin(angle), -np.sin(angle)
        rotation = step @ rotation
    return rotation


def places(vertices: np.ndarray, points: Mapping[str, int | np.ndarray]) -> dict[str, np.ndarray]:
    """Positions of feature points."""
    return {name: vertices[point] if isinstance(point, int) else np.array(point) for name, point in points.items()}


def errors_mm(found: api.FoundPoints, truth: Mapping[str, np.ndarray], metre: float = 1.0) -> dict[str, float]:
    """Distance of every found point from the truth."""
    shared = found.positions.keys() & truth.keys()
    return {name: 1000.0 * float(np.linalg.norm(found.positions[name] - truth[name])) / metre for name in shared}


def core(errors: Mapping[str, float]) -> np.ndarray:
    """Errors of all points but those of ears and skull."""
    return np.array([error for name, error in errors.items() if not name.startswith(EARS_AND_SKULL)])


@pytest.mark.slow
def test_points_of_a_head_in_any_pose_and_unit(shared_head: Callable) -> None:
    head, rotation, size = shared_head("makehuman"), turned(-90.0, 25.0, 170.0), 100.0
    move = np.array([3.0, -40.0, 7.0]) * size
    found = api.find_points(head.vertices @ rotation.T * size + move, head.polygons, topologies=())
    truth = {k: p @ rotation.T * size + move for k, p in places(head.vertices, head.points).items()}
    errors = core(errors_mm(found, truth, size))
    assert found.topology is None
    assert found.score < 1.0
    assert not found.is_doubtful
    assert np.median(errors) < 2.3
    assert np.quantile(errors, 0.95) < 6.5
    assert set(found.positions) >= set(api.REQUIRED_POINTS)
    in_order({k: (p - move) @ rotation / size for k, p in found.positions.items()})


def in_order(points: Mapping[str, np.ndarray]) -> None:
    """Lip and lid points stay on their own lip and lid, left and right on their own side (z up, x left)."""
    for upper, lower in (("3.1", "3.3"), ("3.2", "3.4"), ("8.1", "2.2"), ("2.3", "8.2"), ("2.2", "2.3")):
        assert points[upper][2] > points[lower][2] - 1e-4, (upper, lower)
    for left, right in (("8.3", "8.4"), ("3.7", "3.11"), ("3.8", "3.12"), ("2.4", "2.5"), ("4.1", "4.2")):
        assert points[left][0] > points[right][0], (left, right)


@pytest.mark.slow
def test_an_open_mouth_is_found_open(shared: Path, shared_head: Callable) -> None:
    head = shared_head("ict_narrow")
    shapes = np.load(shared / "heads" / "ict_expressions.npz")
    opening = shapes["displacement"][list(shapes["names"]).index("jawOpen")][: len(head.vertices)]
    gaping = head.vertices + 0.7 * opening
    found = api.find_points(gaping, head.polygons, topologies=())
    truth = places(gaping, head.points)
    errors = errors_mm(found, truth)
    assert np.linalg.norm(truth["2.2"] - truth["2.3"]) > 0.02
    assert max(errors[name] for name in ("2.2", "2.3", "8.1", "8.2", "2.1", "2.10")) < 5.0
    assert np.median(core(errors)) < 2.0


@pytest.mark.slow
def test_a_whole_body_y_up_in_centimetres_becomes_a_face(shared: Path, shared_head: Callable) -> None:
    data = np.load(shared / "heads" / "makehuman_body.npz")
    polygons = np.split(data["loops"].astype(np.int64), np.cumsum(data["face_sizes"])[:-1])
    upright = data["vertices"].astype(float)
    y_up = 100.0 * upright[:, [0, 2, 1]] * np.array([1.0, 1.0, -1.0])
    known = api.find_points(y_up, polygons)
    assert known.topology is not None
    assert "hm08" in known.topology
    searched = api.find_points(y_up, polygons, topologies=())
    errors = core(errors_mm(searched, known.positions, 100.0))
    assert np.median(errors) < 2.2
    face = api.Face.from_arrays(y_up, polygons, searched.positions)
    assert 50.0 < 10.0 * face.units.es0 < 70.0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cube", "symmetric rock", "half a face"])
def test_what_is_no_face_is_refused(name: str) -> None:
    vertices, polygons = shapes.NON_FACES[name]()
    with pytest.raises(ModelError, match=r"click its feature points 3\.7") as refused:
        api.find_points(vertices, polygons)
    assert "score" in str(refused.value) or "no face found" in str(refused.value)


@pytest.mark.slow
def test_clicks_place_a_face_that_is_refused(shared_head: Callable) -> None:
    monkey = shared_head("suzanne")
    with pytest.raises(ModelError, match="score"):
        api.find_points(monkey.vertices, monkey.polygons)
    truth = places(monkey.vertices, monkey.points)
    clicks = {name: truth[name] for name in ASKED}
    found = api.find_points(monkey.vertices, monkey.polygons, clicks)
    for name in ("2.1", "9.3"):
        np.testing.assert_allclose(found.positions[name], truth[name])
        assert found.confidence[name] == 1.0
    spread = float(np.linalg.norm(np.ptp(monkey.vertices, axis=0)))
    assert np.median(core(errors_mm(found, truth))) < 1000.0 * 0.05 * spread


def test_clicks_that_make_no_sense(head: HeadMesh) -> None:
    truth = places(head.vertices, head.points)
    swapped = {"3.7": truth["3.12"], "3.12": truth["3.7"], "8.3": truth["2.1"], "9.3": truth["11.4"]}
    with pytest.raises(ModelError, match="do not form a face"):
        api.find_points(head.vertices, head.polygons, swapped, topologies=())
    line = {name: np.array([0.0, 0.0, 0.01 * k]) for k, name in enumerate(ASKED)}
    with pytest.raises(ModelError, match="one line"):
        api.find_points(head.vertices, head.polygons, line, topologies=())
    with pytest.raises(ParameterError, match=r"9\.99 is not a feature point"):
        api.find_points(head.vertices, head.polygons, {"9.99": (0.0, 0.0, 0.0)})
    with pytest.raises(ParameterError, match="is not on the skin"):
        api.find_points(head.vertices, head.polygons, {"6.1": (0.0, 0.0, 0.0)})
    with pytest.raises(ParameterError, match=r"three finite coordinates, but it is \[0\.0, 1\.0\]"):
        api.find_points(head.vertices, head.polygons, {"3.7": np.array([0.0, 1.0])})
    for off in (0.5, 1e200):
        with pytest.raises(ModelError, match=r"clicked point 3\.7 is off the mesh"):
            api.find_points(head.vertices, head.polygons, {"3.7": (off, 0.0, 0.0)})
    with pytest.raises(ParameterError, match="three finite"):
        api.find_points(head.vertices, head.polygons, {"3.7": (0.0, np.nan, 0.0)})


@pytest.mark.parametrize("name", ["ict", "ict_narrow", "mediapipe"])
def test_known_topologies_give_their_points_at_once(shared_head: Callable, name: str) -> None:
    head = shared_head(name)
    found = api.find_points(head.vertices * 3.0, head.polygons)
    assert found.topology is not None
    assert len(found.positions) > 50
    errors = errors_mm(found, places(head.vertices * 3.0, head.points))
    assert max(errors[point] for point in found.positions if isinstance(head.points[point], int)) < 1e-3


def test_the_default_head_knows_itself(head: HeadMesh) -> None:
    found = api.find_points(head.vertices, head.polygons)
    assert found.topology == "Risorius, default head"
    # a point inside a polygon is stored on the polygon's triangles, which differ from the smooth skin by this much
    assert max(errors_mm(found, places(head.vertices, head.points)).values()) < 0.15


def test_a_topology_is_saved_and_found_again(tmp_path: Path, shared_face: Callable) -> None:
    face = shared_face("makehuman")
    saved = api.save_topology(tmp_path / "mine.toml", face, name='my "own" head')
    assert api.read_topology(tmp_path / "mine.toml").digest == saved.digest
    found = api.find_points(face.vertices, face.polygons, topologies=api.load_topologies(tmp_path))
    assert found.topology == 'my "own" head'
    np.testing.assert_allclose(found.positions["8.4"], face.points["8.4"].position, atol=1e-9)


@pytest.mark.parametrize(
    ("wrong", "key"),
    [
        ('sha1 = 5\nname="a"\nsource="b"\nvertices=3\nedges=3\n[points]', "sha1"),
        ('name="a"\nsource="b"\nvertices=3\nedges=3\nsha1="x"\n[points]\n"99.1" = 1', "99.1"),
        ('name="a"\nsource="b"\nvertices=3\nedges=3\nsha1="x"\n[points]\n"2.1" = 3', "2.1"),
        ('name="a"\nsource="b"\nvertices=3\nedges=3\nsha1="x"\n[points]\n"2.1" = [[0, 1], [0.5, 0.4]]', "2.1"),
    ],
)
def test_damaged_topology_tables_say_where(tmp_path: Path, wrong: str, key: str) -> None:
    (tmp_path / "bad.toml").write_text(wrong)
    with pytest.raises(FormatError, match=key):
        api.load_topologies(tmp_path)


def test_shipped_topologies_name_their_source_and_licence() -> None:
    shipped = sorted(FOLDER.glob("*.toml"))
    assert len(shipped) >= 7
    for path in shipped:
        topology = api.read_topology(path)
        assert re.search("of Risorius|MIT|CC0|Apache-2.0", topology.source), path.name
        assert set(topology.points) >= set(api.REQUIRED_POINTS), path.name


@pytest.mark.slow
def test_progress_rises_and_the_work_can_be_cancelled(head: HeadMesh) -> None:
    steps = api.find_points_steps(head.vertices, head.polygons, topologies=())
    shown = [next(steps) for _ in range(9)]
    steps.close()
    fractions = [step.fraction for step in shown]
    assert fractions == sorted(fractions)
    assert 0.0 <= fractions[0] < fractions[-1] < 1.0
    assert all(step.text for step in shown)
    with pytest.raises(StopIteration):
        next(steps)


def test_meshes_that_cannot_be_searched(head: HeadMesh) -> None:
    with pytest.raises(ModelError, match="shape"):
        api.find_points(np.zeros((4, 2)), [[0, 1, 2]])
    with pytest.raises(ModelError, match="NaN"):
        api.find_points(np.full((4, 3), np.nan), [[0, 1, 2]])
    with pytest.raises(ModelError, match="no polygons"):
        api.find_points(head.vertices, [])
    with pytest.raises(ModelError, match="no polygons"):
        api.find_points(head.vertices, np.zeros((0, 3), dtype=int))
    with pytest.raises(ModelError, match=f"below {len(head.vertices)}"):
        api.find_points(head.vertices, np.array([[0, 1, 99999]]))
    with pytest.raises(ModelError, match="one place"):
        api.find_points(np.zeros((4, 3)), [[0, 1, 2]])
    with pytest.raises(ModelError, match="no area"):
        api.find_points(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), [[0, 1, 2]])
