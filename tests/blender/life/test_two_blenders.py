"""Two Blenders with one file and one folder of kept faces: what one saves, the other finds whole."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.scene import faces

#: The other Blender: opens the file, bakes, saves it, and keeps what it has worked out.
OTHER = """
import sys
from pathlib import Path
import bpy, risorius
from risorius.scene import faces
risorius.register()
faces.keep_where(lambda: Path(sys.argv[2]))
bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
head = bpy.data.objects["Risorius Head"]
bpy.context.view_layer.objects.active = head
head.risorius.bake.clip = "theirs"
assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
assert faces.run(faces.keep_posed_steps()) == []
bpy.ops.wm.save_mainfile()
sys.stdout.flush()
import os; os._exit(0)
"""


@pytest.mark.slow
def test_what_another_blender_saves_meanwhile_is_there_after_revert(head: Any, tmp_path: Path) -> None:
    path, kept = tmp_path / "shared.blend", tmp_path / "kept"
    head.risorius.emotion.word = "joy"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    command = [sys.executable, "-c", OTHER, str(path), str(kept)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as other:
        faces.keep_where(lambda: kept)
        try:
            head.risorius.bake.clip = "ours"
            assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
            assert faces.run(faces.keep_posed_steps()) == []
        finally:
            faces.keep_where(faces.nowhere)
        told, _ = other.communicate(timeout=240)
    assert other.returncode == 0, told
    assert [key.name for key in head.data.shape_keys.key_blocks] == ["Basis", "ours"]
    ours = points(head, "ours")
    bpy.ops.wm.revert_mainfile()
    again = bpy.data.objects["Risorius Head"]
    assert [key.name for key in again.data.shape_keys.key_blocks] == ["Basis", "theirs"]
    assert points(again, "theirs") == ours
    assert len(list(kept.iterdir())) == 1  # one face, whole, whoever was last


def points(head: Any, name: str) -> bytes:
    """The shape of a key, to the last bit."""
    block = head.data.shape_keys.key_blocks[name]
    places = np.empty(3 * len(block.data), dtype=np.float32)
    block.data.foreach_get("co", places)
    return places.tobytes()
