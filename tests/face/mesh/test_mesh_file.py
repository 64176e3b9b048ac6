"""Meshes in .npz and .obj files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from risorius.errors import FormatError
from risorius.face.mesh.files import read_mesh

QUAD_AND_TRIANGLE = """# a comment
v 0 0 0
v 1 0 0
v 1 1 0
vn 0 0 1
v 0 1 0
v 0.5 2 0.25
f 1//1 2//1 3//1 4//1
f -3 -2 -1
"""


def test_obj_reads_mixed_polygons_and_relative_indices(tmp_path: Path) -> None:
    path = tmp_path / "mesh.obj"
    path.write_text(QUAD_AND_TRIANGLE)
    mesh = read_mesh(path)
    assert mesh.polygons == ((0, 1, 2, 3), (2, 3, 4))
    np.testing.assert_array_equal(mesh.vertices[4], [0.5, 2.0, 0.25])


def test_npz_by_polygons_and_by_loops_agree(tmp_path: Path) -> None:
    vertices = np.random.default_rng(1).random((5, 3))
    np.savez(tmp_path / "a.npz", vertices=vertices, polygons=np.array([[0, 1, 2], [2, 3, 4]]))
    np.savez(tmp_path / "b.npz", vertices=vertices, loops=np.array([0, 1, 2, 2, 3, 4]), face_sizes=np.array([3, 3]))
    first, second = read_mesh(tmp_path / "a.npz"), read_mesh(tmp_path / "b.npz")
    assert first.polygons == second.polygons == ((0, 1, 2), (2, 3, 4))
    np.testing.assert_array_equal(first.vertices, second.vertices)


def test_npz_with_polygons_of_several_sizes(tmp_path: Path) -> None:
    np.savez(tmp_path / "m.npz", vertices=np.zeros((5, 3)), loops=np.arange(5), face_sizes=np.array([3, 2]))
    assert read_mesh(tmp_path / "m.npz").polygons == ((0, 1, 2), (3, 4))


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("v 0 0\n", "line 1"),
        ("v 0 0 0\nf 1 two 3\n", "line 2"),
        ("v 0 0 0\nf 1 -2 1\n", "there is no vertex -2"),
        ("v 0 0 0\nf 0 1 1\n", "there is no vertex 0"),
        ("nothing\n", "has no vertices"),
    ],
)
def test_damaged_obj_names_the_line(tmp_path: Path, content: str, said: str) -> None:
    path = tmp_path / "mesh.obj"
    path.write_text(content)
    with pytest.raises(FormatError, match=said):
        read_mesh(path)


@pytest.mark.parametrize(
    ("arrays", "said"),
    [
        ({"vertices": np.zeros((3, 2))}, r"\(V, 3\)"),
        ({"vertices": np.zeros((3, 3))}, "`polygons`"),
        ({"vertices": np.zeros((3, 3)), "loops": np.arange(3), "face_sizes": np.array([4])}, "add up to 4"),
    ],
)
def test_damaged_npz_names_the_array(tmp_path: Path, arrays: dict[str, np.ndarray], said: str) -> None:
    np.savez(tmp_path / "m.npz", **arrays)
    with pytest.raises(FormatError, match=said):
        read_mesh(tmp_path / "m.npz")


@pytest.mark.parametrize(
    ("name", "said"),
    [("head.fbx", "export the mesh as .obj"), ("gone.obj", "does not exist"), ("rubbish.npz", "not an .npz")],
)
def test_other_kinds_missing_files_and_rubbish_are_refused(tmp_path: Path, name: str, said: str) -> None:
    (tmp_path / "rubbish.npz").write_bytes(b"not a zip")
    with pytest.raises(FormatError, match=said):
        read_mesh(tmp_path / name)


def test_shared_heads_are_read(shared: Path) -> None:
    mesh = read_mesh(shared / "heads" / "ict.npz")
    assert mesh.vertices.shape == (25959, 3)
    assert len(mesh.polygons) == 25772
    assert {len(polygon) for polygon in mesh.polygons} == {3, 4}
