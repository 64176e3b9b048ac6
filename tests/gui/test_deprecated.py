"""A window says what a later Blender takes away, whatever else it is used for."""

from __future__ import annotations

from pathlib import Path

import pytest
from window.driver import Window, WindowError

#: What Blender does where the extension uses a property that goes.
WARNING = """
import warnings
names = {"__name__": "bl_ext.user_default.risorius.scene.sounds", "warnings": warnings}
exec("warnings.warn(\\"'Strip.frame_start' is expected to be removed in Blender 6.0\\", DeprecationWarning)", names)
"""


def test_a_window_ends_with_an_error_where_the_extension_was_warned(
    blender: Path, settings: Path, tmp_path: Path
) -> None:  # fmt: skip
    with pytest.raises(WindowError, match=r"Strip\.frame_start"), Window(blender, settings, tmp_path) as window:
        window.ask(WARNING)
