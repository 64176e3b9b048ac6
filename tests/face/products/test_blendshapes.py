"""Named shape keys made by posing the muscles: what they do, on which side, and how near a scanned head they come."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from risorius import api
from risorius.errors import ParameterError
from risorius.face.face import Face
from risorius.mpeg4.streams.capture import load_shapes

#: Scanned shapes whose gaze or lids the scanned head leaves out: it moves a lid by fractions of a millimetre.
NOT_COMPARED = ("eyeLookIn", "eyeLookOut")
#: Explained variance that every compared shape must reach, and that half of them must.
LEAST, HALF = 0.55, 0.88


@pytest.fixture(scope="module")
def shapes(face: Face) -> dict[str, np.ndarray]:
    """The 52 shapes of the default face."""
    return api.arkit_shapes(face)


def point(face: Face, positions: np.ndarray, name: str) -> np.ndarray:
    """(3,) displacement of a feature point."""
    return np.asarray(face.points.matrix([name]) @ (positions - face.vertices))[0]


@pytest.mark.slow
def test_there_are_52_and_all_move_something(face: Face, shapes: dict[str, np.ndarray]) -> None:
    assert list(shapes) == list(load_shapes())
    for name, positions in shapes.items():
        assert positions.shape == face.vertices.shape, name
        assert np.isfinite(positions).all(), name
        largest = np.linalg.norm(positions - face.vertices, axis=1).max()
        assert 1e-3 < largest < 60e-3, (name, largest)


@pytest.mark.parametrize(
    ("shape", "name", "axis", "sign"),
    [
        ("jawOpen", "2.1", 2, -1), ("mouthSmileLeft", "8.3", 2, 1), ("mouthFrownRight", "8.4", 2, -1),
        ("eyeBlinkLeft", "3.1", 2, -1), ("eyeWideRight", "3.2", 2, 1), ("browInnerUp", "4.1", 2, 1),
        ("browOuterUpLeft", "4.5", 2, 1), ("browDownRight", "4.4", 2, -1), ("mouthPucker", "8.1", 1, -1),
        ("mouthUpperUpLeft", "8.5", 2, 1), ("mouthLowerDownRight", "8.8", 2, -1), ("jawLeft", "2.1", 0, 1),
        ("jawRight", "2.1", 0, -1), ("mouthLeft", "8.3", 0, 1), ("mouthRight", "8.4", 0, -1),
        ("cheekPuff", "5.1", 0, 1),
        ("jawForward", "2.1", 1, -1), ("mouthShrugLower", "2.10", 2, 1), ("mouthRollLower", "8.2", 1, 1),
        ("mouthStretchLeft", "8.3", 0, 1), ("mouthDimpleRight", "8.4", 0, -1), ("mouthShrugUpper", "8.1", 2, 1),
        ("cheekSquintLeft", "5.3", 2, 1), ("noseSneerRight", "9.4", 2, 1), ("tongueOut", "6.1", 1, -1),
    ],
)  # fmt: skip
def test_shapes_move_their_points_the_right_way(
    shape: str, name: str, axis: int, sign: int, face: Face, shapes: dict[str, np.ndarray]
) -> None:
    """+X is the subject's left, the face looks along -Y."""
    assert point(face, shapes[shape], name)[axis] * sign > 0.3e-3


def test_one_sided_shapes_belong_to_their_side(face: Face, shapes: dict[str, np.ndarray]) -> None:
    """By the energy of the motion; one lip hangs on the other, so a little crosses over."""
    across = {"Left": face.vertices[:, 0] < -0.005, "Right": face.vertices[:, 0] > 0.005}
    for name, positions in shapes.items():
        side = next((side for side in across if name.endswith(side)), None)
        if side is None or name.startswith(("jaw", "mouthLeft", "mouthRight")):
            continue
        energy = ((positions - face.vertices) ** 2).sum(axis=1)
        assert energy[across[side]].sum() < 0.15 * energy.sum(), name


def test_both_sides_mirror_each_other(face: Face, shapes: dict[str, np.ndarray]) -> None:
    """By the feature points; the default head is symmetric."""
    for name in ("mouthSmile", "browDown", "eyeBlink", "noseSneer", "mouthDimple"):
        for left, right in (("8.3", "8.4"), ("4.1", "4.2"), ("3.1", "3.2"), ("2.4", "2.5"), ("9.1", "9.2")):
            here, there = point(face, shapes[f"{name}Left"], left), point(face, shapes[f"{name}Right"], right)
            np.testing.assert_allclose(here * [-1.0, 1.0, 1.0], there, atol=1e-5)


def test_a_correction_closes_the_lips_over_an_open_jaw(face: Face, shapes: dict[str, np.ndarray]) -> None:
    both = shapes["jawOpen"] + shapes["mouthClose"] - face.vertices
    gap = point(face, shapes["jawOpen"], "2.2")[2] - point(face, shapes["jawOpen"], "2.3")[2]
    closed = point(face, both, "2.2")[2] - point(face, both, "2.3")[2]
    assert gap > 15e-3
    assert abs(closed) < 0.1 * gap


def test_eyes_look_where_their_shapes_say(face: Face, shapes: dict[str, np.ndarray]) -> None:
    assert face.measure(shapes["eyeLookInLeft"])[22] == pytest.approx(-52360.0, rel=0.02)
    assert face.measure(shapes["eyeLookInRight"])[23] == pytest.approx(52360.0, rel=0.02)
    assert face.measure(shapes["eyeLookUpLeft"])[24] == pytest.approx(-34907.0, rel=0.02)
    assert abs(face.measure(shapes["eyeLookUpLeft"])[25]) < 10.0


def test_other_names_are_the_same_shapes_and_own_ones_add_up(
    face: Face, shapes: dict[str, np.ndarray], tmp_path: Path
) -> None:
    (tmp_path / "own.toml").write_text(
        "[keys.half]\nshapes = { jawOpen = 0.5, mouthSmileLeft = 1 }\n"
        "[keys.pulled]\ncontractions = { risorius_l = 1 }\n"
    )
    own = api.arkit_shapes(face, tmp_path / "own.toml")
    expected = 0.5 * (shapes["jawOpen"] - face.vertices) + shapes["mouthSmileLeft"] - face.vertices
    np.testing.assert_allclose(own["half"] - face.vertices, expected, atol=1e-12)
    assert point(face, own["pulled"], "8.3")[0] > 1e-3
    (tmp_path / "bad.toml").write_text("[keys.pulled]\ncontractions = { biceps_l = 1 }\n")
    with pytest.raises(ParameterError, match="biceps_l"):
        api.arkit_shapes(face, tmp_path / "bad.toml")


def test_visemes_for_engines(face: Face) -> None:
    visemes = api.arkit_shapes(face, "oculus_visemes")
    assert len(visemes) == 15
    np.testing.assert_array_equal(visemes["viseme_sil"], face.vertices)
    assert point(face, visemes["viseme_aa"], "2.1")[2] < -3e-3
    assert point(face, visemes["viseme_PP"], "2.1")[2] > -2e-3
    assert point(face, visemes["viseme_O"], "8.3")[0] < -1e-3


def _scanned_name(name: str) -> str:
    """ICT-FaceKit's name of a shape."""
    if name in ("jawLeft", "jawRight", "mouthLeft", "mouthRight"):
        return name
    return (
        name.removesuffix("Left") + "_L"
        if name.endswith("Left")
        else name.removesuffix("Right") + ("_R" if name.endswith("Right") else "")
    )


@pytest.mark.slow
def test_shapes_are_those_of_the_scanned_head(shared: Path, shared_face: Callable[[str], Face]) -> None:
    """Share of each scanned shape's motion that ours explains, on the head that it belongs to."""
    data = np.load(shared / "heads" / "ict_expressions.npz")
    scans = {
        str(name): moved.astype(np.float64) for name, moved in zip(data["names"], data["displacement"], strict=True)
    }
    scans["browInnerUp"] = scans["browInnerUp_L"] + scans["browInnerUp_R"]
    head = shared_face("ict")
    explained = {}
    for name, positions in api.arkit_shapes(head).items():
        scan = scans.get(_scanned_name(name))
        if scan is not None and not name.startswith(NOT_COMPARED):
            ours = (positions - head.vertices)[: len(scan)]
            explained[name] = 1.0 - ((ours - scan) ** 2).sum() / (scan**2).sum()
    assert len(explained) == 31
    assert min(explained.values()) >= LEAST, explained
    assert np.median(list(explained.values())) >= HALF, explained


@pytest.mark.slow
def test_shapes_that_a_face_cannot_show_are_named(tmp_path: Path) -> None:
    table = tmp_path / "few.toml"
    table.write_text("[keys.blink]\nshapes = { eyeBlinkLeft = 1 }\n[keys.tongue]\nshapes = { tongueOut = 1 }\n")
    head = api.build_default_head()
    assert api.arkit_shapes(api.default_face(), table).unmet == {}
    parts = np.where(np.asarray(head.parts) == api.Part.TONGUE, int(api.Part.OTHER), head.parts)
    bare = api.Face.from_arrays(head.vertices, head.polygons, head.points, parts)
    missed = api.arkit_shapes(bare, table).unmet
    assert list(missed) == ["tongue"]
    assert "the face has no tongue" in missed["tongue"]
