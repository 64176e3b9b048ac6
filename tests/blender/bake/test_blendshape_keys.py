"""Named shape keys on a mesh in Blender: written whole or not at all, and the user's own from then on."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.errors import ParameterError, SceneError
from risorius.progress import run
from risorius.scene import bake
from risorius.scene.blendshape_keys import write_blendshapes
from risorius.scene.jobs.shapes import blendshape_file
from risorius.scene.mesh import key_vertices

FEW = """
[keys.jawOpen]
shapes = { jawOpen = 1 }
[keys.smile]
shapes = { mouthSmileLeft = 1, mouthSmileRight = 1 }
"""


@pytest.fixture
def few(tmp_path: Path) -> Path:
    """A preset of two keys."""
    (tmp_path / "few.toml").write_text(FEW)
    return tmp_path / "few.toml"


def key_names(obj: Any) -> list[str]:
    """Names of an object's shape keys."""
    return [] if obj.data.shape_keys is None else [block.name for block in obj.data.shape_keys.key_blocks]


@pytest.mark.slow
@pytest.mark.smoke
def test_keys_are_the_shapes_of_the_api(head: Any, few: Path) -> None:
    written = run(write_blendshapes(bake.Target(head), few))
    assert written.keys == ("jawOpen", "smile")
    assert key_names(head) == ["Basis", "jawOpen", "smile"]
    face = api.default_face()
    expected = api.arkit_shapes(face, few)
    blocks = head.data.shape_keys.key_blocks
    for name in written.keys:
        moved = key_vertices(blocks[name]) - key_vertices(blocks["Basis"])
        np.testing.assert_allclose(moved, expected[name] - face.vertices, atol=2e-6)
        assert (blocks[name].value, blocks[name].slider_min, blocks[name].slider_max) == (0.0, 0.0, 1.0)


@pytest.mark.slow
def test_they_are_the_users_own(head: Any, few: Path) -> None:
    """A bake beside them, and clearing it, leaves them."""
    run(write_blendshapes(bake.Target(head), few))
    timing = bake.ClipTiming(0.2, 0.2, 0.2)
    run(bake.bake_expression(bake.Target(head), api.expression("joy").frame(), clip="joy", timing=timing))
    assert "joy" in key_names(head)
    bake.clear(bake.Target(head))
    assert key_names(head) == ["Basis", "jawOpen", "smile"]


@pytest.mark.slow
def test_keys_of_the_same_names_are_refused_or_replaced(head: Any, few: Path) -> None:
    head.shape_key_add(name="Basis", from_mix=False)
    own = head.shape_key_add(name="smile", from_mix=False)
    with pytest.raises(SceneError, match="smile"):
        run(write_blendshapes(bake.Target(head), few))
    assert key_names(head) == ["Basis", "smile"]
    rest = key_vertices(own)
    written = run(write_blendshapes(bake.Target(head), few, replace=True))
    assert written.replaced == ("smile",)
    assert key_names(head) == ["Basis", "smile", "jawOpen"]
    assert np.abs(key_vertices(head.data.shape_keys.key_blocks["smile"]) - rest).max() > 5e-3


def test_an_object_that_is_no_face_is_left_alone(cube: Any, few: Path) -> None:
    with pytest.raises(SceneError, match="no feature points"):
        run(write_blendshapes(bake.Target(cube), few))
    assert key_names(cube) == []


def test_a_job_that_is_given_up_has_written_nothing(head: Any, few: Path) -> None:
    work = write_blendshapes(bake.Target(head), few)
    next(work)
    next(work)
    work.close()
    assert key_names(head) == []


def test_a_blend_file_and_its_keys(few: Path, tmp_path: Path) -> None:
    written = blendshape_file(tmp_path / "a.blend", names=few)
    assert written.keys == ("jawOpen", "smile")
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "a.blend"))
    assert any(key_names(obj) == ["Basis", "jawOpen", "smile"] for obj in bpy.data.objects if obj.type == "MESH")
    with pytest.raises(ParameterError, match="out"):
        blendshape_file(tmp_path / "a.fbx", names=few)


@pytest.mark.slow
@pytest.mark.skipif(importlib.util.find_spec("io_scene_gltf2") is None, reason="no glTF in this Blender")
def test_gltf_keeps_names_and_shapes(few: Path, tmp_path: Path) -> None:
    """Out and in again: the morph targets move the same vertices by as much."""
    blendshape_file(tmp_path / "a.glb", names=few)
    largest = {
        name: np.linalg.norm(positions - api.default_face().vertices, axis=1).max()
        for name, positions in api.arkit_shapes(api.default_face(), few).items()
    }
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.import_scene.gltf(filepath=str(tmp_path / "a.glb"))
    keyed = [obj for obj in bpy.data.objects if obj.type == "MESH" and obj.data.shape_keys is not None]
    assert keyed
    for name, distance in largest.items():
        moved = [
            np.linalg.norm(key_vertices(blocks[name]) - key_vertices(blocks[0]), axis=1).max()
            for blocks in (obj.data.shape_keys.key_blocks for obj in keyed)
            if name in blocks
        ]
        assert max(moved) == pytest.approx(distance, rel=1e-3)


@pytest.mark.slow
def test_the_button_makes_the_keys_of_the_chosen_names(head: Any) -> None:
    chosen = bpy.context.scene.risorius.shapes
    chosen.names = "oculus_visemes"
    assert bpy.ops.risorius.make_shapes() == {"FINISHED"}
    made = [key.name for key in head.data.shape_keys.key_blocks][1:]
    assert made == list(api.load_key_names("oculus_visemes"))
    with pytest.raises(RuntimeError, match="turn on Replace"):
        bpy.ops.risorius.make_shapes()
    chosen.replace = True
    assert bpy.ops.risorius.make_shapes() == {"FINISHED"}
    assert len(head.data.shape_keys.key_blocks) == len(made) + 1
