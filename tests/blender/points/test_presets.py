"""Topologies that users save: found again in any file, before those of Risorius, and removed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.errors import SceneError
from risorius.scene import mesh as meshes
from risorius.scene.points import bound as points_bound
from risorius.scene.points import kept as points_kept
from risorius.scene.points import presets as points_presets
from risorius.scene.points.kept import Origin

pytestmark = pytest.mark.smoke


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of its own instead of the user's."""
    monkeypatch.setattr(points_presets, "preset_folder", lambda *, create=False: tmp_path)
    return tmp_path


@pytest.fixture
def grid() -> Any:
    """A mesh of no known topology with three points, one of them between vertices."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=7, y_subdivisions=5)
    obj = bpy.context.object
    points = {"9.3": (0.05, 0.07, 0.0), "3.7": 3, "2.1": (0.5, 0.2, 0.0)}
    points_kept.write_kept(obj, points_bound.bind(obj.data, points))
    return obj


def places(obj: Any) -> dict[str, np.ndarray]:
    return points_bound.places(points_kept.read_kept(obj), meshes.rest_vertices(obj.data))


def test_saved_points_are_found_on_another_shape_in_another_file(grid: Any, folder: Path) -> None:
    assert bpy.ops.risorius.save_topology(called="My Grid") == {"FINISHED"}
    assert points_presets.preset_names() == {"my_grid": "My Grid"}
    before = places(grid)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=7, y_subdivisions=5)
    other = bpy.context.object
    for vertex in other.data.vertices:
        vertex.co = (2.0 * vertex.co.x, vertex.co.y, 3.0 * vertex.co.x)
    assert bpy.ops.risorius.find_points() == {"FINISHED"}
    kept = points_kept.read_kept(other)
    assert {point.origin for point in kept.points.values()} == {Origin.TOPOLOGY}
    expected = {name: (2.0 * p[0], p[1], 3.0 * p[0]) for name, p in before.items()}
    for name, place in places(other).items():
        np.testing.assert_allclose(place, expected[name], atol=1e-5)


def test_a_saved_topology_comes_before_the_one_that_risorius_brings(head: Any, folder: Path) -> None:
    kept = points_kept.read_kept(head)
    surface = points_bound.Surface.of(head.data)
    aside = points_bound.moved(kept, "9.3", places(head)["9.3"] + (0.01, 0.0, 0.0), surface, Origin.DRAGGED)
    points_kept.write_kept(head, aside)
    points_presets.save_preset(head, "mine")
    expected = places(head)["9.3"]
    points_kept.forget_points(head)
    assert bpy.ops.risorius.find_points() == {"FINISHED"}
    np.testing.assert_allclose(places(head)["9.3"], expected, atol=1e-6)


def test_a_removed_topology_is_not_known_any_more(grid: Any, folder: Path) -> None:
    assert not bpy.ops.risorius.remove_topology.poll()
    points_presets.save_preset(grid, "gone")
    shipped = len(points_presets.shipped_names())
    assert len(points_presets.known_topologies()[0]) == shipped + 1
    assert bpy.ops.risorius.remove_topology(file="gone") == {"FINISHED"}
    assert len(points_presets.known_topologies()[0]) == shipped
    assert list(folder.iterdir()) == []
    with pytest.raises(SceneError, match="no longer exists"):
        points_presets.remove_preset("gone")


def test_an_unreadable_one_is_passed_over_and_named(grid: Any, folder: Path) -> None:
    points_presets.save_preset(grid, "good")
    (folder / "bad.toml").write_text("name = 3\n")
    known, wrong = points_presets.known_topologies()
    assert known[0].name == "good"
    (said,) = wrong
    assert "bad.toml" in said
    assert points_presets.preset_names()["bad"] == "bad (cannot be read)"


@pytest.mark.parametrize("name", ["", "  ", "../.."])
def test_a_name_without_letters_is_refused(grid: Any, folder: Path, name: str) -> None:
    with pytest.raises(SceneError, match="needs a name with letters or digits"):
        points_presets.save_preset(grid, name)
    assert list(folder.iterdir()) == []


def test_names_stay_inside_the_folder(grid: Any, folder: Path) -> None:
    assert points_presets.save_preset(grid, "../../Ünder / it").parent == folder
