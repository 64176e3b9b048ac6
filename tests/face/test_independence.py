"""The same face is the same face: in any unit and pose, however its mesh is numbered, wound, mirrored or divided."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face
from risorius.errors import ModelError
from risorius.face.default_head import HeadMesh
from risorius.face.default_head.figures import DEFAULT_FIGURES, read_figures
from risorius.face.default_head.limit import cage_through, limit_matrix, subdivide
from risorius.face.default_head.skin import build_skin
from risorius.face.drive.natural.symmetry import mirrored as in_mirror
from risorius.face.drive.request import Drive, Request
from risorius.face.mesh.parts import Part
from risorius.face.pose import Poser
from scipy.spatial.transform import Rotation

MIRROR = np.array([-1.0, 1.0, 1.0])
DRIVES = ("natural", "exact")

#: What rounding may leave of a displacement, as a share of the largest one.
SAME = 1e-9


@dataclass(frozen=True)
class Given:
    """What `Face.from_arrays` takes: vertices (V, 3), polygons, feature points, parts (V,), axes."""

    vertices: np.ndarray
    polygons: list[np.ndarray]
    points: dict[str, int | np.ndarray]
    parts: np.ndarray
    axes: np.ndarray | None = None

    def face(self) -> Face:
        """The face."""
        return Face.from_arrays(self.vertices, self.polygons, self.points, self.parts, axes=self.axes)

    def carried(self, turn: np.ndarray, scale: float, shift: np.ndarray) -> Given:
        """The same in other coordinates."""

        def carry(places: np.ndarray) -> np.ndarray:
            return np.asarray(scale * places @ turn.T + shift)

        points = {n: p if isinstance(p, int | np.integer) else carry(np.asarray(p)) for n, p in self.points.items()}
        return replace(self, vertices=carry(self.vertices), points=points)


@pytest.fixture(scope="module")
def given(head: HeadMesh) -> Given:
    """The default head as it is given."""
    return Given(head.vertices, [np.array(p) for p in head.polygons], dict(head.points), head.parts)


def requests() -> list[np.ndarray]:
    """Two frames: one that moves brows, lids, lips and jaw, and one that is all on one side."""
    one_sided = np.full(68, np.nan)
    one_sided[np.array([12, 53, 59, 19, 31, 41, 15]) - 1] = 150.0, 200.0, 150.0, 300.0, 200.0, 120.0, 120.0
    return [api.archetype("fear", 8).frame(), one_sided]


def moved(face: Face, frame: np.ndarray, drive: str) -> np.ndarray:
    """(V, 3) displacement for a frame."""
    return np.asarray(face.pose(frame, drive=drive).positions - face.vertices)


@pytest.fixture(scope="module")
def usual(face: Face) -> list[np.ndarray]:
    """Displacements (V, 3) of the head as it is, for every request and drive."""
    return [moved(face, frame, drive) for frame in requests() for drive in DRIVES]


def assert_unchanged(other: Face, usual: list[np.ndarray], back: Callable[[np.ndarray], np.ndarray]) -> None:
    """A face whose displacements, carried back, are the usual ones."""
    now = [moved(other, frame, drive) for frame in requests() for drive in DRIVES]
    for changed, before in zip(now, usual, strict=True):
        assert_same(back(changed), before)


def assert_same(now: np.ndarray, before: np.ndarray, tolerance: float = SAME) -> None:
    """Displacements (V, 3) that differ nowhere by more than a share of the largest one."""
    largest = np.linalg.norm(before, axis=1).max()
    assert largest > 2e-3
    assert np.linalg.norm(now - before, axis=1).max() <= tolerance * largest


#: From Blender's axes to those of other programs: Y up.
Y_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])


@pytest.mark.slow
def test_millimetres_with_y_up_change_nothing(given: Given, usual: list[np.ndarray]) -> None:
    other = given.carried(Y_UP, 1000.0, np.array([300.0, -2000.0, 1000.0])).face()
    assert_unchanged(other, usual, lambda displacement: displacement @ Y_UP / 1000.0)


@pytest.mark.slow
def test_a_turned_head_in_inches_is_the_same_where_its_axes_are_told(given: Given, usual: list[np.ndarray]) -> None:
    turn, inch = Rotation.from_euler("xyz", [40.0, -70.0, 120.0], degrees=True).as_matrix(), 0.0254
    left, up, forward = turn @ [1.0, 0.0, 0.0], turn @ [0.0, 0.0, 1.0], turn @ [0.0, -1.0, 0.0]
    turned = given.carried(turn, 1.0 / inch, np.zeros(3))
    told = replace(turned, axes=np.stack([left, up, forward])).face()
    assert_unchanged(told, usual, lambda displacement: displacement @ turn * inch)


@pytest.mark.slow
def test_a_turned_head_whose_axes_are_not_told_is_nearly_the_same(face: Face, given: Given) -> None:
    """Its points alone then tell what is upright: on the default head 0.2 degrees beside what its maker took for it."""
    turn = Rotation.from_euler("xyz", [-100.0, 25.0, 60.0], degrees=True).as_matrix()
    turned = given.carried(turn, 1.0, np.zeros(3)).face()
    for frame in requests():
        for drive in DRIVES:
            assert_same(moved(turned, frame, drive) @ turn, moved(face, frame, drive), 1e-2)


@pytest.mark.parametrize("wrong", [np.eye(2), np.diag([1.0, 1.0, -1.0]), 2.0 * np.eye(3), np.full((3, 3), np.nan)])
def test_axes_that_are_no_rotation_are_refused(given: Given, wrong: np.ndarray) -> None:
    with pytest.raises(ModelError, match="perpendicular"):
        replace(given, axes=wrong).face()


def numbered_anew(given: Given, rng: np.random.Generator) -> tuple[Given, np.ndarray]:
    """The same mesh with vertices and polygons in another order; vertex k of it was `order[k]`."""
    order = rng.permutation(len(given.vertices))
    place = np.argsort(order)
    points = {n: int(place[p]) if isinstance(p, int | np.integer) else p for n, p in given.points.items()}
    polygons = [place[given.polygons[i]] for i in rng.permutation(len(given.polygons))]
    return Given(given.vertices[order], polygons, points, given.parts[order]), order


@pytest.mark.slow
def test_numbering_winding_and_first_corners_change_nothing(given: Given, usual: list[np.ndarray]) -> None:
    rng = np.random.default_rng(1)
    other, order = numbered_anew(given, rng)
    inwards = [np.roll(polygon[::-1], rng.integers(len(polygon))) for polygon in other.polygons]
    face = replace(other, polygons=inwards).face()
    assert_unchanged(face, usual, lambda displacement: displacement[np.argsort(order)])


@pytest.mark.parametrize("drive", DRIVES)
def test_a_mirrored_request_makes_a_mirrored_face(face: Face, head: HeadMesh, drive: str) -> None:
    """Emotions that are stronger on one side, and FAPs of one side: what is left becomes right, to rounding."""
    weaker = np.array([0.3 if "_r_" in api.FAPS[number].name else 1.0 for number in range(1, 69)])
    for frame in [*requests(), api.archetype("disgust", 0).frame() * weaker]:
        mirrored = moved(face, in_mirror(frame), drive)
        assert_same(mirrored[head.mirror] * MIRROR, moved(face, frame, drive))


@pytest.mark.parametrize("drive", DRIVES)
def test_a_symmetric_request_makes_a_symmetric_face(face: Face, head: HeadMesh, drive: str) -> None:
    for word, variant in (("joy", 2), ("surprise", 1)):
        frame = api.archetype(word, variant).frame()
        both = np.where(np.isnan(frame), in_mirror(frame), frame)
        alike = np.where(np.isnan(in_mirror(frame)), both, (both + in_mirror(both)) / 2.0)
        now = moved(face, alike, drive)
        assert_same(now[head.mirror] * MIRROR, now)


def test_each_muscle_is_the_mirror_image_of_its_twin(face: Face, head: HeadMesh) -> None:
    actuators, skin = face.anatomy.actuators, face.anatomy.skin
    place = np.full(len(head.vertices), -1)
    place[skin.index] = np.arange(skin.vertex_count)
    twin = place[head.mirror[skin.index]]
    fields = {m.name: field for m, field in zip(actuators.muscles, actuators.fields, strict=True)}
    for name, field in fields.items():
        if name.endswith("_l"):
            assert_same(fields[name[:-2] + "_r"][twin] * MIRROR, field)


class Divisions:
    """The default head's limit surface with its cage's vertices (a quarter), with its own, and with four times them."""

    def __init__(self, head: HeadMesh) -> None:
        figures = read_figures(DEFAULT_FIGURES)
        skin = build_skin(figures)
        count = len(skin.cage.names)
        cage = cage_through(skin.vertices[:count], skin.cage.quads)
        once = subdivide(count, skin.cage.quads)
        twice = subdivide(once.matrix.shape[0], once.quads)
        divided = np.asarray(limit_matrix(twice.matrix.shape[0], twice.quads) @ (twice.matrix @ (once.matrix @ cage)))
        divided[:count] = skin.vertices[:count]
        self.common = np.arange(count)
        own = int(np.sum(head.parts == Part.SKIN))
        self._rest, self._rest_parts = head.vertices[own:], head.parts[own:]
        self._rest_polygons = [np.array(p) - own for p in head.polygons if min(p) >= own]
        self._points = {n: head.vertices[p] if isinstance(p, int | np.integer) else p for n, p in head.points.items()}
        self.quarter = self._face(skin.vertices[:count], skin.cage.quads)
        self.own = self._face(skin.vertices, skin.quads)
        self.fourfold = self._face(divided, twice.quads)

    def _face(self, vertices: np.ndarray, quads: np.ndarray) -> Face:
        """The whole head with a skin of its own; every feature point as a place on it, none as a vertex."""
        polygons = [*quads, *(p + len(vertices) for p in self._rest_polygons)]
        parts = np.concatenate([np.zeros(len(vertices), dtype=int), self._rest_parts])
        return Face.from_arrays(np.concatenate([vertices, self._rest]), polygons, self._points, parts)

    def difference(self, now: Callable[[Face], np.ndarray], other: Face) -> tuple[float, float]:
        """Difference of a displacement (V, 3) on another division from the head's own: RMS, largest; as shares."""
        a, b = now(other)[self.common], now(self.own)[self.common]
        off = np.linalg.norm(a - b, axis=1)
        return float(np.sqrt((off**2).sum() / (b**2).sum())), float(off.max() / np.linalg.norm(b, axis=1).max())


@pytest.fixture(scope="module")
def divisions(head: HeadMesh) -> Divisions:
    """The default head at three densities."""
    return Divisions(head)


def posed(frame: np.ndarray, drive: Drive) -> Callable[[Face], np.ndarray]:
    """How a face moves for a frame, without the folds that only fine meshes can show."""

    def displacement(face: Face) -> np.ndarray:
        pose = Poser(face.anatomy, folds=False).pose(Request(frame, drive))
        return np.asarray(pose.positions - face.vertices)

    return displacement


def muscle_differences(divisions: Divisions, other: Face) -> tuple[np.ndarray, np.ndarray]:
    """RMS and largest difference of each left-hand muscle's field."""

    def field(name: str) -> Callable[[Face], np.ndarray]:
        def displacement(face: Face) -> np.ndarray:
            actuators = face.anatomy.actuators
            whole = np.zeros_like(face.vertices)
            number = [muscle.name for muscle in actuators.muscles].index(name)
            own = face.anatomy.given_skin
            whole[own.index] = actuators.fields[number][: own.vertex_count]
            return whole

        return displacement

    names = [name for name in divisions.own.muscles if name.endswith("_l")]
    rms, largest = np.transpose([divisions.difference(field(name), other) for name in names])
    return rms, largest


WORDS = (("joy", 1), ("fear", 8), ("sadness", 0), ("surprise", 2), ("anger", 1), ("disgust", 0))


def pose_differences(divisions: Divisions, other: Face) -> tuple[np.ndarray, np.ndarray]:
    """RMS and largest difference of the six emotions, natural and exact."""
    frames = [api.archetype(word, variant).frame() for word, variant in WORDS]
    poses = [posed(frame, drive) for frame in frames for drive in (Drive.NATURAL, Drive.EXACT)]
    rms, largest = np.transpose([divisions.difference(pose, other) for pose in poses])
    return rms, largest


@pytest.mark.slow
def test_four_times_the_vertices_move_alike(divisions: Divisions) -> None:
    for differences in (pose_differences, muscle_differences):
        rms, largest = differences(divisions, divisions.fourfold)
        assert rms.max() < 0.05
        assert largest.max() < 0.05


@pytest.mark.slow
def test_a_quarter_of_the_vertices_moves_alike(divisions: Divisions) -> None:
    """One vertex per centimetre is solved on a finer skin.

    Single vertices pass 5 %: the cheek of a smile, and where the depressor of the lower lip has its edge.
    """
    for differences, worst_rms, worst in ((pose_differences, 0.05, 0.06), (muscle_differences, 0.065, 0.08)):
        rms, largest = differences(divisions, divisions.quarter)
        assert np.median(rms) < 0.03
        assert rms.max() < worst_rms
        assert np.median(largest) < 0.04
        assert largest.max() < worst
