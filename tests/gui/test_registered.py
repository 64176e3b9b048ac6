"""A script that registers the package in the program Blender: it ends without a complaint."""

from __future__ import annotations

from pathlib import Path

from environments import ensure_link
from window.driver import call

SCRIPT = "import sys; sys.path.insert(0, {package!r}); import risorius; risorius.register(); print('registered')\n"


def test_blender_ends_in_order_after_a_registration_by_a_script(blender: Path, tmp_path: Path) -> None:
    script, settings = tmp_path / "script.py", tmp_path / "settings"
    settings.mkdir()
    script.write_text(SCRIPT.format(package=str(ensure_link())), encoding="utf-8")
    done = call(blender, "background", "--python-exit-code", "1", "--python", str(script), settings=settings)
    assert done.returncode == 0
    assert "registered" in done.stdout
    assert "Error" not in done.stdout + done.stderr
