"""Scripts in Blender use these names; they stay where they are."""

from __future__ import annotations

from importlib import import_module

import pytest

NAMES = {
    "operators.bake.ops": ("expression_work",),
    "scene.bake": ("BakeResult", "ClipTiming", "Target", "bake_expression", "bake_motion", "clear"),
    "scene.blendshape_keys": ("write_blendshapes",),
    "scene.faces": ("face_of", "read_face", "store_points"),
    "scene.progress": ("Progress", "run"),
}


@pytest.mark.parametrize("module", NAMES)
def test_scripts_find_what_they_use(module: str) -> None:
    found = import_module(f"risorius.{module}")
    assert [name for name in NAMES[module] if not callable(getattr(found, name, None))] == []
