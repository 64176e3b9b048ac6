"""A face that speaks in a real window: the panel, its bake with the sound, one undo, Esc.

Pictures of the stages are left in out/test-reports/speak/.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from places import ROOT
from window.driver import Window

PICTURES = ROOT / "out" / "test-reports" / "speak"
#: Seconds for the window to draw what was changed.
DRAWN = 0.7

#: What there is of speech.
STATE = """
obj = bpy.data.objects["Risorius Head"]
keys = obj.data.shape_keys
editor = bpy.context.scene.sequence_editor
strips = [] if editor is None else (editor.strips if hasattr(editor, "strips") else editor.sequences)
result = {
    "actions": sorted(action.name for action in bpy.data.actions),
    "keys": len(keys.key_blocks) if keys else 0,
    "strips": [[strip.type, int(strip.left_handle)] for strip in strips],
}
"""
RUNNING = "any('speak' in op.bl_idname for op in bpy.context.window_manager.windows[0].modal_operators)"


@pytest.fixture(scope="module")
def window(blender: Path, settings: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Window]:
    """The window, open until the last test, with the default head in it and Speak open."""
    with Window(blender, settings, tmp_path_factory.mktemp("speak") / "asked") as opened:
        opened.ask("for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)")
        opened.ask("with in_viewport(): bpy.ops.risorius.add_head()")
        opened.ask("viewport()[1].spaces.active.show_region_ui = True")
        opened.ask("viewport()[2]['UI'].active_panel_category = 'Risorius'")
        opened.ask("bpy.data.objects['Risorius Head'].risorius.speech.text = 'Pat my map.'")
        opened.ask("with in_viewport(): bpy.ops.ed.undo_push(message='Built')")
        yield opened
        opened.shot(PICTURES / "last.png")


def state(window: Window) -> dict[str, Any]:
    """What there is now."""
    found: dict[str, Any] = window.ask(STATE)
    return found


def speak(window: Window, until: float = 120.0) -> None:
    """Press the button and wait for its end."""
    window.ask("with in_viewport(): bpy.ops.risorius.speak('INVOKE_DEFAULT')")
    end = time.monotonic() + until
    while window.ask(f"result = {RUNNING}"):
        assert time.monotonic() < end
        time.sleep(0.3)
    time.sleep(DRAWN)


def test_escape_while_it_works_leaves_nothing(window: Window) -> None:
    before = state(window)
    window.ask("with in_viewport(): bpy.ops.risorius.speak('INVOKE_DEFAULT')")
    assert window.ask(f"result = {RUNNING}")
    window.key("Escape")
    time.sleep(2 * DRAWN)
    assert not window.ask(f"result = {RUNNING}")
    assert state(window) == before


def test_a_text_is_baked_with_its_sound_and_one_undo_takes_both_back(window: Window) -> None:
    before = state(window)
    speak(window)
    after = state(window)
    window.shot(PICTURES / "1-spoken.png")
    assert after["keys"] > before["keys"]
    assert after["strips"] == [["SOUND", 1]]
    window.ask("with in_viewport(): bpy.ops.ed.undo()")
    time.sleep(DRAWN)
    assert state(window) == before
