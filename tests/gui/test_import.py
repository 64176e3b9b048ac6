"""A recording imported in a real window: the dialog of a dropped file, its bake, one undo, Esc, and the file browser.

Pictures of the stages are left in out/test-reports/import/.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from places import ROOT
from window.driver import Window

PICTURES = ROOT / "out" / "test-reports" / "import"
#: Seconds for the window to draw what was changed.
DRAWN = 0.7

#: A smile and a blink as a tracker's scores, 30 rows in a second, of which one is missing.
ROWS = [f"{n / 30:.4f},{n / 60:.3f},{1.0 if 12 <= n < 16 else 0.0}" for n in range(30) if n != 20]

#: What there is of imports, and what runs.
STATE = """
obj = bpy.data.objects["Risorius Head"]
keys = obj.data.shape_keys
result = {
    "actions": sorted(action.name for action in bpy.data.actions),
    "keys": [key.name for key in keys.key_blocks] if keys else [],
    "said": obj.risorius.recording.said,
    "clip": obj.risorius.recording.clip,
}
"""
RUNNING = "any('bake_recording' in op.bl_idname for op in bpy.context.window_manager.windows[0].modal_operators)"


@pytest.fixture(scope="module")
def window(blender: Path, settings: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Window]:
    """The window, open until the last test, with the default head in it and a recording beside it."""
    folder = tmp_path_factory.mktemp("import")
    names = "time,mouthSmileLeft,eyeBlinkLeft"
    (folder / "take.csv").write_text("\n".join([names, *ROWS]) + "\n", encoding="utf-8")
    with Window(blender, settings, folder / "asked") as opened:
        opened.ask("for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)")
        opened.ask("with in_viewport(): bpy.ops.risorius.add_head()")
        opened.ask("viewport()[1].spaces.active.show_region_ui = True")
        opened.ask("viewport()[2]['UI'].active_panel_category = 'Risorius'")
        opened.ask("with in_viewport(): bpy.ops.ed.undo_push(message='Built')")
        opened.ask(f"import os; os.chdir({str(folder)!r})")
        yield opened
        opened.shot(PICTURES / "last.png")


@pytest.fixture(scope="module")
def take(window: Window) -> str:
    """The file of the recording."""
    return str(window.folder.parent / "take.csv")


def state(window: Window) -> dict[str, Any]:
    """What there is now."""
    found: dict[str, Any] = window.ask(STATE)
    return found


def drop(window: Window, take: str) -> None:
    """What dropping a file on the viewport does, until the dialog shows."""
    window.ask(f"with in_viewport(): bpy.ops.risorius.import_fap('INVOKE_DEFAULT', filepath={take!r})")
    time.sleep(DRAWN)


def test_dropping_asks_for_what_the_file_leaves_open(window: Window, take: str) -> None:
    before = state(window)
    drop(window, take)
    window.shot(PICTURES / "1-dialog.png")
    assert state(window) == before
    window.key("Escape")
    time.sleep(DRAWN)
    assert state(window) == before


def test_accepted_it_is_baked_and_says_what_was_assumed(window: Window, take: str) -> None:
    before = state(window)
    drop(window, take)
    window.key("Return")
    window.wait("bool(bpy.data.objects['Risorius Head'].risorius.recording.clip)")
    window.wait(f"not {RUNNING}")
    after = state(window)
    assert after["clip"] == "take"
    assert after["actions"] != before["actions"]
    assert len(after["keys"]) > 1
    assert "bridged" in after["said"]
    time.sleep(DRAWN)
    window.shot(PICTURES / "2-imported.png")


def test_one_undo_takes_it_back(window: Window) -> None:
    window.ask("with in_viewport(): bpy.ops.ed.undo()")
    undone = state(window)
    assert undone["actions"] == []
    assert undone["keys"] == []
    assert undone["clip"] == ""


def test_escape_while_it_is_imported_leaves_nothing(window: Window, take: str) -> None:
    before = state(window)
    window.ask(f"with in_viewport(): bpy.ops.risorius.bake_recording('INVOKE_DEFAULT', filepath={take!r})")
    window.wait(RUNNING)
    window.key("Escape")
    window.wait(f"not {RUNNING}")
    assert state(window) == before


def test_without_a_file_it_opens_the_file_browser(window: Window) -> None:
    before = state(window)
    browsing = "any(a.type == 'FILE_BROWSER' for w in bpy.context.window_manager.windows for a in w.screen.areas)"
    window.ask("with in_viewport(): bpy.ops.risorius.import_fap('INVOKE_DEFAULT')")
    window.wait(browsing)
    time.sleep(DRAWN)
    window.shot(PICTURES / "3-browser.png")
    window.key("Escape")
    window.wait(f"not {browsing}")
    assert state(window) == before


def test_blender_did_not_complain(window: Window) -> None:
    assert "Traceback" not in window.log(), window.log()[-3000:]
