"""What may be imported without Blender, proved in a fresh interpreter."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

BLENDER = ("bpy", "bmesh", "mathutils", "gpu")


def loaded_by(statement: str) -> set[str]:
    """The names of all modules loaded after one statement in a fresh interpreter."""
    code = f"{statement}; import sys; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return set(done.stdout.split())


@pytest.mark.parametrize("module", ["risorius", "risorius.api", "risorius.cli"])
def test_import_loads_no_blender(module: str) -> None:
    assert not loaded_by(f"import {module}") & set(BLENDER)


def test_package_root_loads_neither_numpy_nor_scipy() -> None:
    loaded = loaded_by("import risorius")
    assert "risorius" in loaded
    assert not loaded & {"numpy", "scipy"}


def test_blenders_figures_are_read_and_written_in_bulk_in_one_place() -> None:
    root = Path(__file__).resolve().parents[1]
    using = [
        path.relative_to(root).as_posix()
        for room in ("scene", "operators")
        for path in (root / room).rglob("*.py")
        if ".foreach_" in path.read_text(encoding="utf-8")
    ]
    assert using == ["scene/attributes.py"]


def test_the_anatomy_of_a_face_is_for_the_rooms_of_face_alone() -> None:
    """Import contracts keep its modules closed; this keeps closed what hangs on a `Face`."""
    root = Path(__file__).resolve().parents[1]
    using = [
        path.relative_to(root).as_posix()
        for room in ("api.py", "cli", "operators", "scene", "track")
        for path in ([root / room] if room.endswith(".py") else (root / room).rglob("*.py"))
        if ".anatomy" in path.read_text(encoding="utf-8")
    ]
    assert using == []
