"""Speech on the timeline in a real window: added, previewed with the emotion, moved, stretched, edited, undone.

Pictures of the stages are left in out/test-reports/speech/.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from places import ROOT
from window.driver import Window

PICTURES = ROOT / "out" / "test-reports" / "speech"
#: Seconds for the window to draw what was changed.
DRAWN = 0.7
HEAD = "bpy.data.objects['Risorius Head']"
STATE = f"""
speech = {HEAD}.risorius.speech
editor = bpy.context.scene.sequence_editor
strips = [] if editor is None else (editor.strips if hasattr(editor, "strips") else editor.sequences)
result = {{
    "strips": [[strip.start, round(strip.stretch, 3), [word.name for word in strip.words]] for strip in speech.strips],
    "sounds": [[int(strip.left_handle), int(strip.duration)] for strip in strips],
}}
"""
#: The panels of speech come first, and the editor of properties shows the timeline, tall enough for pictures.
ROOM = """
for name in ("emotion", "variation", "timeline", "bake", "read_features", "read_faps", "read", "film"):
    bpy.utils.unregister_class(getattr(bpy.types, f"RISORIUS_PT_{name}"))
area = next(area for area in bpy.context.window_manager.windows[0].screen.areas if area.type == "PROPERTIES")
area.ui_type = "TIMELINE"
bpy.context.scene.frame_end = 70
"""


@pytest.fixture(scope="module")
def window(blender: Path, settings: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Window]:
    """The window, open until the last test, with the default head in it and Speak open."""
    with Window(blender, settings, tmp_path_factory.mktemp("speech") / "asked") as opened:
        opened.ask("for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)")
        opened.ask("with in_viewport(): bpy.ops.risorius.add_head()")
        opened.ask("with in_viewport(): bpy.ops.view3d.view_axis(type='FRONT')")
        opened.ask("viewport()[1].spaces.active.show_region_ui = True")
        opened.ask("viewport()[2]['UI'].active_panel_category = 'Risorius'")
        opened.ask(f"{HEAD}.risorius.speech.text = 'I did not see that coming.'")
        opened.ask(f"{HEAD}.risorius.emotion.word = 'surprise'")
        opened.ask(ROOM)
        opened.ask("with in_viewport(): bpy.ops.ed.undo_push(message='Built')")
        yield opened
        opened.shot(PICTURES / "last.png")


def state(window: Window) -> dict[str, Any]:
    """What there is now."""
    found: dict[str, Any] = window.ask(STATE)
    return found


def test_it_is_added_with_its_sound(window: Window) -> None:
    window.ask("bpy.context.scene.frame_set(20)")
    window.ask("with in_viewport(): bpy.ops.risorius.add_speech()")
    window.ask("with in_viewport(): bpy.ops.ed.undo_push(message='Added')")
    time.sleep(DRAWN)
    now = state(window)
    assert now["strips"] == [[20, 1.0, ["I", "did not", "see", "that", "coming"]]]
    assert now["sounds"][0][0] == 20
    assert window.ask("result = [bpy.context.scene.sync_mode, bpy.context.scene.use_audio_scrub]") == [
        "AUDIO_SYNC",
        True,
    ]
    window.shot(PICTURES / "1-added.png")


def test_scrubbing_shows_mouth_and_emotion_before_a_bake(window: Window) -> None:
    shown = []
    for frame in (24, 34, 44):
        window.ask(f"bpy.context.scene.frame_set({frame})")
        window.wait(f"'risorius_preview' in {HEAD}.data.attributes")
        time.sleep(DRAWN)
        shown.append(
            window.ask(f"result = [list(d.vector) for d in {HEAD}.data.attributes['risorius_preview'].data[:4000]]")
        )
        window.shot(PICTURES / f"2-scrubbed-{frame}.png")
    assert shown[0] != shown[1] != shown[2]
    assert window.ask(f"result = {HEAD}.data.shape_keys is None")


def test_it_is_moved_and_stretched_with_its_sound_and_undone(window: Window) -> None:
    before = state(window)
    window.ask(f"{HEAD}.risorius.speech.strips[0].start = 28")
    window.ask("with in_viewport(): bpy.ops.ed.undo_push(message='Moved')")
    time.sleep(DRAWN)
    moved = state(window)
    assert moved["strips"][0][0] == 28
    assert moved["sounds"][0] == [28, before["sounds"][0][1]]
    window.ask("with in_viewport(): bpy.ops.risorius.stretch_speech(stretch=1.5)")
    window.ask("with in_viewport(): bpy.ops.ed.undo_push(message='Stretched')")
    time.sleep(DRAWN)
    longer = state(window)
    assert longer["sounds"][0] == [28, pytest.approx(1.5 * before["sounds"][0][1], abs=2)]
    window.shot(PICTURES / "3-stretched.png")
    for earlier in (moved, before):
        window.ask("with in_viewport(): bpy.ops.ed.undo()")
        time.sleep(DRAWN)
        assert state(window) == earlier


def test_words_are_edited_and_undone(window: Window) -> None:
    before = state(window)
    window.ask("with in_viewport(): bpy.ops.risorius.remove_word()")
    window.ask("with in_viewport(): bpy.ops.ed.undo_push(message='Removed')")
    time.sleep(DRAWN)
    assert state(window)["strips"][0][2] == before["strips"][0][2][1:]
    window.shot(PICTURES / "4-removed.png")
    window.ask("with in_viewport(): bpy.ops.ed.undo()")
    time.sleep(DRAWN)
    assert state(window) == before
    assert "Traceback" not in window.log()
